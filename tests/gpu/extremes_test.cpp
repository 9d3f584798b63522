// Shelf: closed form. Whatever a user may set, every number of the picture is finite and opacity stays in [0, 1].
#include <cmath>
#include <limits>

#include "drawing.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

class Extremes : public Drawing {
  protected:
    void expect_sane(scene::Scene& scene, const std::string& what) {
        for (const bool with_lamps : {false, true}) {
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) {
                optics.lighting = with_lamps ? scene::VolumeLighting::gradient : scene::VolumeLighting::none;
            });
            for (const Classification classification : both_classifications) {
                for (const double step : {0.05, 1.0, 64.0}) {
                    settle(scene, classification, step);
                    const Image image = draw(scene, {9, 9});
                    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
                        ASSERT_GE(image.rgba[4 * n + 3], 0.0F) << what;
                        ASSERT_LE(image.rgba[4 * n + 3], 1.0F) << what;
                    }
                }
            }
        }
    }
    scene::Scene with(scene::TransferFunction tf, std::shared_ptr<const scene::VolumeGrid> grid) {
        scene::Scene scene = scene_with(std::move(grid), std::move(tf));
        scene.camera = oblique_camera(scene);
        scene.lights["key"] = scene::Light{};
        return scene;
    }
};

std::shared_ptr<const scene::VolumeGrid> noisy() {
    return grid_of(glm::ivec3(9), glm::dvec3(0.1), [](glm::ivec3 at) { return noise(at); });
}

TEST_F(Extremes, TransferFunctions) {
    using Points = std::vector<scene::OpacityPoint>;
    const std::vector<std::pair<const char*, Points>> curves{
        {"opacity 1 everywhere", {{0.0, 1.0}}},
        {"opacity 0 everywhere", {{0.0, 0.0}}},
        {"a step to 1", {{0.5, 0.0}, {0.5, 1.0}}},
        {"a peak of no width", {{0.5, 0.0}, {0.5, 1.0}, {0.5, 0.0}}},
        {"no points", {}},
        {"all but nothing", {{0.0, 1e-12}}}};
    for (const auto& [name, points] : curves) {
        for (const double reference_length : {1e-12, 1e-3, 1e12}) {
            scene::TransferFunction tf;
            tf.opacity = points;
            tf.reference_length = reference_length;
            tf.emission = {{0.0, 1e6}};
            scene::Scene scene = with(tf, noisy());
            expect_sane(scene, name);
        }
    }
}

TEST_F(Extremes, WindowsAndDensities) {
    for (const std::array<double, 2> window :
         {std::array{0.9, 0.1}, std::array{0.5, 0.5}, std::array{-1e30, 1e30}, std::array{0.5, 0.5 + 1e-12},
          std::array{5.0, 6.0}, std::array{-6.0, -5.0}}) {
        scene::TransferFunction tf = rich_transfer_function(0.1);
        tf.window = window;
        scene::Scene scene = with(tf, noisy());
        expect_sane(scene, "window " + std::to_string(window[0]) + " .. " + std::to_string(window[1]));
    }
    for (const double density : {0.0, 1e-9, 1e9}) {
        scene::Scene scene = with(rich_transfer_function(0.1), noisy());
        volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.density_scale = density; });
        expect_sane(scene, "density " + std::to_string(density));
    }
}

TEST_F(Extremes, Volumes) {
    const float most = std::numeric_limits<float>::max();
    scene::TransferFunction tf = rich_transfer_function(0.1);
    const std::vector<std::pair<const char*, std::shared_ptr<const scene::VolumeGrid>>> grids{
        {"one voxel", grid_of(glm::ivec3(1), glm::dvec3(1.0), [](glm::ivec3) { return 0.7; })},
        {"constant", grid_of(glm::ivec3(5), glm::dvec3(0.2), [](glm::ivec3) { return -3.0; })},
        {"a row", grid_of({64, 1, 1}, glm::dvec3(0.1), [](glm::ivec3 at) { return noise(at); })},
        {"a sheet", grid_of({16, 16, 1}, glm::dvec3(0.1), [](glm::ivec3 at) { return noise(at); })},
        {"needles", grid_of({4, 4, 4}, {1e-6, 1.0, 1e3}, [](glm::ivec3 at) { return noise(at); })},
        {"the whole range of float",
         grid_of(glm::ivec3(4), glm::dvec3(1.0), [&](glm::ivec3 at) { return (at.x % 2 ? most : -most); })},
        {"denormals", grid_of(glm::ivec3(4), glm::dvec3(1.0), [&](glm::ivec3 at) { return 1e-42 * at.x; })},
        {"huge voxels", grid_of(glm::ivec3(4), glm::dvec3(1e9), [](glm::ivec3 at) { return noise(at); })},
        {"tiny voxels", grid_of(glm::ivec3(4), glm::dvec3(1e-9), [](glm::ivec3 at) { return noise(at); })}};
    for (const auto& [name, grid] : grids) {
        scene::Scene scene = with(tf, grid);
        expect_sane(scene, name);
    }
}

TEST_F(Extremes, AnEmptySceneIsItsBackground) {
    scene::Scene scene;
    scene.camera.emplace(scene::Camera{});
    scene.background = scene::Background{.top = {1.0, 0.5, 0.25}, .bottom = {0.0, 0.25, 0.5}};
    const Image image = draw(scene, {4, 4});
    for (int y = 0; y < 4; ++y) {
        const double f = (y + 0.5) / 4.0;
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(image.pixel(1, y)[k], glm::mix(scene.background->top, scene.background->bottom, f)[k], 1e-6);
        }
        EXPECT_EQ(image.pixel(1, y)[3], 0.0F);
    }
    EXPECT_EQ(count(scene, {4, 4}).samples, 0U);
}

TEST_F(Extremes, OnePixelAndOddSizes) {
    scene::Scene scene = with(rich_transfer_function(0.1), noisy());
    for (const glm::ivec2 pixels : {glm::ivec2(1), glm::ivec2(1, 33), glm::ivec2(257, 3)}) {
        const Image image = draw(scene, pixels);
        EXPECT_EQ(glm::ivec2(image.width, image.height), pixels);
    }
}

TEST_F(Extremes, TheSameSceneGivesTheSameBits) {
    scene::Scene scene = scene::builtin_scene("bucky-cluster");
    const Image once = draw(scene, {48, 27});
    EXPECT_TRUE(same_bits(once, draw(scene, {48, 27})));
}

}  // namespace
}  // namespace bruma::render
