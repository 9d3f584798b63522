// Shelf: the full march. Pictures made a sixteenth at a time from the last one, against all of it marched.
#include <fmt/core.h>

#include <cmath>

#include "cloud_scenes.h"
#include "drawing.h"
#include "measure/metrics/image_error.h"

namespace bruma::render {
namespace {

class CloudReprojection : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (IsSkipped()) {
            return;
        }
        renderer = std::make_unique<Renderer>(shaders());
        scene = cloud_scene(scene::CloudType::cumulus, CloudView::below);
        clouds_in(scene).march.edit([](scene::CloudMarch& march) {
            march.grid_columns = 128;
            march.reprojection = scene::CloudReprojection::always;
        });
    }
    void TearDown() override {
        renderer.reset();
        Drawing::TearDown();
    }
    Image full() {
        scene::Scene whole = scene;
        clouds_in(whole).march.edit(
            [](scene::CloudMarch& march) { march.reprojection = scene::CloudReprojection::never; });
        return draw(whole, pixels);
    }
    Image next() {
        renderer->render(scene, {pixels, 1.0});
        Image image = renderer->read_picture();
        EXPECT_TRUE(all_finite(image));
        return image;
    }
    void pan(double degrees) {
        scene.camera->edit([&](scene::Camera& camera) {
            const glm::dvec3 ahead = camera.target_world - camera.eye_world;
            const double angle = glm::radians(degrees);
            camera.target_world =
                camera.eye_world + glm::dvec3(ahead.x * std::cos(angle) - ahead.z * std::sin(angle), ahead.y,
                                              ahead.x * std::sin(angle) + ahead.z * std::cos(angle));
        });
        scene.time.edit([](scene::Timeline& timeline) { timeline.now_s += 1.0 / 30.0; });
    }

    glm::ivec2 pixels{160, 90};
    scene::Scene scene;
    std::unique_ptr<Renderer> renderer;
};

TEST_F(CloudReprojection, TheFirstPictureIsTheFullMarch) {
    EXPECT_TRUE(same_bits(next(), full()));
    EXPECT_EQ(renderer->missing_cloud_turns(), 0);
}

TEST_F(CloudReprojection, AStillViewConvergesToItAndThenDrawsNothing) {
    next();
    pan(3.0);
    next();
    EXPECT_EQ(renderer->missing_cloud_turns(), 16);
    for (int n = 0; n < 16; ++n) {
        next();
    }
    EXPECT_EQ(renderer->missing_cloud_turns(), 0);
    EXPECT_TRUE(same_bits(next(), full()));
    for (const PassReport& report : renderer->render(scene, {pixels, 1.0})) {
        EXPECT_FALSE(report.ran) << report.name;
    }
}

// 3 and 10 degrees a second at 30 frames a second, at the size that 0.03 was asked for; in coarser pixels clouds at the
// horizon are narrower than they.
TEST_F(CloudReprojection, PansStayNear) {
    pixels = {512, 288};
    for (const CloudView from : {CloudView::below, CloudView::above}) {
        for (const double degrees : {0.1, 1.0 / 3.0}) {
            scene.camera = cloud_scene(scene::CloudType::cumulus, from).camera;
            next();
            for (int n = 0; n < 32; ++n) {
                pan(degrees);
                renderer->render(scene, {pixels, 1.0});
            }
            const double rmse = measure::compare_images(renderer->read_picture(), full()).rmse;
            EXPECT_LE(rmse, 0.03) << degrees << " degrees a frame";
            report(
                fmt::format("from {}, {:.2g} degrees a frame", from == CloudView::below ? "below" : "above", degrees),
                rmse);
        }
    }
}

// What history cannot tell is marched: behind the edge of the last picture, and all of it after a jump of the eye.
TEST_F(CloudReprojection, WhatWasNotSeenIsMarched) {
    next();
    pan(180.0);
    EXPECT_TRUE(same_bits(next(), full()));
    EXPECT_TRUE(renderer->clouds_from_last());
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 500.0; });
    EXPECT_TRUE(same_bits(next(), full()));
    EXPECT_FALSE(renderer->clouds_from_last());
}

// A viewer draws fewer pixels while its picture moves, and then again all.
TEST_F(CloudReprojection, SizesMayChange) {
    next();
    const glm::ivec2 all = pixels;
    for (const glm::ivec2 fewer : {glm::ivec2(120, 68), glm::ivec2(80, 45), glm::ivec2(120, 68), all}) {
        pixels = fewer;
        pan(0.1);
        const double rmse = measure::compare_images(next(), full()).rmse;
        EXPECT_TRUE(renderer->clouds_from_last());
        // Found 0.03 to 0.05, from edges that are thinner than a pixel; a last picture looked up 3 % out of place is
        // 0.10 to 0.17 away.
        EXPECT_LE(rmse, 0.06) << fewer.x;
        report(fmt::format("{} pixels wide", fewer.x), rmse);
    }
    while (renderer->missing_cloud_turns() > 0) {
        next();
    }
    EXPECT_TRUE(same_bits(next(), full()));
    pixels = 2 * all;  // too large to be told from these
    EXPECT_TRUE(same_bits(next(), full()));
    EXPECT_FALSE(renderer->clouds_from_last());
}

// In a window without asking, in other pictures not.
TEST_F(CloudReprojection, IsForWindows) {
    clouds_in(scene).march.edit(
        [](scene::CloudMarch& march) { march.reprojection = scene::CloudReprojection::in_window; });
    next();
    pan(0.1);
    EXPECT_TRUE(same_bits(next(), full()));
    EXPECT_FALSE(renderer->clouds_from_last());
    pan(0.1);
    renderer->render(scene, {.pixels = pixels, .in_window = true});
    EXPECT_TRUE(renderer->clouds_from_last());
    while (renderer->missing_cloud_turns() > 0) {
        renderer->render(scene, {.pixels = pixels, .in_window = true});
    }
    EXPECT_TRUE(same_bits(renderer->read_picture(), full()));
}

TEST_F(CloudReprojection, OtherCloudsBeginAnew) {
    next();
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) { layer.coverage = 0.7; });
    EXPECT_TRUE(same_bits(next(), full()));
    scene.lights.at("sun").edit([](scene::Light& sun) { sun.direction_world.y = 0.1; });
    EXPECT_TRUE(same_bits(next(), full()));
}

}  // namespace
}  // namespace bruma::render
