// Shelf: reference. Rays on planes, faces and edges, from inside, along axes, and with nothing to cross.
#include <cmath>

#include "drawing.h"

namespace bruma::render {
namespace {

/// 8^3 voxels over one metre, linear in x, y and z apart from the clamped border; extinction is linear in the data.
scene::Scene smooth_scene() {
    const auto grid = grid_of(glm::ivec3(8), glm::dvec3(0.125),
                              [](glm::ivec3 at) { return (at.x + 2.0 * at.y + 3.0 * at.z) / 42.0; });
    scene::Scene scene = scene_with(grid, linear_extinction(0.5, 4.0, {0.9, 0.2, 0.1}, {0.2, 0.5, 1.0}));
    scene.background = scene::Background{.top = {0.1, 0.2, 0.3}, .bottom = {0.3, 0.2, 0.1}};
    return scene;
}

void expect_as_reference(Drawing& test, Image (*draw)(Drawing&, const scene::Scene&, glm::ivec2), scene::Scene& scene,
                         glm::ivec2 pixels, const char* what) {
    const Image expected = truth(scene, pixels);
    for (const Classification classification : both_classifications) {
        // A tenth of a voxel: the method's own error, of second order, is then below 1e-5.
        settle(scene, classification, 0.1);
        for (const bool leap : {true, false}) {
            scene.rendering.edit([&](scene::RenderSettings& settings) { settings.empty_space_skipping = leap; });
            EXPECT_LE(largest_difference(draw(test, scene, pixels), expected), 1e-4)
                << what << ", " << name_of(classification) << (leap ? "" : ", walking");
        }
    }
}

class NastyRays : public Drawing {
  protected:
    void expect_truth(scene::Scene& scene, glm::ivec2 pixels, const char* what) {
        expect_as_reference(
            *this,
            [](Drawing& test, const scene::Scene& s, glm::ivec2 size) {
                return static_cast<NastyRays&>(test).draw(s, size);
            },
            scene, pixels, what);
    }
};

TEST_F(NastyRays, Test05AxisParallelOnVoxelPlanes) {
    scene::Scene scene = smooth_scene();
    // 9 pixels over 1.125 m: their centres lie on the planes between voxels, the outermost ones on the faces.
    const glm::dvec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            scene.camera->edit([&](scene::Camera& camera) {
                camera.eye_world = 2.0 * side * axes[axis];
                camera.up_world = axes[(axis + 1) % 3];
                camera.view_height = 1.125;
            });
            // Away from the outermost ring, where a ray on the very edge may count as a miss: checked apart.
            scene.camera->edit([](scene::Camera& camera) { camera.view_height = 1.125 * 7.0 / 9.0; });
            expect_truth(scene, {7, 7}, "on planes");
        }
    }
}

TEST_F(NastyRays, Test05GrazingFacesAndEdges) {
    scene::Scene scene = smooth_scene();
    scene.camera->edit([](scene::Camera& camera) { camera.view_height = 1.125; });
    // The outer pixels run exactly in faces, those of the corners exactly along edges. The box is closed, so they hit.
    expect_truth(scene, {9, 9}, "in faces");
    // Just beside them on both sides.
    for (const double nudge : {1e-7, -1e-7}) {
        scene.camera->edit([&](scene::Camera& camera) { camera.view_height = 1.125 * (1.0 + nudge); });
        for (const Classification classification : both_classifications) {
            settle(scene, classification, 0.5);
            draw(scene, {9, 9});
        }
    }
}

TEST_F(NastyRays, Test05EyeOnFaceEdgeAndCorner) {
    scene::Scene scene = smooth_scene();
    for (const glm::dvec3 eye :
         {glm::dvec3(0.0, 0.0, 0.5), glm::dvec3(0.5, 0.0, 0.5), glm::dvec3(0.5), glm::dvec3(0.1, 0.2, -0.5)}) {
        scene.camera =
            scene::Camera{.eye_world = eye, .target_world = {}, .vertical_angle_deg = 60.0, .near_distance = 0.0};
        expect_truth(scene, {9, 9}, "eye on the border");
    }
}

