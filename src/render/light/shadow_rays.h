#pragma once
#include "render/light/light_medium.h"

namespace bruma::render {

/// What shadow rays need beside a plan's grid and light.
struct ShadowRays {
    scene::ClipBox clip;
    glm::dmat4 world_from_texture{1.0};
    double step_world = 0.0;    ///< metres
    double tau_per_step = 0.0;  ///< optical depth per step and unit of the tables' extinction
    std::array<double, 2> window{0.0, 1.0};
    scene::LightPrecision precision = scene::LightPrecision::half;
    bool operator==(const ShadowRays&) const = default;
};

/// Share of the direct light that arrives at each cell's centre of the plan's grid, by a ray through the data.
gl::Texture trace_shadow_rays(gl::ShaderLibrary& shaders, const VolumeTexture& voxels,
                              const EmptinessTexture& emptiness, const scene::TransferFunction& tf,
                              const SweepPlan& plan, const ShadowRays& rays);

}  // namespace bruma::render
