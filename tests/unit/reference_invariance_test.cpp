// Shelf: the reference against itself, where physics says that two scenes look the same, and against its own error.
#include <gtest/gtest.h>

#include "reference/volume/emission_absorption.h"
#include "reference_scenes.h"

namespace bruma::reference {
namespace {

scene::Scene noisy_scene(glm::ivec3 size = {9, 12, 10}, double extent = 1.0) {
    auto scene = scene_with(grid_of(size, extent / glm::dvec3(size), [](glm::ivec3 at) { return noise(at); }),
                            rich_transfer_function(0.1 * extent));
    volume_in(scene).optics = scene::VolumeOptics{.lighting = scene::VolumeLighting::gradient};
    scene.lights["sun"] = scene::Light{.direction_world = {0.3, 0.8, 0.6}, .color = {1.0, 0.9, 0.7}};
    return scene;
}

std::vector<scene::Ray> rays(int count, double scale = 1.0) {
    std::vector<scene::Ray> list;
    for (int n = 0; n < count; ++n) {
        const auto place = [&](int part) {
            return scale * glm::dvec3(noise({n, part, 0}) - 0.5, noise({n, part, 1}) - 0.5, noise({n, part, 2}) - 0.5);
        };
        list.push_back(ray_from(4.0 * place(0), 0.7 * place(1)));
    }
    return list;
}

void expect_same(const RayResult& a, const RayResult& b, double tolerance) {
    EXPECT_NEAR(a.transmittance, b.transmittance, tolerance);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(a.radiance[channel], b.radiance[channel], tolerance);
    }
}

TEST(ReferenceInvariance, ErrorEstimateBoundsTheError) {
    const auto scene = noisy_scene();
    const EmissionAbsorption truth(scene, {.tolerance = 1e-12});
    int measurable = 0;
    for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
        const EmissionAbsorption media(scene, {.tolerance = tolerance});
        for (const scene::Ray& ray : rays(300)) {
            const RayResult exact = truth.trace(ray);
            const RayResult result = media.trace(ray);
            const glm::dvec3 apart = glm::abs(result.radiance - exact.radiance);
            const double error =
                std::max({apart.x, apart.y, apart.z, std::abs(result.transmittance - exact.transmittance)});
            EXPECT_LE(error, result.error + exact.error);
            EXPECT_LE(error, tolerance);
            measurable += error > 1e-9 ? 1 : 0;
        }
    }
    EXPECT_GT(measurable, 100) << "no errors to bound: the test would pass with any estimate";
}

TEST(ReferenceInvariance, LeapingChangesNothing) {
    // A few specks in 40^3 samples, so that whole blocks are empty.
    auto scene = noisy_scene();
    volume_in(scene).grid = grid_of(glm::ivec3(40), glm::dvec3(1.0 / 40.0), [](glm::ivec3 at) {
        const bool speck = noise(at / 5, 7) > 0.97;
        return speck ? noise(at) : at == glm::ivec3(0) ? 1.0 : 0.1 * noise(at);
    });
    const EmissionAbsorption leaping(scene, {.tolerance = 1e-10});
    const EmissionAbsorption walking(scene, {.tolerance = 1e-10, .leap = false});
    std::uint64_t with = 0;
    std::uint64_t without = 0;
    int hits = 0;
    for (const scene::Ray& ray : rays(300)) {
        const RayResult a = leaping.trace(ray);
        const RayResult b = walking.trace(ray);
        expect_same(a, b, a.error + b.error);
        with += a.evaluations;
        without += b.evaluations;
        hits += a.transmittance < 1.0 ? 1 : 0;
    }
    EXPECT_GT(hits, 30) << "nothing was hit, so nothing was compared";
    EXPECT_LT(3 * with, 2 * without) << "leaping leapt over nothing";
}

TEST(ReferenceInvariance, ScaleOfTheWorld) {
    // Every length times 1000, the reference length too: no light knows.
    const EmissionAbsorption small(noisy_scene({9, 12, 10}, 1.0));
    const EmissionAbsorption large(noisy_scene({9, 12, 10}, 1000.0));
    const auto small_rays = rays(50);
    const auto large_rays = rays(50, 1000.0);
    for (std::size_t n = 0; n < small_rays.size(); ++n) {
        const RayResult a = small.trace(small_rays[n]);
        expect_same(a, large.trace(large_rays[n]), 2.0 * a.error + 1e-9);
    }
}

