#include "render/clouds/cloud_sky_pass.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "scene/sky/sky.h"

namespace bruma::render {
namespace {

const scene::Light* sun_of(const scene::Scene& scene) {
    for (const auto& [name, light] : scene.lights) {
        if (light->kind == scene::LightKind::directional && scene::shines(*light)) {
            return &*light;
        }
    }
    return nullptr;
}

/// In the order of sky/sky_light.glsl.
using Numbers = std::array<glm::vec4, 4>;

Numbers numbers_of(const scene::Scene& scene) {
    const scene::Light* sun = sun_of(scene);
    const glm::dvec3 to_sun = sun_direction_world(scene);
    const glm::dvec3 irradiance = sun != nullptr ? sun->color * sun->intensity : glm::dvec3(0.0);
    const glm::dvec3 sky = scene.environment->radiance;
    // A Lambert ground under the sun and half a sky.
    const glm::dvec3 ground =
        scene::Atmosphere{}.ground_albedo * (irradiance * std::max(0.0, to_sun.y) * std::numbers::inv_pi + sky);
    return {glm::vec4(to_sun, 0.0), glm::vec4(irradiance, 0.0), glm::vec4(sky, 0.0), glm::vec4(ground, 0.0)};
}

}  // namespace

glm::dvec3 sun_direction_world(const scene::Scene& scene) {
    if (scene.outdoors) {
        return scene::to_sun_world(*scene.outdoors->sun);
    }
    const scene::Light* sun = sun_of(scene);
    return sun != nullptr ? glm::normalize(sun->direction_world) : glm::dvec3(0.0, 1.0, 0.0);
}

CloudSkyPass::CloudSkyPass(FrameGraph& graph) : graph_(graph) {
    light = graph.add_product<SkyLight>("sky light");
    pass_ = graph.add_pass({"cloud_light", "light of sun and sky on clouds", {}, {light.index}, {}});
}

void CloudSkyPass::update(const scene::Scene& scene) {
    const Numbers numbers = numbers_of(scene);
    graph_.set_parameters(pass_, numbers);
    graph_.set_execute(pass_, [this, numbers](const PassAccess& access) {
        access.write(light).buffer = gl::Buffer("sky light", std::span<const glm::vec4>(numbers));
    });
}

}  // namespace bruma::render
