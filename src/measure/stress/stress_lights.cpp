#include "base/error.h"
#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

scene::Scene lit_by(const scene::Light& light, std::shared_ptr<const scene::VolumeGrid> grid = smooth_grid()) {
    scene::Scene scene = stress_scene(std::move(grid));
    scene.lights["light"] = light;
    stress_volume(scene).optics.edit([](scene::VolumeOptics& o) { o.lighting = scene::VolumeLighting::gradient; });
    return scene;
}

scene::Light point_at(glm::dvec3 position, double intensity) {
    return {.kind = scene::LightKind::point, .position_world = position, .intensity = intensity};
}

scene::Scene lit_with_optics(const std::function<void(scene::VolumeOptics&)>& change) {
    scene::Scene scene = lit_by({});
    stress_volume(scene).optics.edit(change);
    return scene;
}

}  // namespace

void stress_lights(StressRig& rig) {
    rig.group("lights");
    // A segment is lit at its middle, with the normal there; over a quarter of a voxel that is a small, smooth error.
    constexpr double shaded = 1e-2;
    rig.picture("directional", "a usual light", lit_by({}), shaded);
    rig.picture("headlight", "along the view", lit_by({.kind = scene::LightKind::headlight}), shaded);
    rig.picture("point", "a usual point light", lit_by(point_at({0.02, 0.03, 0.03}, 2e-3)), shaded);
    // Its irradiance has no bound, so no picture is near to the true one; it must be finite.
    rig.picture("point-inside", "a point light inside of a voxel", lit_by(point_at({1.1e-3, 0.7e-3, 0.3e-3}, 1e-4)));
    rig.picture("point-on-sample", "a point light exactly on a sample",
                lit_by(point_at({0.5e-3, 0.5e-3, 0.5e-3}, 1e-4)));
    scene::Scene at_camera = lit_by({});
    at_camera.lights["light"] = point_at((*at_camera.camera)->eye_world, 1e-3);
    rig.picture("point-at-camera", "a point light in the eye", at_camera, shaded);
    rig.picture("point-far", "a point light 1e9 m away", lit_by(point_at({1e9, 1e9, 0.0}, 1e9)), shaded);
    rig.picture("intensity-1e9", "a light of 1e9", lit_by({.intensity = 1e9}), shaded);
    rig.picture("point-1e9-inside", "a point light of 1e9 and colour 1e6 inside", [] {
        scene::Light light = point_at({1.1e-3, 0.7e-3, 0.3e-3}, 1e9);
        light.color = glm::dvec3(1e6);
        return lit_by(light);
    }());
    rig.picture("black", "a light of colour 0", lit_by({.color = glm::dvec3(0.0)}), shaded);
    rig.picture("off", "a light that is off", lit_by({.on = false}), shaded);
    rig.picture("direction-1e-100", "a direction hardly long", lit_by({.direction_world = {1e-100, 1e-100, 0.0}}));
    rig.number("direction-1e300", "a direction too long to square: refused", 0.0, [] {
        try {
            scene::check(lit_by({.direction_world = {1e300, 1e300, 0.0}}));
        } catch (const InputError&) {
            return 0.0;
        }
        return 1.0;
    });
    scene::Scene none = lit_by({});
    none.lights.clear();
    rig.picture("no-light", "shading without any light", none, shaded);
    rig.picture("constant", "gradients of constant data",
                lit_by({}, float_grid(glm::ivec3(8), [](std::size_t) { return 0.5; })), 1e-3);
    rig.picture("1x1x1", "the gradient of a single sample",
                lit_by({}, float_grid({1, 1, 1}, [](std::size_t) { return 0.5; })), 1e-3);
    rig.picture("noise", "gradients of noise",
                lit_by({}, float_grid(glm::ivec3(10), [](std::size_t n) { return stress_noise(n); })),
                0.1);  // shading changes by its whole range within a voxel
    rig.picture(
        "float-largest", "gradients of -3.4e38 and 3.4e38",
        lit_by({}, float_grid(glm::ivec3(6), [](std::size_t n) { return stress_noise(n) < 0.5 ? -3.4e38 : 3.4e38; })));
    rig.picture("shininess-1000", "the smallest highlight", lit_with_optics([](auto& o) { o.shininess = 1000.0; }),
                shaded);
    rig.picture("phong-1", "the widest, mirrored", lit_with_optics([](auto& o) {
                    o.shininess = 1.0;
                    o.highlight = scene::Highlight::phong;
                }),
                shaded);
    rig.picture("soft-0", "no soft hand at all", lit_with_optics([](auto& o) {
                    o.gradient_soft_from = 0.0;
                    o.gradient_soft_to = 0.0;
                }),
                shaded);
    rig.picture("anisotropic", "lit in a volume of 1 : 1 : 1000", [] {
        scene::Scene scene = lit_by({});
        scene.nodes.at("volume").transform = scene::Transform{.scale = {1.0, 1.0, 1000.0}};
        look_at_all(scene);
        return scene;
    }());
}

}  // namespace bruma::measure
