#include "render/light/far_lamps.h"

#include <algorithm>
#include <cmath>

namespace bruma::render {

std::optional<scene::Light> parallel_from_afar(const scene::Light& light, glm::dvec3 middle_world,
                                               double radius_world) {
    constexpr double far_away = 1e4;
    const glm::dvec3 way = light.position_world - middle_world;
    const double largest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    if (!scene::has_position(light) || !(largest > far_away * radius_world)) {
        return std::nullopt;
    }
    // Of this size squares stay finite however far the lamp is.
    const glm::dvec3 shrunk = way / largest;
    scene::Light parallel = light;
    parallel.kind = scene::LightKind::directional;
    parallel.direction_world = glm::normalize(shrunk);
    parallel.intensity /= glm::dot(shrunk, shrunk);
    parallel.intensity = parallel.intensity / largest / largest;
    if (light.kind == scene::LightKind::spot) {
        parallel.intensity *=
            scene::spot_share(light, glm::dot(parallel.direction_world, glm::normalize(light.direction_world)));
    }
    return parallel;
}

std::optional<scene::Scene> with_far_lamps_parallel(const scene::Scene& scene) {
    const scene::Bounds bounds = scene::world_bounds(scene);
    const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
    std::optional<scene::Scene> changed;
    for (const auto& [name, light] : scene.lights) {
        if (const auto parallel = parallel_from_afar(*light, middle, 0.5 * glm::length(bounds.high - bounds.low))) {
            if (!changed) {
                changed = scene;
            }
            changed->lights.at(name) = *parallel;
        }
    }
    return changed;
}

}  // namespace bruma::render
