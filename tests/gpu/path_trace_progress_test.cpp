// Shelf: closed form. Paths are added, never lost or drawn twice, and begin anew exactly when something changed.
#include <algorithm>

#include "graph_test.h"
#include "path_tracing.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

class PathProgress : public PathTraced {
  protected:
    void SetUp() override {
        PathTraced::SetUp();
        if (IsSkipped()) {
            return;
        }
        renderer = std::make_unique<Renderer>(shaders());
        const auto grid = scene::builtin_volume("bucky");
        scene = scene_with(grid, scene::suggested_transfer_function(*grid));
        scene.camera = oblique_camera(scene);
        scene.lights["key"] = scene::Light{};
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { path_traced(optics); });
        view = {{24, 20}, 1.0, {.samples = 4}};
    }
    void TearDown() override {
        renderer.reset();
        PathTraced::TearDown();
    }
    Names reruns() { return bruma::render::reruns(*renderer, scene, view); }
    Image at_once(int samples) { return trace(scene, view.pixels, {.samples = samples}).mean; }

    std::unique_ptr<Renderer> renderer;
    scene::Scene scene;
    View view;
};

TEST_F(PathProgress, MoreSamplesContinueWhatIsThereBitForBit) {
    reruns();
    EXPECT_EQ(renderer->path_samples(), 4);
    EXPECT_TRUE(same_bits(renderer->read_picture(), at_once(4)));
    view.paths.samples = 9;
    EXPECT_EQ(reruns(), (Names{"path trace"}));
    const Image nine = at_once(9);
    EXPECT_TRUE(same_bits(renderer->read_picture(), nine));
    EXPECT_FALSE(same_bits(nine, at_once(4)));
    EXPECT_EQ(reruns(), Names{}) << "as many as wanted";
    view.paths.samples = 4;
    reruns();
    EXPECT_TRUE(same_bits(renderer->read_picture(), at_once(4)))
        << "fewer: a picture depends on nothing but its inputs";
}

TEST_F(PathProgress, ABudgetOfTimeChangesNoBit) {
    view.paths = {.samples = 3, .budget_ms = 1e-3};
    reruns();
    EXPECT_GE(renderer->path_samples(), 1) << "the first picture is worth any wait";
    int turns = 1;
    for (; renderer->path_samples() < 3 && turns < 100; ++turns) {
        EXPECT_EQ(reruns(), (Names{"path trace"}));
    }
    EXPECT_EQ(reruns(), Names{});
    EXPECT_GT(turns, 3) << "in bands";
    EXPECT_TRUE(same_bits(renderer->read_picture(), at_once(3)));
}

TEST_F(PathProgress, AStillSceneMakesNothingElse) {
    EXPECT_EQ(reruns(), (Names{"begin paths", "path trace", "volume: bounds of extinction", "volume: cell ranges",
                               "volume: scattering tables", "volume: upload"}));
    EXPECT_EQ(reruns(), Names{});
    // What path tracing does not look at.
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.step = 0.5; });
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.specular = 0.9; });
    scene.lights["off"] = scene::Light{.on = false};
    EXPECT_EQ(reruns(), Names{});
}

TEST_F(PathProgress, ChangesBeginAnewAndRemakeOnlyWhatTheyConcern) {
    const Names paths_only{"begin paths", "path trace"};
    reruns();
    const auto expect_reruns = [&](const Names& names, const char* what) {
        EXPECT_EQ(reruns(), names) << what;
        EXPECT_TRUE(same_bits(renderer->read_picture(), at_once(4))) << what;
    };
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 0.01; });
    expect_reruns(paths_only, "camera");
    scene.lights.at("key").edit([](scene::Light& light) { light.intensity *= 2.0; });
    expect_reruns(paths_only, "light");
    scene.environment = scene::Environment{glm::dvec3(0.5)};
    expect_reruns(paths_only, "environment");
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.g = 0.3; });
    expect_reruns(paths_only, "g");
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.density_scale = 0.3; });
    expect_reruns(paths_only, "density");
    volume_in(scene).clip.edit([](scene::ClipBox& clip) { clip.high.z = 0.6; });
    expect_reruns(paths_only, "clip");
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.albedo.y = 0.5; });
    expect_reruns({"begin paths", "path trace", "volume: scattering tables"}, "albedo");
    volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) { tf.opacity.push_back({0.97, 0.11}); });
    expect_reruns({"begin paths", "path trace", "volume: bounds of extinction", "volume: scattering tables"}, "curve");
}

TEST_F(PathProgress, ModesMayBeSwitchedBackAndForth) {
    reruns();
    const Image traced = renderer->read_picture();
    volume_in(scene).optics.edit([](scene::VolumeOptics& o) { o.lighting = scene::VolumeLighting::none; });
    const Names march = reruns();
    EXPECT_NE(std::find(march.begin(), march.end(), "march"), march.end());
    EXPECT_FALSE(renderer->path_standing());
    EXPECT_FALSE(same_bits(renderer->read_picture(), traced));
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { path_traced(optics); });
    reruns();
    EXPECT_TRUE(same_bits(renderer->read_picture(), traced));
    scene.nodes.at("volume").visible = false;
    reruns();
    EXPECT_FALSE(renderer->path_standing()) << "nothing is left to trace";
}

TEST_F(PathProgress, TheStandingErrorFallsWithTheRootOfTheSamples) {
    view.paths.samples = 1;
    reruns();
    EXPECT_FALSE(renderer->path_standing()->standard_error) << "one path knows no error";
    view.paths.samples = 16;
    reruns();
    const double few = renderer->path_standing()->standard_error.value();
    view.paths.samples = 256;
    reruns();
    const double many = renderer->path_standing()->standard_error.value();
    EXPECT_NEAR(few / many, 4.0, 0.8);  // the error's own error with 16 paths on 480 pixels
}

}  // namespace
}  // namespace bruma::render
