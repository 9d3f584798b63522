#include <fmt/core.h>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

/// The usual scene with its volume moved, and the camera moved to where it is seen.
scene::Scene stress_scene_at(const scene::Transform& transform) {
    scene::Scene scene = stress_scene();
    scene.nodes.at("volume").transform = transform;
    look_at_all(scene);
    return scene;
}

/// Transfer function and transform grown alike, so that the picture should stay the same.
scene::Scene grown(double scale) {
    scene::Scene scene = stress_scene_at({.scale = glm::dvec3(scale)});
    stress_volume(scene).transfer_function.edit([scale](auto& tf) { tf.reference_length *= scale; });
    return scene;
}

scene::Scene clipped(glm::dvec3 low, glm::dvec3 high) {
    scene::Scene scene = stress_scene();
    stress_volume(scene).clip = scene::ClipBox{low, high};
    return scene;
}

}  // namespace

void stress_placement(StressRig& rig) {
    rig.group("placement");
    constexpr double smooth = 1e-3;  // smooth data, quarter steps, and the table's 1/1020
    rig.picture("scale-1e-6", "a millionth of the size", grown(1e-6), smooth);
    rig.picture("scale-1e6", "a million times the size", grown(1e6), smooth);
    rig.picture("mirrored", "scale -1 along x", stress_scene_at({.scale = {-1.0, 1.0, 1.0}}), smooth);
    rig.picture("mirrored-thrice", "scale -1 along all axes", stress_scene_at({.scale = glm::dvec3(-1.0)}), smooth);
    // Along the long axis the step is a thousandth of a voxel, so the march has many steps: rounding adds up.
    rig.picture("1-1-1000", "a thousand times longer along z", stress_scene_at({.scale = {1.0, 1.0, 1000.0}}), 5e-3);
    rig.picture("1000-1-1", "a thousand times longer along x", stress_scene_at({.scale = {1000.0, 1.0, 1.0}}), 5e-3);
    scene::Scene sheared = stress_scene();
    sheared.nodes["parent"] = {
        .parent = {},
        .transform = scene::Transform{.rotation_deg = {20.0, 50.0, -35.0}, .scale = {1.0, 3.0, 0.4}},
        .content = scene::Group{}};
    sheared.nodes.at("volume").parent = "parent";
    sheared.nodes.at("volume").transform = scene::Transform{.rotation_deg = {-40.0, 15.0, 70.0}};
    look_at_all(sheared);
    rig.picture("sheared", "turned inside a parent of unequal scale", sheared, smooth);
    rig.picture("far-off", "a hundred metres from the origin", stress_scene_at({.translation = {100.0, -70.0, 30.0}}),
                smooth);
    rig.picture("turned-1e6", "turned by a million degrees", stress_scene_at({.rotation_deg = {1e6, -1e6, 1e6}}),
                smooth);

    scene::Scene small_beside_large = stress_scene();
    add_volume(small_beside_large, "tiny", smooth_grid(), gentle_curves(), {.scale = glm::dvec3(1e-7)});
    rig.picture("tiny-in-large", "a volume ten million times smaller inside of another", small_beside_large);

    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 low(0.0), high(1.0);
        low[axis] = 0.5;
        high[axis] = 0.5 + 1e-6;
        rig.picture(fmt::format("clip-1e-6-{}", "xyz"[axis]), "a slice a millionth of the extent thick",
                    clipped(low, high), smooth);
    }
    rig.picture("clip-point", "a millionth along all axes", clipped(glm::dvec3(0.5), glm::dvec3(0.5 + 1e-6)), smooth);
    rig.picture("clip-1e-12", "thinner than floats tell apart", clipped({0.5, 0.0, 0.0}, {0.5 + 1e-12, 1.0, 1.0}),
                smooth);
    rig.picture("clip-corner", "one corner voxel", clipped(glm::dvec3(15.0 / 16.0), glm::dvec3(1.0)), smooth);
    rig.picture("clip-slab", "a slab, 0.37 voxel thick", clipped({0.0, 0.5, 0.0}, {1.0, 0.5 + 0.37 / 16.0, 1.0}),
                smooth);

    // One term of the fraction 2^-24 per position; with 1024 nothing but exponents change.
    const auto scale_invariance = [&rig](double factor) {
        scene::Scene one = grown(1.0);
        scene::Scene other = grown(factor);
        // The same camera, grown, and not one that was fitted anew.
        scene::Camera camera = **one.camera;
        camera.eye_world *= factor;
        camera.target_world *= factor;
        camera.view_height *= factor;
        camera.near_distance *= factor;
        other.camera = camera;
        return largest_difference(rig.draw(one), rig.draw(other));
    };
    rig.number("grown-1024", "every length times 1024 against the same picture", 1e-6,
               [&] { return scale_invariance(1024.0); });
    rig.number("grown-1000", "every length times 1000 against the same picture", 1e-4,
               [&] { return scale_invariance(1000.0); });
}

}  // namespace bruma::measure
