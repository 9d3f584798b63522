// Shelf: independent double-precision reference. The same paths of light by two programs that share no line: where
// both are right, their differences are noise of the size that both state, in every pixel.
#include <cmath>

#include "path_tracing.h"
#include "reference/medium/render_scattering.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

class PathTraceTruth : public PathTraced {
  protected:
    void expect_the_same(const scene::Scene& scene, int gpu_samples, int cpu_samples) {
        constexpr glm::ivec2 pixels(36);
        const Traced traced = trace(scene, pixels, {.samples = gpu_samples});
        const auto truth = reference::render_scattering(scene, pixels.x, pixels.y, {.samples = cpu_samples});
        double squares = 0.0;
        double sum = 0.0;
        double largest = 0.0;
        int seen = 0;
        Estimate difference;
        for (std::size_t n = 0; n < traced.mean.pixel_count(); ++n) {
            // One channel of each pixel, since those of one path go together.
            const std::size_t k = n % 3;
            const double d = double(traced.mean.rgba[4 * n + k]) - truth.image.rgba[4 * n + k];
            const double error = std::hypot(traced.error.rgba[4 * n + k], truth.error[n][int(k)]);
            difference.mean += d;
            difference.error += error * error;
            // Pixels that hardly a path reached do not know their own error.
            const double share = traced.mean.rgba[4 * n + 3];
            if (share * gpu_samples < 20.0) {
                continue;
            }
            squares += d * d / (error * error);
            sum += d / error;
            largest = std::max(largest, std::abs(d) / error);
            ++seen;
        }
        ASSERT_GT(seen, 100);
        report("mean of z", sum / seen);
        report("mean of z^2", squares / seen);
        report("largest z", largest);
        // Of n normal numbers the mean varies by 1 / sqrt(n), the mean of squares by sqrt(2 / n).
        EXPECT_LE(std::abs(sum / seen), 4.0 / std::sqrt(seen));
        EXPECT_NEAR(squares / seen, 1.0, 4.0 * std::sqrt(2.0 / seen));
        EXPECT_LE(largest, 5.0);
        report("mean of differences in joint errors", difference.mean / std::sqrt(difference.error));
        EXPECT_LE(std::abs(difference.mean), 4.0 * std::sqrt(difference.error));
    }
    static scene::Scene builtin(const std::string& name) {
        const auto grid = scene::builtin_volume(name);
        scene::Scene scene = scene_with(grid, scene::suggested_transfer_function(*grid));
        scene.camera = oblique_camera(scene);
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { path_traced(optics); });
        return scene;
    }
};

TEST_F(PathTraceTruth, BuckyUnderTwoLights) {
    scene::Scene scene = builtin("bucky");
    scene.lights["key"] = scene::Light{};
    const scene::Bounds bounds = scene::world_bounds(scene);
    const double size = glm::length(bounds.high - bounds.low);
    scene.lights["lamp"] = scene::Light{.kind = scene::LightKind::point,
                                        .position_world = glm::dvec3(-1.0, 0.3, 0.5) * size,
                                        .color = {0.3, 0.6, 1.0},
                                        .intensity = 3.0 * size * size};
    scene.background = scene::Background{{0.1, 0.2, 0.3}, {0.3, 0.2, 0.1}};
    expect_the_same(scene, 256, 256);
}

TEST_F(PathTraceTruth, ForwardScatteringBlobs) {
    scene::Scene scene = builtin("blobs");
    scene.lights["behind"] = scene::Light{.direction_world = {-0.5, 0.4, -0.7}};
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) {
        optics.g = 0.8;
        optics.albedo = {0.95, 0.8, 0.6};
        optics.emission = 0.1;
        optics.density_scale = 8.0;
    });
    expect_the_same(scene, 256, 256);
}

TEST_F(PathTraceTruth, TwoVolumesInOneAnotherUnderASky) {
    scene::Scene scene = builtin("blobs");
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.density_scale = 8.0; });
    scene::Node node;
    node.content = std::get<scene::Volume>(builtin("bucky").nodes.at("volume").content);
    const double scale = glm::length((*volume_in(scene).grid)->extent()) /
                         glm::length((*std::get<scene::Volume>(node.content).grid)->extent());
    node.transform = scene::Transform{.rotation_deg = {20.0, 30.0, 0.0}, .scale = glm::dvec3(0.8 * scale)};
    std::get<scene::Volume>(node.content).optics.edit([](scene::VolumeOptics& optics) {
        optics.g = -0.4;
        optics.albedo = {0.5, 0.9, 0.9};
        optics.density_scale = 0.5;
    });
    scene.nodes["inner"] = node;
    scene.environment = scene::Environment{{0.6, 0.8, 1.0}};
    expect_the_same(scene, 256, 256);
}

}  // namespace
}  // namespace bruma::render
