#include "scene/light.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bruma::scene {

double spot_share(const Light& light, double cosine_to_axis) {
    const double outer = std::cos(glm::radians(light.spot_angle_deg));
    const double inner = std::cos(glm::radians(light.spot_angle_deg * (1.0 - light.spot_softness)));
    if (!(inner > outer)) {
        return cosine_to_axis >= outer ? 1.0 : 0.0;
    }
    const double f = std::clamp((cosine_to_axis - outer) / (inner - outer), 0.0, 1.0);
    return f * f * (3.0 - 2.0 * f);
}

Incident incident_light(const Light& light, glm::dvec3 point_world, glm::dvec3 camera_back_world) {
    const glm::dvec3 power = light.color * light.intensity;
    if (!has_position(light)) {
        const glm::dvec3 toward = light.kind == LightKind::headlight ? camera_back_world : light.direction_world;
        return {glm::normalize(toward), std::numeric_limits<double>::infinity(), power};
    }
    const glm::dvec3 way = light.position_world - point_world;
    const double distance = glm::length(way);
    if (!(distance > 1e-100)) {  // in the light itself, where no direction is right; also keeps 1 / squared finite
        return {};
    }
    const glm::dvec3 toward = way / distance;
    const double share = light.kind == LightKind::spot
                             ? spot_share(light, glm::dot(toward, glm::normalize(light.direction_world)))
                             : 1.0;
    return {toward, distance, power * (share / (distance * distance))};
}

bool shines(const Light& light) {
    return light.on && light.intensity > 0.0 && light.color != glm::dvec3(0.0);
}

}  // namespace bruma::scene
