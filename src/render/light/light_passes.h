#pragma once
#include <map>
#include <string>

#include "gl/buffer.h"
#include "gl/shader_library.h"
#include "render/light/light_medium.h"
#include "render/volume/volume_passes.h"

namespace bruma::render {

/// Light of one lamp in each cell of a light grid, per unit of irradiance.
struct LightTextures {
    gl::Texture direct;  ///< R: share of the direct light that arrives at the cell's centre
    gl::Texture beside;  ///< RGB: scattered at least once (A: direct light at this grid's coarseness), or chromaticity
    LightGrid grid;
};

/// How the cells of a light grid get their light.
enum class LightTransport { direct, diffuse, chromaticity, shadow_rays };

/// The light of one volume: its extinction on light grids, and for each lamp the sweeps through them. None of it
/// depends on the camera, unless a lamp does. Colours and intensities of lamps are factors of the result and rerun
/// nothing.
class LightPasses {
  public:
    LightPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, std::string node_name, const VolumePasses& volume);
    ~LightPasses();
    LightPasses(const LightPasses&) = delete;
    LightPasses& operator=(const LightPasses&) = delete;

    /// Hands the graph this frame's parameters. `lights`: those that shine, with their names, in the marcher's order.
    /// `step_world`: of shadow rays, metres.
    void update(const scene::Volume& volume, const glm::dmat4& world_from_texture,
                const std::vector<std::pair<std::string, scene::Light>>& lights, glm::dvec3 camera_back_world,
                double step_world);

    /// The light of all lamps, in the order of `lights`, stacked along z: a texture each for direct light and for what
    /// is beside it. Of a single lamp, its own.
    Handle<LightTextures> stacked() const { return stacked_; }
    Handle<LightTextures> stacked_beside() const { return stacked_beside_; }  ///< index -1: nothing beside
    /// The grid of direct light.
    const LightGrid& grid() const { return grid_; }

  private:
    struct Sweep {
        Handle<LightTextures> light;
        PassId pass;
    };
    struct Medium {
        Handle<LightMedium> medium;
        PassId pass;
    };
    Handle<LightTextures> update_sweep(const std::string& light_name, LightTransport transport, const SweepPlan& plan,
                                       const scene::Volume& volume, const glm::dmat4& world_from_texture,
                                       double step_world);
    struct Stack {
        Handle<LightTextures> light;
        PassId pass;
    };
    Handle<LightTextures> update_stack(Stack& stack, const char* name, const std::vector<Handle<LightTextures>>& parts);
    void update_medium(Medium& medium, const char* name, const scene::Volume& volume, const LightGrid& grid,
                       int samples, bool with_albedo);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    std::string node_name_;
    const VolumePasses& volume_;
    Handle<int> shader_revision_;
    Medium fine_, coarse_;
    LightGrid grid_;
    std::map<std::pair<std::string, LightTransport>, Sweep> sweeps_;  ///< by light
    Stack direct_stack_, beside_stack_;
    Handle<LightTextures> stacked_, stacked_beside_;
};

}  // namespace bruma::render
