#include <fmt/core.h>

#include <array>
#include <numbers>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/builtin_clouds.h"
#include "scene/builtin/builtin_mesh_scenes.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

using std::numbers::pi;
constexpr double usual_aspect = 16.0 / 9.0;

Volume shown_builtin(const std::string& name, VolumeLighting lighting) {
    Volume volume;
    volume.source.file = "builtin:" + name;
    volume.grid = builtin_volume(name);
    volume.transfer_function = suggested_transfer_function(**volume.grid);
    volume.optics.edit([&](VolumeOptics& optics) {
        optics.lighting = lighting;
        optics.ambient = 0.08;
        optics.specular = 0.35;
        optics.shininess = 40.0;
    });
    return volume;
}

Node node(Volume volume, const Transform& transform = {}, const std::string& parent = {}) {
    return {.parent = parent, .visible = true, .transform = transform, .content = std::move(volume)};
}

/// A warm key from the upper left, a cool fill from the right, and a little light along the view, so that no side is
/// lost in the dark.
void light_as_in_a_studio(Scene& scene) {
    scene.lights["key"] =
        Light{.direction_world = {-0.55, 0.8, 0.55}, .color = {1.0, 0.90, 0.76}, .intensity = 0.9 * pi};
    scene.lights["fill"] =
        Light{.direction_world = {0.9, 0.15, 0.35}, .color = {0.55, 0.72, 1.0}, .intensity = 0.35 * pi};
    scene.lights["head"] = Light{.kind = LightKind::headlight, .intensity = 0.1 * pi};
    scene.background = Background{.top = {0.004, 0.005, 0.008}, .bottom = {0.030, 0.034, 0.044}};
}

/// Stands where all is seen, `closer` times nearer than the sphere around everything needs.
void look_from(Scene& scene, const glm::dvec3& back_world, double closer) {
    Camera camera = fit_camera(world_bounds(scene), usual_aspect, back_world);
    camera.eye_world = camera.target_world + (camera.eye_world - camera.target_world) / closer;
    camera.view_height /= closer;
    scene.camera = camera;
}

Scene demo() {
    Scene scene;
    light_as_in_a_studio(scene);
    Volume engine = shown_builtin("engine", VolumeLighting::gradient);
    // Open the front, so that the cut goes through the middle of the bores.
    engine.clip = ClipBox{.low = {0.0, 0.0, 0.0}, .high = {1.0, 1.0, 0.55}};
    scene.nodes["engine"] = node(std::move(engine));
    look_from(scene, {0.45, 0.30, 0.9}, 1.75);
    return scene;
}

Scene bucky_cluster() {
    Scene scene;
    light_as_in_a_studio(scene);
    scene.nodes["molecules"] = {
        .parent = {}, .transform = Transform{.rotation_deg = {0.0, 20.0, 0.0}}, .content = Group{}};
    const Volume bucky = shown_builtin("bucky", VolumeLighting::gradient);
    scene.nodes["bucky-large"] =
        node(bucky, {.translation = {-0.034, 0.0, 0.0}, .rotation_deg = {12.0, 0.0, 8.0}}, "molecules");
    scene.nodes["bucky-middle"] = node(
        bucky, {.translation = {0.030, 0.012, 0.012}, .rotation_deg = {-20.0, 35.0, 0.0}, .scale = glm::dvec3(0.7)},
        "molecules");
    scene.nodes["bucky-small"] = node(
        bucky, {.translation = {0.020, -0.026, 0.034}, .rotation_deg = {50.0, 10.0, 0.0}, .scale = glm::dvec3(0.4)},
        "molecules");
    look_from(scene, {0.15, 0.25, 0.95}, 1.9);
    return scene;
}

Scene orbital() {
    Scene scene;
    light_as_in_a_studio(scene);
    scene.nodes["hydrogen"] =
        node(shown_builtin("hydrogen", VolumeLighting::none), {.rotation_deg = {0.0, 0.0, -20.0}});
    look_from(scene, {0.3, 0.25, 0.9}, 1.4);
    return scene;
}

Scene knots() {
    Scene scene;
    light_as_in_a_studio(scene);
    scene.nodes["knot"] = node(shown_builtin("knot", VolumeLighting::gradient), {.rotation_deg = {-25.0, 0.0, 0.0}});
    look_from(scene, {0.2, 0.3, 0.9}, 1.6);
    return scene;
}

/// Warm light from the left, blue light from behind the right, which shows what comes through, and a little from above.
void light_from_three_sides(Scene& scene) {
    scene.lights["left"] =
        Light{.direction_world = {-0.85, 0.45, 0.45}, .color = {1.0, 0.5, 0.18}, .intensity = 3.0 * pi};
    scene.lights["right"] =
        Light{.direction_world = {0.85, 0.2, -0.6}, .color = {0.15, 0.4, 1.0}, .intensity = 4.6 * pi};
    scene.lights["above"] =
        Light{.direction_world = {0.1, 1.0, -0.2}, .color = {0.92, 1.0, 0.88}, .intensity = 0.4 * pi};
    scene.background = Background{.top = {0.004, 0.005, 0.008}, .bottom = {0.030, 0.034, 0.044}};
}

