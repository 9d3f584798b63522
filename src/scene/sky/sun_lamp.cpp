#include "scene/sky/sun_lamp.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {
namespace {

/// The sun's disc sets over this angle, radians: its radius in the mean (Hillaire 2020).
constexpr double disc_radius = 0.004675;

glm::dvec3 extinction(const Atmosphere& atmosphere, double altitude_m) {
    const double haze = std::exp(-altitude_m / atmosphere.mie_scale_height_m);
    const double ozone =
        std::max(0.0, 1.0 - std::abs(altitude_m - atmosphere.ozone_altitude_m) / atmosphere.ozone_half_width_m);
    return atmosphere.rayleigh_scattering_per_m * std::exp(-altitude_m / atmosphere.rayleigh_scale_height_m) +
           glm::dvec3((atmosphere.mie_scattering_per_m + atmosphere.mie_absorption_per_m) * haze) +
           atmosphere.ozone_absorption_per_m * ozone;
}

}  // namespace

glm::dvec3 sun_transmittance(const Atmosphere& atmosphere, double altitude_m, double climb) {
    const double h = std::clamp(altitude_m, 0.0, atmosphere.height_m);
    const double planet = atmosphere.planet_radius_m;
    const double r = planet + h;
    const double horizon = -std::sqrt(h * (planet + r)) / r;
    const double half_width = disc_radius * planet / r;
    const double set = std::clamp((climb - horizon + half_width) / (2.0 * half_width), 0.0, 1.0);
    const double share = set * set * (3.0 - 2.0 * set);
    if (share == 0.0) {
        return glm::dvec3(0.0);
    }
    const double m = std::max(climb, horizon);
    const double top = atmosphere.height_m;
    const double length = std::sqrt(std::max(0.0, r * r * m * m + (top - h) * (planet + r + top))) - r * m;
    // From the lowest point of the way to both of its ends, by midpoints that stand closer where the air is dense: 256
    // of them leave 1e-5.
    const double lowest = std::max(0.0, -r * m);
    glm::dvec3 depth(0.0);
    for (const double part : {length - lowest, -lowest}) {
        constexpr int points = 256;
        for (int n = 0; n < points && part != 0.0; ++n) {
            const double s = (n + 0.5) / points;
            const double t = lowest + part * s * s;
            const double altitude = std::sqrt(r * r + 2.0 * r * t * m + t * t) - planet;
            depth += extinction(atmosphere, std::max(0.0, altitude)) * (2.0 * std::abs(part) * s / points);
        }
    }
    return share * glm::exp(-depth);
}

Light sun_lamp(const Sun& sun, const Atmosphere& atmosphere) {
    const glm::dvec3 to_sun = to_sun_world(sun);
    return {.kind = LightKind::directional,
            .direction_world = to_sun,
            .color = sun.irradiance * sun_transmittance(atmosphere, 0.0, to_sun.y),
            .intensity = 1.0};
}

Scene with_sun_as_lamp(Scene scene) {
    if (scene.outdoors) {
        scene.lights.insert_or_assign(sun_lamp_name, sun_lamp(*scene.outdoors->sun, *scene.outdoors->atmosphere));
    }
    return scene;
}

}  // namespace bruma::scene
