#include "scene/builtin/builtin_clouds.h"

#include <cmath>
#include <numbers>

#include "scene/builtin/mesh_builtin.h"

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

Clouds& clouds_in(Scene& scene) {
    return std::get<Clouds>(scene.nodes.at("sky").content);
}

Scene clouds_under_sky_scene() {
    Scene scene = builtin_cloud_scene(CloudType::cumulus);
    scene.lights.clear();
    scene.environment = Environment{};
    scene.background = Background{};
    scene.outdoors.emplace();
    scene.outdoors->sun = Sun{.elevation_deg = 38.0, .azimuth_deg = -30.0};
    scene.display = Display{.exposure_ev = 3.6, .tone_map = ToneMap::filmic};
    scene.camera->edit([](Camera& camera) { camera.target_world = camera.eye_world + glm::dvec3(0.0, 0.22, -1.0); });
    return scene;
}

Scene clouds_over_ground_scene() {
    Scene scene = clouds_under_sky_scene();
    scene.outdoors->sun = Sun{.elevation_deg = 48.0, .azimuth_deg = -70.0};
    Mesh hills;
    hills.source = {.file = "builtin:hills", .millimetres_per_unit = 250e3};
    hills.triangles = builtin_mesh("hills", hills.source).mesh;
    hills.surface.edit([](MeshSurface& surface) { surface.shading = MeshShading::lambert; });
    Node ground;
    ground.content = std::move(hills);
    scene.nodes["ground"] = std::move(ground);
    scene.camera = Camera{.eye_world = {0.0, 1300.0, 9000.0},
                          .target_world = {0.0, 1180.0, 8000.0},
                          .vertical_angle_deg = 50.0,
                          .near_distance = 1.0};
    return scene;
}

Scene clouds_shafts_scene() {
    Scene scene = clouds_under_sky_scene();
    scene.outdoors->sun = Sun{.elevation_deg = 16.0, .azimuth_deg = 6.0};
    scene.outdoors->atmosphere.edit([](Atmosphere& air) { air.mie_scattering_per_m = 9e-5; });
    std::get<Clouds>(scene.nodes.at("sky").content).layer.edit([](CloudLayer& layer) { layer.coverage = 0.42; });
    scene.time.edit([](Timeline& timeline) { timeline.now_s = 600.0; });
    scene.display = Display{.exposure_ev = 2.0, .tone_map = ToneMap::filmic};
    return scene;
}

}  // namespace bruma::scene