/// The engine of wax around red metal: thin enough for light to enter, thick enough for shadows.
Scene scattering() {
    Scene scene;
    light_from_three_sides(scene);
    Volume engine = shown_builtin("engine", VolumeLighting::light_volume);
    engine.clip = ClipBox{.low = {0.0, 0.0, 0.0}, .high = {1.0, 1.0, 0.55}};
    engine.transfer_function.edit([](TransferFunction& tf) {
        tf.opacity = {{0.0, 0.0}, {0.14, 0.0}, {0.3, 0.42},  {0.42, 0.34},
                      {0.5, 0.3}, {0.62, 0.5}, {0.72, 0.98}, {1.0, 0.99}};
        tf.color = {{0.0, {0.75, 0.85, 0.95}},
                    {0.5, {0.85, 0.90, 0.95}},
                    {0.62, {0.95, 0.50, 0.25}},
                    {0.75, {0.95, 0.32, 0.10}},
                    {1.0, {0.95, 0.42, 0.14}}};
    });
    engine.optics.edit([](VolumeOptics& optics) { optics.albedo = glm::dvec3(0.97); });
    scene.nodes["engine"] = node(std::move(engine));
    look_from(scene, {0.45, 0.30, 0.9}, 1.75);
    return scene;
}

/// A dense cloud of soot and water: what has gone through it is as plain as what comes back.
Scene scattering_blobs() {
    Scene scene;
    light_from_three_sides(scene);
    Volume blobs = shown_builtin("blobs", VolumeLighting::light_volume);
    blobs.transfer_function.edit([](TransferFunction& tf) {
        tf.opacity = {{0.0, 0.0}, {0.05, 0.0}, {0.3, 0.24}, {1.0, 0.75}};
        tf.color = {{0.0, {0.97, 0.98, 1.0}}};
    });
    blobs.optics.edit([](VolumeOptics& optics) {
        optics.albedo = glm::dvec3(0.8);
        optics.g = 0.3;
    });
    scene.nodes["blobs"] = node(std::move(blobs));
    look_from(scene, {0.5, 0.25, 0.85}, 2.3);
    return scene;
}

/// Above a plain, the sun to the left of the view.
Scene under_the_sun(double elevation_deg, double azimuth_deg, double exposure_ev) {
    Scene scene;
    scene.outdoors.emplace();
    scene.outdoors->sun = Sun{.elevation_deg = elevation_deg, .azimuth_deg = azimuth_deg};
    scene.display = Display{.exposure_ev = exposure_ev, .tone_map = ToneMap::filmic};
    scene.camera = Camera{.eye_world = {0.0, 1.7, 0.0}, .target_world = {0.0, 2.05, -1.0}, .vertical_angle_deg = 60.0};
    return scene;
}

Scene sky_noon() {
    return under_the_sun(38.0, -38.0, 4.4);
}

Scene sky_sunset() {
    return under_the_sun(1.5, -20.0, 6.0);
}

Scene sky_twilight() {
    return under_the_sun(-5.0, -20.0, 10.4);
}

/// The pot in the garden in the late afternoon.
Scene pot_outdoors() {
    Scene scene = under_the_sun(22.0, -110.0, 4.0);
    Mesh pot;
    pot.source.file = "builtin:pot";
    pot.triangles = builtin_mesh("pot").mesh;
    pot.surface.edit([](MeshSurface& surface) { surface.diffuse_color = {0.55, 0.25, 0.14}; });
    const Transform on_ground{.translation = {0.0, -(*pot.triangles)->low.y, 0.0}};
    scene.nodes["pot"] = {.parent = {}, .visible = true, .transform = on_ground, .content = std::move(pot)};
    look_from(scene, {0.25, 0.1, 0.9}, 1.3);
    return scene;
}

struct BuiltinScene {
    const char* name;
    Scene (*make)();
};
constexpr std::array builtin_scenes{
    BuiltinScene{"demo", demo},
    BuiltinScene{"bucky-cluster", bucky_cluster},
    BuiltinScene{"orbital", orbital},
    BuiltinScene{"knot-study", knots},
    BuiltinScene{"scattering", scattering},
    BuiltinScene{"scattering-blobs", scattering_blobs},
    BuiltinScene{"translucent", translucent_scene},
    BuiltinScene{"sky-noon", sky_noon},
    BuiltinScene{"sky-sunset", sky_sunset},
    BuiltinScene{"sky-twilight", sky_twilight},
    BuiltinScene{"pot-outdoors", pot_outdoors},
    BuiltinScene{"clouds-under-sky", clouds_under_sky_scene},
    BuiltinScene{"clouds-shafts", clouds_shafts_scene},
    BuiltinScene{"clouds-over-ground", clouds_over_ground_scene},
};

}  // namespace

std::vector<std::string> builtin_scene_names() {
    std::vector<std::string> names;
    names.reserve(builtin_scenes.size());
    for (const BuiltinScene& builtin : builtin_scenes) {
        names.emplace_back(builtin.name);
    }
    for (const std::string_view name : builtin_cloud_scenes()) {
        names.emplace_back(name);
    }
    return names;
}

Scene builtin_scene(const std::string& name) {
    for (const BuiltinScene& builtin : builtin_scenes) {
        if (name == builtin.name) {
            return builtin.make();
        }
    }
    const auto cloud_scenes = builtin_cloud_scenes();
    for (std::size_t n = 0; n < cloud_scenes.size(); ++n) {
        if (name == cloud_scenes[n]) {
            return builtin_cloud_scene(CloudType(n));
        }
    }
    throw InputError(
        fmt::format("builtin:{}: there is no such scene{}", name, suggestion(name, builtin_scene_names())));
}

}  // namespace bruma::scene
