#include <fmt/core.h>

#include "measure/stress/stress_light.h"

namespace bruma::measure {
namespace {

scene::Scene sampled(glm::ivec3 size) {
    scene::Scene scene =
        scattering_scene({}, float_grid(size, [](std::size_t n) { return 0.5 + 0.5 * std::sin(0.7 * double(n)); }));
    scene.rendering.edit([](scene::RenderSettings& s) { s.step = 1.0; });
    return scene;
}

scene::Scene at_resolution(scene::Scene scene, scene::LightResolution resolution) {
    stress_volume(scene).light_volume.edit([resolution](auto& settings) { settings.resolution = resolution; });
    return scene;
}

scene::Scene placed(const scene::Transform& transform) {
    scene::Scene scene = scattering_scene({});
    scene.nodes.at("volume").transform = transform;
    look_at_all(scene);
    return scene;
}

/// Relative error of the uniform cube a thousand times longer along an axis, of the same optical depth, lit and seen
/// along it.
double stretched_error(StressRig& rig, int axis) {
    glm::dvec3 scale(1.0), back(0.0);
    scale[axis] = 1000.0;
    back[axis] = 1.0;
    scene::Scene scene = uniform_scene(1e-3);
    take_way(scene, 0);
    scene.nodes.at("volume").transform = scene::Transform{.scale = scale};
    scene.lights.at("light").edit([back](scene::Light& light) { light.direction_world = back; });
    // Steps of 16 of the short edges: the software driver ends loops after 65535 turns.
    scene.rendering.edit([](scene::RenderSettings& s) { s.step = 16.0; });
    scene.camera = scene::fit_camera(scene::world_bounds(scene), 1.5, back, {back.y, back.x + back.z, 0.0});
    scene.camera->edit([](scene::Camera& camera) {
        camera.projection = scene::Projection::orthographic;
        camera.view_height = 20e-3;
    });
    const Image image = rig.draw(scene);
    return std::abs(double(*image.pixel(image.width / 2, image.height / 2)) / uniform_radiance(1.0) - 1.0);
}

Image flipped(const Image& image) {
    Image result(image.width, image.height);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            std::copy_n(image.pixel(x, y), 4, result.pixel(image.width - 1 - x, y));
        }
    }
    return result;
}

/// A volume, its light and its camera mirrored in x against the mirrored picture.
double mirror_error(StressRig& rig, int way) {
    scene::Scene scene = scattering_scene({});
    take_way(scene, way);
    const Image expected = flipped(rig.draw(scene));
    scene.nodes.at("volume").transform = scene::Transform{.scale = {-1.0, 1.0, 1.0}};
    scene.lights.at("light").edit([](scene::Light& light) { light.direction_world.x *= -1.0; });
    scene.camera->edit([](scene::Camera& camera) {
        camera.eye_world.x *= -1.0;
        camera.target_world.x *= -1.0;
    });
    return largest_difference(rig.draw(scene), expected);
}

/// Relative error of a uniform slab that is clipped to a share of its edge, lit and seen across it.
double slab_error(StressRig& rig, double share) {
    scene::Scene scene = uniform_scene(1.0);
    take_way(scene, 0);
    stress_volume(scene).clip = scene::ClipBox{{0.0, 0.0, 0.5}, {1.0, 1.0, 0.5 + share}};
    const Image image = rig.draw(scene);
    return std::abs(double(*image.pixel(image.width / 2, image.height / 2)) / uniform_radiance(share) - 1.0);
}

}  // namespace

void stress_light_shapes(StressRig& rig) {
    rig.group("shapes");
    // Light is kept in half precision, whose unit is 2^-11.
    constexpr double energy = 1.0 + 1e-3;
    constexpr const char* share = "share of what energy allows";
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(1, 1, 256), glm::ivec3(256, 1, 1), glm::ivec3(2),
                                  glm::ivec3(3), glm::ivec3(1, 33, 17)}) {
        for (const auto resolution :
             {scene::LightResolution::full, scene::LightResolution::half, scene::LightResolution::quarter}) {
            rig.number(fmt::format("{}x{}x{}-{}", size.x, size.y, size.z,
                                   scene::enum_words<scene::LightResolution>()[std::size_t(resolution)]),
                       share, energy, [&] { return share_of_allowed(rig, at_resolution(sampled(size), resolution)); });
        }
    }
    for (const double thickness : {0.5, 0.02, 1e-4, 1e-6}) {
        rig.number(fmt::format("clip-{:g}", thickness), "a slice, lit across: relative error to the closed form",
                   5e-3 + 0x1p-24 / thickness,  // where floats put its two ends
                   [&] { return slab_error(rig, thickness); });
    }
    rig.number("clip-1e-12", "thinner than floats tell apart", energy, [&] {
        scene::Scene scene = scattering_scene({});
        stress_volume(scene).clip = scene::ClipBox{glm::dvec3(0.5), glm::dvec3(0.5 + 1e-12)};
        return share_of_allowed(rig, scene);
    });
    for (int way = 0; way < light_ways; ++way) {
        // Sampling positions round differently on the other side of the origin.
        rig.number(fmt::format("mirrored-{}", way), "all mirrored in x, against the mirrored picture", 1e-4,
                   [&] { return mirror_error(rig, way); });
    }
    rig.number("mirrored-thrice", share, energy,
               [&] { return share_of_allowed(rig, placed({.scale = glm::dvec3(-1.0)})); });
    for (int axis = 0; axis < 3; ++axis) {
        rig.number(fmt::format("1000-times-{}", "xyz"[axis]),
                   "a uniform cube longer along that axis, seen along it: relative error to the closed form", 5e-3,
                   [&] { return stretched_error(rig, axis); });
    }
    rig.number("scale-1e-9", share, energy, [&] { return share_of_allowed(rig, placed({.scale = glm::dvec3(1e-9)})); });
    rig.number("sheared", "turned inside a parent of unequal scale: share of what energy allows", energy, [&] {
        scene::Scene scene = scattering_scene({});
        scene.nodes["parent"] = {
            .parent = {},
            .transform = scene::Transform{.rotation_deg = {20.0, 50.0, -35.0}, .scale = {1.0, 30.0, 0.1}},
            .content = scene::Group{}};
        scene.nodes.at("volume").parent = "parent";
        scene.nodes.at("volume").transform = scene::Transform{.rotation_deg = {-40.0, 15.0, 70.0}};
        look_at_all(scene);
        return share_of_allowed(rig, scene);
    });
    for (const int slices : {1, 2, 3, 7, 64, 4096}) {
        rig.number(fmt::format("slices_per_dispatch-{}", slices), "against the chosen number of slices", 0.0, [&] {
            scene::Scene scene = scattering_scene({});
            stress_volume(scene).light_volume.edit([slices](auto& s) { s.slices_per_dispatch = slices; });
            return difference_in_all_ways(rig, scene, scattering_scene({}));
        });
    }
}

}  // namespace bruma::measure
