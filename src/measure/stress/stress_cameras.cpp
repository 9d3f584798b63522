#include <fmt/core.h>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

/// Half of the smooth volume of 16 mm.
constexpr double half = 8e-3;

scene::Scene seen_from(glm::dvec3 eye, glm::dvec3 target = glm::dvec3(0.0), double near_distance = 1e-6) {
    scene::Scene scene = stress_scene();
    scene.camera = scene::Camera{.eye_world = eye, .target_world = target, .near_distance = near_distance};
    return scene;
}

scene::Scene orthographic(glm::dvec3 eye, double height) {
    scene::Scene scene = seen_from(eye);
    scene.camera->edit([height](scene::Camera& c) {
        c.projection = scene::Projection::orthographic;
        c.view_height = height;
    });
    return scene;
}

scene::Scene with_angle(scene::Scene scene, double degrees) {
    scene.camera->edit([degrees](scene::Camera& c) { c.vertical_angle_deg = degrees; });
    return scene;
}

}  // namespace

void stress_cameras(StressRig& rig) {
    rig.group("cameras");
    constexpr double smooth = 1e-3;  // smooth data, quarter steps, and the table's 1/1020
    rig.picture("inside", "in the middle of the volume", seen_from({0.0, 0.0, 0.0}, {0.3, 0.2, -1.0}), smooth);
    rig.picture("inside-without-near", "the same with a near plane at 0",
                seen_from({0.0, 0.0, 0.0}, {0.3, 0.2, -1.0}, 0.0), smooth);
    rig.picture("on-face", "exactly on a face", seen_from({0.001, 0.002, half}), smooth);
    rig.picture("on-face-along", "on a face, looking along it", seen_from({-half, 0.0, half}, {half, 0.0, half}),
                smooth);
    rig.picture("on-edge", "exactly on an edge", seen_from({0.001, half, half}), smooth);
    rig.picture("on-edge-along", "on an edge, looking along it", seen_from({-0.02, half, half}, {0.02, half, half}),
                smooth);
    rig.picture("on-corner", "exactly on a corner", seen_from({half, half, half}), smooth);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            glm::dvec3 eye(0.0);
            eye[axis] = sign * 0.05;
            const std::string name = fmt::format("axis-{}{}", sign < 0.0 ? "-" : "", "xyz"[axis]);
            rig.picture(name, "exactly along an axis", seen_from(eye), smooth);
            eye[(axis + 1) % 3] = 1e-9;
            rig.picture(name + "-off", "1 nm off that axis", seen_from(eye), smooth);
            rig.picture(name + "-parallel", "all rays parallel to an axis",
                        orthographic(eye - glm::dvec3(eye[0] == 1e-9, eye[1] == 1e-9, eye[2] == 1e-9) * 1e-9, 0.03),
                        smooth);
        }
    }
    rig.picture("up-along-view", "looking along 'up'", seen_from({0.0, 0.05, 0.0}), smooth);
    rig.picture("up-nearly-along", "'up' 1e-9 off the view", seen_from({5e-11, 0.05, 0.0}), smooth);
    rig.picture(
        "grazing", "rays within a face, on the boundary of voxels",
        [] {
            scene::Scene scene = orthographic({0.0, 0.0, 0.05}, 2.0 * half);
            return scene;
        }(),
        smooth);
    rig.picture("1e3-extents", "a thousand extents away, narrow view", with_angle(seen_from({9.0, 6.0, 12.0}), 0.1),
                5e-3);  // positions round at 1e3 * 2^-24 of the box
    rig.picture("1e6-extents", "a million extents away, narrowest view", with_angle(seen_from({9e3, 6e3, 12e3}), 0.1));
    rig.picture("1e6-extents-parallel", "a million extents away, parallel rays", orthographic({9e3, 6e3, 12e3}, 0.03),
                smooth);
    rig.picture("near-beyond", "near plane behind the volume", seen_from({0.0, 0.0, 0.05}, glm::dvec3(0.0), 0.1), 1e-6);
    rig.picture("near-through", "near plane through the middle", seen_from({0.0, 0.0, 0.05}, glm::dvec3(0.0), 0.05),
                smooth);
    rig.picture("near-1e12", "near plane a light-hour away", seen_from({0.0, 0.0, 0.05}, glm::dvec3(0.0), 1e12), 1e-6);
    rig.picture("away", "volume behind the camera", seen_from({0.0, 0.0, 0.05}, {0.0, 0.0, 0.1}), 1e-6);
    rig.picture("angle-0.1", "a view of 0.1 degrees", with_angle(seen_from({0.01, 0.02, 0.05}), 0.1), smooth);
    rig.picture("angle-170", "a view of 170 degrees", with_angle(seen_from({0.003, 0.002, 0.012}), 170.0), smooth);
    rig.picture("angle-170-inside", "a view of 170 degrees, from inside",
                with_angle(seen_from({0.0, 0.0, 0.0}, {0.3, 0.2, -1.0}), 170.0), smooth);
    rig.picture("parallel-tiny", "parallel view of 1e-9 of the extent", orthographic({0.01, 0.02, 0.05}, 16e-12),
                smooth);
    rig.picture("parallel-huge", "parallel view of 1e9 times the extent", orthographic({0.01, 0.02, 0.05}, 16e6),
                smooth);
    rig.picture("parallel-inside", "parallel view from inside", orthographic({0.001, 0.002, 0.0}, 0.02), smooth);
}

}  // namespace bruma::measure
