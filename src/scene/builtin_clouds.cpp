#include "scene/builtin_clouds.h"

#include <cmath>
#include <numbers>

namespace bruma::scene {
namespace {

/// In the order of CloudType.
constexpr std::array<std::string_view, 6> names{
    "clouds-cumulus", "clouds-stratocumulus", "clouds-stratus", "altocumulus", "cirrus", "cumulonimbus"};

}  // namespace

std::span<const std::string_view> builtin_cloud_scenes() {
    return names;
}

Scene builtin_cloud_scene(CloudType type) {
    Scene scene;
    const double elevation = glm::radians(45.0);
    const double azimuth = glm::radians(215.0);  // over the left shoulder of who looks north-east
    scene.lights["sun"] = Light{.direction_world = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                                    -std::cos(elevation) * std::cos(azimuth)},
                                .color = {1.0, 0.95, 0.88},
                                .intensity = 2.0 * std::numbers::pi};
    scene.environment = Environment{.radiance = {0.20, 0.28, 0.42}};
    scene.background = Background{.top = {0.06, 0.14, 0.36}, .bottom = {0.36, 0.47, 0.62}};
    scene.display = Display{.exposure_ev = 0.7, .tone_map = ToneMap::filmic};
    Clouds clouds = preset_clouds(type);
    make_missing_map(clouds);
    Node node;
    node.content = std::move(clouds);
    scene.nodes["sky"] = std::move(node);
    Camera camera;
    camera.eye_world = {0.0, 2.0, 0.0};
    camera.target_world = camera.eye_world + glm::dvec3(0.5, 0.3, -0.8);
    camera.vertical_angle_deg = 42.0;
    camera.near_distance = 0.1;
    scene.camera = camera;
    return scene;
}

}  // namespace bruma::scene
