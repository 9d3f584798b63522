#pragma once
#include "gl/shader_library.h"
#include "render/light/light_sweep_plan.h"
#include "render/volume/volume_passes.h"

namespace bruma::render {

/// What a volume does to light, on a light grid.
struct LightMedium {
    gl::Texture extinction;  ///< R32F: mean extinction of each cell times the grid's longest edge
    gl::Texture albedo;      ///< RGBA16F, if anything scatters twice
};

struct LightMediumParameters {
    LightGrid grid;
    int samples = 1;  ///< along each edge of a cell
    bool with_albedo = false;
    glm::dvec3 albedo{1.0};  ///< of the optics; 0 when it is not wanted
    std::array<double, 2> window{0.0, 1.0};
    double depth_per_sigma = 1.0;
    glm::dmat4 cells_from_texture{1.0};
    bool operator==(const LightMediumParameters&) const = default;
};

/// Means of the medium over the cells of a light grid.
void make_light_medium(gl::ShaderLibrary& shaders, const VolumeTexture& voxels, const EmptinessTexture& emptiness,
                       const scene::TransferFunction& tf, const LightMediumParameters& p, LightMedium& medium);

/// The optics table of a transfer function for those that look light up in the data: extinction alone, or with colour
/// as albedo.
gl::Texture optics_texture(const TransferTables& tables);

/// Texture space of a grid's cell (0, 0, 0) at its corner, and per cell.
struct CellsInTexture {
    glm::dvec3 low, per_cell;
};
CellsInTexture cells_in_texture(const glm::dmat4& texture_from_cells);

}  // namespace bruma::render
