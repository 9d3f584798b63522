// Closed form: what a movement keeps (distance, up, size in the picture) is known exactly.
#include "app/viewer/orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace bruma::app {
namespace {

scene::Camera some_camera() {
    scene::Camera camera;
    camera.eye_world = {0.3, 0.4, 1.2};
    camera.target_world = {0.1, -0.2, 0.05};
    return camera;
}

double distance_of(const scene::Camera& camera) {
    return glm::length(camera.eye_world - camera.target_world);
}

// A few units in the last place of numbers around 1.
constexpr double rounding = 1e-12;

TEST(Orbit, KeepsDistanceTargetAndUpThroughAnyDrag) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-2.0, 2.0);
    scene::Camera camera = some_camera();
    const scene::Camera first = camera;
    for (int n = 0; n < 1000; ++n) {
        camera = orbited(camera, angle(random), angle(random));
        EXPECT_NEAR(distance_of(camera), distance_of(first), 1e3 * rounding);
        EXPECT_EQ(camera.target_world, first.target_world);
        // The picture never stands on its head.
        EXPECT_GT(glm::dot(scene::camera_frame(camera).up_world, camera.up_world), 0.0);
    }
}

TEST(Orbit, DragToTheRightTurnsTheSceneToTheRight) {
    const scene::Camera camera = some_camera();
    const scene::CameraFrame before = scene::camera_frame(camera);
    const scene::Camera moved = orbited(camera, 0.1, 0.0);
    EXPECT_LT(glm::dot(moved.eye_world - camera.eye_world, before.right_world), 0.0);
    const scene::Camera raised = orbited(camera, 0.0, 0.1);
    EXPECT_GT(glm::dot(raised.eye_world - camera.eye_world, camera.up_world), 0.0);
}

TEST(Orbit, ComesBackByTheOppositeDrag) {
    const scene::Camera camera = some_camera();
    const scene::Camera back = orbited(orbited(camera, 0.7, 0.2), -0.7, -0.2);
    EXPECT_LT(glm::length(back.eye_world - camera.eye_world), rounding);
}

TEST(Orbit, LeavesPoles) {
    scene::Camera camera = seen_from_side(some_camera(), Side::top);
    camera = orbited(camera, 0.0, -0.5);
    EXPECT_LT(scene::camera_frame(camera).back_world.y, 0.9);
    scene::Camera exactly_above = some_camera();
    exactly_above.eye_world = exactly_above.target_world + glm::dvec3(0.0, 2.0, 0.0);
    exactly_above = orbited(exactly_above, 0.3, -0.4);
    EXPECT_TRUE(std::isfinite(glm::dot(exactly_above.eye_world, exactly_above.eye_world)));
    EXPECT_NEAR(distance_of(exactly_above), 2.0, rounding);
}

TEST(Pan, ThePointUnderTheHandFollowsIt) {
    for (const auto projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
        scene::Camera camera = some_camera();
        camera.projection = projection;
        const scene::Camera moved = panned(camera, {30.0, -20.0}, 400.0);
        // The old target must now be seen 30 pixels further right and 20 further up.
        const scene::Ray ray = scene::camera_ray(moved, 300.0 + 30.0, 200.0 - 20.0, 600, 400);
        const glm::dvec3 to_target = camera.target_world - ray.origin_world;
        const glm::dvec3 off = to_target - ray.direction_world * glm::dot(to_target, ray.direction_world);
        EXPECT_LT(glm::length(off), rounding);
    }
}

TEST(Zoom, ScalesDistanceAndHeight) {
    const scene::Camera camera = some_camera();
    const scene::Camera nearer = zoomed(camera, 0.5);
    EXPECT_NEAR(distance_of(nearer), 0.5 * distance_of(camera), rounding);
    EXPECT_DOUBLE_EQ(nearer.view_height, 0.5 * camera.view_height);
    EXPECT_EQ(zoomed(camera, 0.0), camera);
}

TEST(Sides, AreAtRightAngles) {
    const scene::Camera camera = some_camera();
    const auto back = [&](Side side) { return scene::camera_frame(seen_from_side(camera, side)).back_world; };
    // The poles keep a margin of a thousandth of a radian.
    EXPECT_LT(glm::length(back(Side::front) - glm::dvec3(0.0, 0.0, 1.0)), rounding);
    EXPECT_LT(glm::length(back(Side::back) - glm::dvec3(0.0, 0.0, -1.0)), rounding);
    EXPECT_LT(glm::length(back(Side::right) - glm::dvec3(1.0, 0.0, 0.0)), rounding);
    EXPECT_LT(glm::length(back(Side::left) - glm::dvec3(-1.0, 0.0, 0.0)), rounding);
    EXPECT_LT(glm::length(back(Side::top) - glm::dvec3(0.0, 1.0, 0.0)), 1.1e-3);
    EXPECT_LT(glm::length(back(Side::bottom) - glm::dvec3(0.0, -1.0, 0.0)), 1.1e-3);
}

TEST(Projection, TheTargetKeepsItsSize) {
    const scene::Camera camera = some_camera();
    const scene::Camera flat = with_other_projection(camera);
    EXPECT_EQ(flat.projection, scene::Projection::orthographic);
    EXPECT_NEAR(flat.view_height, 2.0 * distance_of(camera) * std::tan(glm::radians(15.0)), rounding);
    const scene::Camera back = with_other_projection(flat);
    EXPECT_LT(glm::length(back.eye_world - camera.eye_world), rounding);
}

}  // namespace
}  // namespace bruma::app