TEST(ReferenceInvariance, AnisotropicSpacingIsResampledIsotropic) {
    // Linear along z, so that four times the samples there hold the same field: at (k + 1/2) / 4 - 1/2.
    const auto field = [](int i, int j, double k) { return 40.0 * noise({i, j, 0}) + (noise({i, j, 1}) + 0.5) * k; };
    auto coarse = noisy_scene();
    volume_in(coarse).grid =
        grid_of({8, 8, 4}, {0.05, 0.05, 0.2}, [&](glm::ivec3 at) { return field(at.x, at.y, at.z); });
    auto fine = noisy_scene();
    volume_in(fine).grid = grid_of({8, 8, 16}, glm::dvec3(0.05),
                                   [&](glm::ivec3 at) { return field(at.x, at.y, (at.z + 0.5) / 4.0 - 0.5); });
    for (scene::Scene* scene : {&coarse, &fine}) {
        auto& volume = volume_in(*scene);
        volume.transfer_function.edit([](auto& tf) { tf.window = std::array{0.0, 45.0}; });
        // Shaded everywhere, whatever the range of the data, which the two samplings see differently.
        volume.optics = scene::VolumeOptics{
            .lighting = scene::VolumeLighting::gradient, .gradient_soft_from = 0.0, .gradient_soft_to = 0.0};
        // The outer half voxels, where both are clamped, are of different thickness.
        volume.clip = scene::ClipBox{{0.0, 0.0, 0.15}, {1.0, 1.0, 0.85}};
    }
    const EmissionAbsorption a(coarse, {.tolerance = 1e-9});
    const EmissionAbsorption b(fine, {.tolerance = 1e-9});
    int hits = 0;
    for (const scene::Ray& ray : rays(60)) {
        const RayResult result = a.trace(ray);
        // Samples are stored as float: 2^-24 of 45 units, against opacity slopes of at most 5 per 45 units.
        expect_same(result, b.trace(ray), 2e-6);
        hits += result.transmittance < 1.0 ? 1 : 0;
    }
    EXPECT_GT(hits, 10);
}

TEST(ReferenceInvariance, OrthographicIsTheLimitOfPerspective) {
    auto flat = noisy_scene();
    auto far = flat;
    scene::Camera camera = **flat.camera;
    camera.eye_world = {0.0, 0.0, 1e5};
    flat.camera.emplace(camera);
    camera.projection = scene::Projection::perspective;
    camera.vertical_angle_deg = glm::degrees(2.0 * std::atan(0.5 * camera.view_height / 1e5));
    far.camera.emplace(camera);
    // Without a headlight or highlight towards the eye, only the directions differ, by 1e-5; without shading, for a
    // highlight of exponent 30 would magnify that.
    volume_in(flat).optics = scene::VolumeOptics{};
    volume_in(far).optics = scene::VolumeOptics{};
    const ReferenceImage a = render_emission_absorption(flat, 12, 12);
    const ReferenceImage b = render_emission_absorption(far, 12, 12);
    for (std::size_t n = 0; n < a.image.rgba.size(); ++n) {
        EXPECT_NEAR(a.image.rgba[n], b.image.rgba[n], 1e-3);
    }
}

TEST(ReferenceInvariance, SamePictureEveryTimeAndProgressReachesOne) {
    const auto scene = noisy_scene();
    double share = 0.0;
    const ReferenceImage a = render_emission_absorption(scene, 40, 30, {.progress = [&](double s) { share = s; }});
    const ReferenceImage b = render_emission_absorption(scene, 40, 30);
    EXPECT_EQ(a.image.rgba, b.image.rgba);
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(share, 1.0);
    EXPECT_LE(a.rms_error, a.largest_error);
    EXPECT_LT(a.largest_error, 1e-5);
}

}  // namespace
}  // namespace bruma::reference