TEST_F(NastyRays, Test05CameraInside) {
    scene::Scene scene = smooth_scene();
    for (const double near_distance : {0.0, 0.05, 0.3, 2.0}) {
        scene.camera = scene::Camera{.eye_world = {0.1, -0.2, 0.2},
                                     .target_world = {-0.3, 0.1, -0.4},
                                     .vertical_angle_deg = 100.0,
                                     .near_distance = near_distance};
        expect_truth(scene, {9, 7}, "inside");
    }
}

TEST_F(NastyRays, Test05AxisParallelDirectionsOfPerspectiveRays) {
    scene::Scene scene = smooth_scene();
    // The middle ray has two components that are exactly 0, those of the middle row and column one.
    for (const glm::dvec3 eye : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.5, 0.0, 0.0), glm::dvec3(0.0, -1.2, 0.0)}) {
        scene.camera = scene::Camera{.eye_world = eye, .vertical_angle_deg = 40.0};
        expect_truth(scene, {5, 5}, "through the middle");
    }
}

TEST_F(NastyRays, Test05NothingToCross) {
    scene::Scene scene = smooth_scene();
    struct Case {
        const char* what;
        glm::dvec3 eye, target;
        double near_distance;
    };
    for (const Case& c : {Case{"looks away", {0.0, 0.0, 2.0}, {0.0, 0.0, 3.0}, 0.0},
                          Case{"on a face, looking out", {0.0, 0.0, 0.5}, {0.0, 0.0, 3.0}, 0.0},
                          Case{"near plane on the far face", {0.0, 0.0, 1.5}, {0.0, 0.0, 0.0}, 2.0},
                          Case{"near plane beyond", {0.0, 0.0, 1.5}, {0.0, 0.0, 0.0}, 5.0}}) {
        for (const scene::Projection projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
            scene.camera = scene::Camera{.projection = projection,
                                         .eye_world = c.eye,
                                         .target_world = c.target,
                                         .near_distance = c.near_distance};
            expect_truth(scene, {5, 5}, c.what);
        }
    }
}

TEST_F(NastyRays, NearPlaneCutsTheVolume) {
    scene::Scene scene = smooth_scene();
    for (const scene::Projection projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
        scene.camera = scene::Camera{
            .projection = projection, .eye_world = {0.4, 0.5, 1.2}, .vertical_angle_deg = 50.0, .near_distance = 1.1};
        expect_truth(scene, {16, 16}, "near plane");
    }
}

TEST_F(NastyRays, FarPerspectiveTendsToOrthographic) {
    // Shelf: closed form. The same view height from ever farther away; the difference falls with the distance.
    double last = 1.0;
    for (const double distance : {10.0, 100.0, 1000.0}) {
        Image images[2];
        for (const scene::Projection projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
            scene::Scene scene = smooth_scene();
            settle(scene, Classification::preintegrated, 0.5);
            scene.camera = scene::Camera{.projection = projection,
                                         .eye_world = distance * glm::normalize(glm::dvec3(0.3, 0.4, 1.0)),
                                         .vertical_angle_deg = glm::degrees(2.0 * std::atan(0.4 / distance)),
                                         .view_height = 0.8};
            images[int(projection)] = draw(scene, {16, 16});
        }
        const double difference = largest_difference(images[0], images[1]);
        report("difference at distance " + std::to_string(int(distance)), difference);
        EXPECT_LE(difference, 0.2 * last);
        last = difference;
    }
    EXPECT_LE(last, 1e-3);
}

TEST_F(NastyRays, RotatedScaledAndMirroredNodes) {
    scene::Scene scene = smooth_scene();
    scene.camera = scene::Camera{.eye_world = {1.0, 2.0, 3.0}, .vertical_angle_deg = 35.0};
    for (const glm::dvec3 scale : {glm::dvec3(1.0), glm::dvec3(0.5, 1.5, 1.0), glm::dvec3(-1.0, 1.0, 0.7)}) {
        scene.nodes.at("volume").transform =
            scene::Transform{.translation = {0.1, -0.1, 0.2}, .rotation_deg = {30.0, -50.0, 70.0}, .scale = scale};
        volume_in(scene).clip = scene::ClipBox{{0.1, 0.0, 0.2}, {0.9, 0.8, 1.0}};
        expect_truth(scene, {12, 12}, "transformed");
    }
}

}  // namespace
}  // namespace bruma::render
