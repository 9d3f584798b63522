#pragma once
#include <memory>
#include <numbers>

#include "drawing.h"
#include "reference/sky_tables.h"
#include "render/passes/sky_passes.h"

/// What the tests of the sky share: scenes with nothing but a sky, and the radiance that the reference sees there.
namespace bruma::render {

constexpr double rad = std::numbers::pi / 180.0;

inline scene::Scene sky_scene(double altitude_m, double sun_elevation_deg, double view_elevation_deg = 10.0,
                              double vertical_angle_deg = 90.0) {
    scene::Scene scene;
    scene.outdoors.emplace();
    scene.outdoors->sun = scene::Sun{.elevation_deg = sun_elevation_deg, .azimuth_deg = 30.0};
    scene::Camera camera;
    camera.eye_world = {0.0, altitude_m, 0.0};
    const double angle = view_elevation_deg * rad;
    camera.target_world = camera.eye_world + glm::dvec3(0.0, std::sin(angle), -std::cos(angle));
    camera.vertical_angle_deg = vertical_angle_deg;
    scene.camera = camera;
    return scene;
}

/// Radiance of air and, if wished, of a ground that is black: from a point relative to sea level below the camera, in
/// steps so fine that only those of the tables are left.
inline glm::dvec3 reference_sky(const reference::AtmosphereTables& tables, glm::dvec3 from, const glm::dvec3& direction,
                                const glm::dvec3& to_sun, int steps = 1000) {
    const scene::Atmosphere& air = tables.atmosphere();
    const glm::dvec3 center(0.0, -air.planet_radius_m, 0.0);
    // Into the air first, by the textbook form: doubles hold it.
    const glm::dvec3 out = from - center;
    const double top = air.planet_radius_m + air.height_m;
    const double b = glm::dot(out, direction), root = b * b - glm::dot(out, out) + top * top;
    if (glm::length(out) > top) {
        if (root <= 0.0 || b > 0.0) {
            return glm::dvec3(0.0);
        }
        from += (-b - std::sqrt(root)) * direction;
    }
    const glm::dvec3 up = glm::normalize(from - center);
    const double altitude = std::min(glm::length(from - center) - air.planet_radius_m, air.height_m);
    // A frame with y up there and the ray in the plane of x and y.
    const double climb = glm::dot(direction, up);
    const glm::dvec3 level = direction - climb * up;
    const glm::dvec3 x =
        glm::length(level) > 1e-9 ? glm::normalize(level) : glm::normalize(glm::cross(up, glm::dvec3(0.3, 0.1, 0.9)));
    const glm::dvec3 z = glm::cross(x, up);
    const glm::dvec3 local_direction(std::sqrt(std::max(0.0, 1.0 - climb * climb)), climb, 0.0);
    const glm::dvec3 local_sun(glm::dot(to_sun, x), glm::dot(to_sun, up), glm::dot(to_sun, z));
    return tables
        .air_light(altitude, local_direction, local_sun, reference::distance_to_end(air, altitude, climb), steps)
        .radiance;
}

}  // namespace bruma::render
