// Shelf: closed form. Homogeneous matter, whose opacity is 1 - exp(-sigma D) however it is cut up.
#include <cmath>

#include "drawing.h"

namespace bruma::render {
namespace {

constexpr glm::ivec2 few_pixels(5, 5);

double opacity(double tau) {
    return -std::expm1(-tau);
}

/// Largest error of alpha, and of the radiance of matter of source radiance (1, 1/2, 1/4), over the whole picture.
double largest_error(const Image& image, double expected) {
    double largest = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float* pixel = &image.rgba[4 * n];
        const double errors[4] = {pixel[0] - expected, pixel[1] - 0.5 * expected, pixel[2] - 0.25 * expected,
                                  pixel[3] - expected};
        for (const double error : errors) {
            largest = std::max(largest, std::abs(error));
        }
    }
    return largest;
}

scene::Scene slab(glm::ivec3 size, glm::dvec3 extent, double sigma) {
    scene::Scene scene = scene_with(homogeneous(size, extent), uniform_extinction(sigma, {1.0, 0.5, 0.25}));
    scene.camera->edit([](scene::Camera& camera) { camera.view_height = 0.8; });
    return scene;
}

TEST_F(Drawing, Test01HomogeneousSlab) {
    const double sigma = 3.0;
    scene::Scene scene = slab({16, 16, 61}, {1.0, 1.0, 0.61}, sigma);
    // 59.6 voxels: no multiple of any of the steps.
    volume_in(scene).clip = scene::ClipBox{{0.0, 0.0, 0.0131}, {1.0, 1.0, 0.99015}};
    const double thickness = 0.61 * (0.99015 - 0.0131);
    for (const Classification classification : both_classifications) {
        for (const scene::Jitter jitter : {scene::Jitter::off, scene::Jitter::hashed, scene::Jitter::blue_noise}) {
            for (const double step : {0.25, 0.5, 1.0, 2.0, 4.0}) {
                settle(scene, classification, step);
                scene.rendering.edit([&](scene::RenderSettings& settings) { settings.jitter = jitter; });
                const double error = largest_error(draw(scene, few_pixels), opacity(sigma * thickness));
                // Float: some 2.5e-8 per step of rounding on top of that of the ends. That is no trend: what is left
                // does not grow with the step.
                EXPECT_LE(error, 5e-7 + 2.5e-8 * (60.0 / step)) << name_of(classification) << ", step " << step;
                EXPECT_LE(error, 1e-5);
                if (jitter == scene::Jitter::off) {
                    report(std::string(name_of(classification)) + " error at step " + std::to_string(step), error);
                }
            }
        }
    }
}

TEST_F(Drawing, Test02SlabStoredAtThreeResolutions) {
    const double sigma = 2.5;
    for (const Classification classification : both_classifications) {
        for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(64), glm::ivec3(64, 64, 7)}) {
            scene::Scene scene = slab(size, {1.0, 1.0, 0.7}, sigma);
            // The same step in metres for all: 1/47 of the thickness.
            const double smallest = std::min(1.0 / size.x, 0.7 / size.z);
            settle(scene, classification, std::clamp(0.7 / 47.0 / smallest, 0.01, 64.0));
            EXPECT_LE(largest_error(draw(scene, few_pixels), opacity(sigma * 0.7)), 1e-5)
                << name_of(classification) << ", " << size.x << " x " << size.y << " x " << size.z;
        }
    }
}

/// A scene with structure whose every length is multiplied by `factor`.
scene::Scene scaled(double factor) {
    const auto grid = grid_of(glm::ivec3(12, 10, 14), factor * glm::dvec3(0.01, 0.012, 0.009), [](glm::ivec3 at) {
        return 0.5 + 0.25 * std::sin(0.7 * at.x) + 0.25 * std::cos(0.5 * at.y + 0.9 * at.z);
    });
    scene::Scene scene = scene_with(grid, rich_transfer_function(0.02 * factor));
    scene.camera = oblique_camera(scene);
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    scene.lights["key"] = scene::Light{};
    scene.lights["point"] = scene::Light{.kind = scene::LightKind::point,
                                         .position_world = factor * glm::dvec3(0.1, 0.2, 0.1),
                                         .intensity = 0.06 * factor * factor};
    scene.background = scene::Background{.top = glm::dvec3(0.1, 0.2, 0.4), .bottom = glm::dvec3(0.3)};
    return scene;
}

TEST_F(Drawing, Test03AllLengthsScaled) {
    for (const Classification classification : both_classifications) {
        Image images[3];
        const double factors[3] = {1.0, 1024.0, 1000.0};
        for (int n = 0; n < 3; ++n) {
            scene::Scene scene = scaled(factors[n]);
            settle(scene, classification, 0.7);
            images[n] = draw(scene, {32, 32});
        }
        const double by_1024 = largest_difference(images[1], images[0]);
        const double by_1000 = largest_difference(images[2], images[0]);
        report(std::string(name_of(classification)) + " difference at x1024", by_1024);
        report(std::string(name_of(classification)) + " difference at x1000", by_1000);
        // A power of two moves exponents only; 1000 rounds positions anew.
        EXPECT_LE(by_1024, 1e-6);
        EXPECT_LE(by_1000, 1e-4);
    }
}

TEST_F(Drawing, OverlappingVolumesMultiplyTransmittance) {
    for (const Classification classification : both_classifications) {
        scene::Scene scene = slab({8, 8, 16}, {1.0, 1.0, 0.8}, 2.0);
        scene::Volume second;
        second.grid = homogeneous({4, 4, 5}, {2.0, 2.0, 0.5});
        second.transfer_function = uniform_extinction(1.3, {1.0, 0.5, 0.25});
        scene::Node node;
        node.content = second;
        // From 0.1 behind the middle of the first to far in front of it.
        node.transform = scene::Transform{.translation = {0.0, 0.0, 0.1537}};
        scene.nodes["second"] = std::move(node);
        settle(scene, classification, 0.37);
        EXPECT_LE(largest_error(draw(scene, few_pixels), opacity(2.0 * 0.8 + 1.3 * 0.5)), 1e-5)
            << name_of(classification) << ", overlapping";
        scene.nodes.at("second").transform = scene::Transform{.translation = {0.0, 0.0, 3.0}};
        EXPECT_LE(largest_error(draw(scene, few_pixels), opacity(2.0 * 0.8 + 1.3 * 0.5)), 1e-5)
            << name_of(classification) << ", one behind the other";
        scene.nodes.at("second").visible = false;
        EXPECT_LE(largest_error(draw(scene, few_pixels), opacity(2.0 * 0.8)), 1e-5) << "one hidden";
    }
}

TEST_F(Drawing, TheBackgroundIsSeenThroughTheSlab) {
    scene::Scene scene = slab({4, 4, 8}, {1.0, 1.0, 0.5}, 1.7);
    scene.background = scene::Background{.top = {0.8, 0.4, 0.2}, .bottom = {0.8, 0.4, 0.2}};
    settle(scene, Classification::preintegrated, 1.0);
    const Image image = draw(scene, few_pixels);
    const double a = opacity(1.7 * 0.5);
    const glm::dvec3 expected = a * glm::dvec3(1.0, 0.5, 0.25) + (1.0 - a) * glm::dvec3(0.8, 0.4, 0.2);
    for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(image.pixel(2, 2)[k], expected[k], 1e-6);
    }
    EXPECT_NEAR(image.pixel(2, 2)[3], a, 1e-6);
}

}  // namespace
}  // namespace bruma::render
