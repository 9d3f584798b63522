#pragma once
#include "gl/shader_library.h"
#include "gl/texture.h"
#include "render/light/light_sweep_plan.h"

namespace bruma::render {

/// What is swept through a light grid beside direct light.
enum class SweptState { direct, diffuse, chromaticity };

struct SweepSettings {
    SweptState state = SweptState::direct;
    double spread = 0.0;  ///< diffuse: see scene::LightVolumeSettings
    double cone_angle_deg = 30.0;
    double g = 0.0;
    bool soft_shadows = false;
    scene::LightPrecision precision = scene::LightPrecision::half;
    /// Slices per dispatch: 1 spreads each slice over the whole GPU, more let one work group per axis take them in
    /// turn, 0 chooses.
    int slices_per_dispatch = 0;
    bool operator==(const SweepSettings&) const = default;
};

/// Where the medium is known to be empty: see Emptiness. No attenuation is looked up there, which changes no bit.
struct EmptySpace {
    const gl::Texture* distance = nullptr;  ///< none: nothing is known
    glm::dvec3 macrocells_per_cell{1.0};
    glm::dvec3 macrocell_of_origin{0.0};  ///< of cell (0, 0, 0)'s corner
};

struct SweptLight {
    gl::Texture direct, beside;  ///< see LightTextures
    int dispatches = 0;
};

/// Sweeps one light through a medium and combines the axes.
SweptLight sweep_light(gl::ShaderLibrary& shaders, const gl::Texture& extinction, const gl::Texture& albedo,
                       const SweepPlan& plan, const SweepSettings& settings, const EmptySpace& empty = {});

}  // namespace bruma::render
