#pragma once
#include <memory>
#include <numbers>

#include "drawing.h"
#include "reference/sky/sky_picture.h"
#include "render/sky/sky_passes.h"

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

}  // namespace bruma::render
