#pragma once
#include <string>
#include <vector>

#include "render/clouds/cloud_passes.h"

namespace bruma::render {

/// Clouds before the lamp that lights them, for passes that draw what stands in that light: clouds/cloud_shadow.glsl.
/// They take its direct light only; what they scatter down adds nothing but on the sky's own ground.
struct CloudShadows {
    struct Layer {
        scene::CloudLayer layer;
        double time_s = 0.0;  ///< 0 without wind
        double turned = 1.0;  ///< 1 less the mean cosine of scattering
        Handle<CloudSunDepths> depths;
        bool operator==(const Layer&) const = default;
    };
    std::vector<Layer> layers;  ///< empty: no shadows
    int lamp = -1;              ///< its place among the lights as `order_lights` leaves them
    glm::dvec2 lean{0.0};
    bool operator==(const CloudShadows&) const = default;

    /// The grids, for FrameGraph::set_reads.
    void add_reads(std::vector<int>& reads) const;
    void add_defines(gl::Defines& defines) const;
    /// Binds the grids from `unit` on.
    void set(const PassAccess& access, gl::Program& program, const glm::dvec3& eye_world, double unit_world,
             GLuint unit) const;
};

/// As many layers as throw shadows: half of the texture units that every driver has, behind those of surfaces.
constexpr std::size_t most_shadow_layers = 8;
/// One sentence about layers beyond; empty: there are none.
std::string shadows_left_out(const std::vector<std::string>& shown);

/// Place of the sun, or indoors of the first directional lamp, among the lights that shine; -1: it does not.
int cloud_lamp(const scene::Scene& scene);

/// Of all shown layers; their depths are given in the same order.
CloudShadows cloud_shadows(const scene::Scene& scene, const std::vector<std::string>& shown,
                           const std::vector<Handle<CloudSunDepths>>& depths);

}  // namespace bruma::render
