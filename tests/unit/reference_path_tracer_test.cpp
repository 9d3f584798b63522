// Shelf: closed form, for the furnaces and the transmittance; the values of another program, for the slabs; and the
// quadrature of single scattering, which shares no estimator with the paths. Random numbers are fixed, so a test that
// passes once passes always.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "base/error.h"
#include "reference/medium/path_tracer.h"
#include "reference/medium/single_scattering.h"
#include "reference_scattering_scenes.h"

namespace bruma::reference {
namespace {

struct Mean {
    double sum = 0.0, squares = 0.0;
    int count = 0;
    void add(double value) {
        sum += value;
        squares += value * value;
        ++count;
    }
    double value() const { return sum / count; }
    double error() const { return std::sqrt(std::max(0.0, squares / count - value() * value()) / count); }
};

struct SlabRow {
    double optical_depth, cosine, albedo, g, reflected, transmitted;
};

TEST(ReferencePathTracer, SlabsReflectAndTransmitTheirShares) {
    // From 1e7 analogue histories each of a program of its own, standard error at most 1.6e-4.
    const SlabRow rows[] = {
        {1.0, 1.0, 1.0, 0.0, 0.3411, 0.6589}, {1.0, 1.0, 0.9, 0.0, 0.2675, 0.5917},
        {4.0, 1.0, 1.0, 0.0, 0.6910, 0.3090}, {1.0, 1.0, 1.0, 0.8, 0.0599, 0.9401},
        {4.0, 1.0, 1.0, 0.8, 0.2547, 0.7453}, {4.0, 1.0, 0.9, 0.8, 0.1121, 0.4418},
        {1.0, 0.5, 1.0, 0.0, 0.4985, 0.5015},
    };
    for (const SlabRow& row : rows) {
        const ScatteringScene media(slab_scene(row.optical_depth, row.albedo, row.g));
        const PathTracer paths(media, 100'000);
        const scene::Ray ray{{0.0, 0.0, 2.0}, {std::sqrt(1.0 - row.cosine * row.cosine), 0.0, -row.cosine}, 0.0};
        Mean reflected;
        Mean transmitted;
        for (int n = 0; n < 150'000; ++n) {
            RandomStream random(1, 0, std::uint64_t(n));
            const Escape path = paths.follow(ray, random);
            EXPECT_FALSE(path.cut_off);
            const double weight = path.escaped ? path.weight.x : 0.0;
            reflected.add(path.way_world.z > 0.0 ? weight : 0.0);
            transmitted.add(path.way_world.z < 0.0 ? weight : 0.0);
        }
        const auto room = [](const Mean& mean) { return 4.0 * std::hypot(mean.error(), 1.6e-4); };
        EXPECT_NEAR(reflected.value(), row.reflected, room(reflected)) << row.optical_depth << ' ' << row.g;
        EXPECT_NEAR(transmitted.value(), row.transmitted, room(transmitted)) << row.optical_depth << ' ' << row.g;
        if (row.albedo == 1.0) {
            EXPECT_DOUBLE_EQ(reflected.value() + transmitted.value(), 1.0) << "nothing is lost";
        }
    }
}

TEST(ReferencePathTracer, RatioTrackingFindsTheTransmittance) {
    auto scene = noisy_scene(1.0, 0.0);
    scene.nodes["second"] = scene.nodes["volume"];
    scene.nodes["second"].transform =
        scene::Transform{.translation = {0.2, 0.1, 0.05}, .rotation_deg = {20.0, 30.0, 0}};
    const ScatteringScene media(scene);
    const SingleScattering rays(media, 1e-8);
    for (std::uint32_t n = 0; n < 20; ++n) {
        const glm::ivec3 at(int(n), 0, 0);
        const scene::Ray ray = ray_from({2.0 * noise(at, 2) - 1.0, 2.0 * noise(at, 3) - 1.0, 2.0},
                                        {0.6 * noise(at, 4) - 0.3, 0.6 * noise(at, 5) - 0.3, 0.0});
        Mean tracked;
        Mean flown;
        for (std::uint64_t sample = 0; sample < 3000; ++sample) {
            RandomStream random(2, n, sample);
            tracked.add(tracked_transmittance(media.volumes, ray, 1e300, random));
            flown.add(next_collision(media.volumes, ray, random) ? 0.0 : 1.0);
        }
        const double truth = rays.trace_unscattered(ray).transmittance;
        if (truth > 0.01) {  // below, too few samples pass for an error of their own
            EXPECT_NEAR(tracked.value(), truth, 4.0 * tracked.error());
        }
        EXPECT_NEAR(flown.value(), truth, 4.0 * std::sqrt(truth * (1.0 - truth) / 3000.0) + 1e-3);
    }
}

/// A z-test over all pixels: beyond 4.6 lie 4 of a million by chance; mean and mean square are 0 and 1 where the
/// errors are what they claim.
void expect_agreement(const ScatteringImage& measured, const Image& truth, int fewest) {
    const ZScores scores = z_scores(measured, truth);
    EXPECT_GT(scores.count, fewest);
    EXPECT_LT(scores.largest, 4.6);
    // Three channels of one pixel share their paths: a third of the count is independent.
    const double independent = std::sqrt(3.0 / scores.count);
    EXPECT_LT(std::abs(scores.mean), 4.0 * independent);
    EXPECT_NEAR(scores.mean_square, 1.0, 6.0 * independent);
}

/// A picture of one radiance everywhere.
Image uniform_image(int width, int height, float radiance) {
    Image image(width, height);
    std::fill(image.rgba.begin(), image.rgba.end(), radiance);
    return image;
}

TEST(ReferencePathTracer, WhiteFurnaceShowsNothing) {
    // Test 24: matter that only scatters, in light of one radiance from all sides, cannot be seen.
    for (const double g : {0.0, -0.6, 0.9}) {
        auto scene = noisy_scene(1.0, g);
        scene.environment = scene::Environment{glm::dvec3(1.0)};
        scene.background = scene::Background{glm::dvec3(1.0), glm::dvec3(1.0)};
        scene.nodes["second"] = scene.nodes["volume"];
        scene.nodes["second"].transform = scene::Transform{.translation = {0.2, 0.1, 0.05}};
        const auto picture = render_scattering(scene, 16, 16, {.samples = 400, .seed = std::uint64_t(10.0 + 10.0 * g)});
        expect_agreement(picture, uniform_image(16, 16, 1.0F), 150);
        EXPECT_EQ(picture.cut_off_share, 0.0);
    }
}

TEST(ReferencePathTracer, IsothermalFurnaceShowsNothing) {
    // Kirchhoff: matter that gives off the share (1 - w) of the radiance around it cannot be seen either.
    // e C = (1 - 0.8 C) B, with e = 2: B = 2 C / (1 - 0.8 C). So dark that Russian roulette decides early.
    const glm::dvec3 color(0.3, 0.25, 0.35);
    auto scene = noisy_scene(0.8, 0.3, color);
    volume_in(scene).optics.edit([](auto& optics) {
        optics.emission = 2.0;
        optics.density_scale = 2.0;
    });
    const glm::dvec3 radiance = 2.0 * color / (1.0 - 0.8 * color);
    scene.environment = scene::Environment{radiance};
    scene.background = scene::Background{radiance, radiance};
    Image truth(16, 16);
    for (std::size_t n = 0; n < truth.rgba.size(); ++n) {
        truth.rgba[n] = n % 4 < 3 ? float(radiance[int(n % 4)]) : 1.0F;
    }
    expect_agreement(render_scattering(scene, 16, 16, {.samples = 2000}), truth, 150);
}

TEST(ReferencePathTracer, RouletteIsFair) {
    // In a thick isothermal slab every path would bring the same light, were it not for Russian roulette.
    auto scene = slab_scene(6.0, 0.3, 0.0);
    volume_in(scene).optics.edit([](auto& optics) { optics.emission = 0.7; });
    scene.environment = scene::Environment{glm::dvec3(1.0)};
    scene.background = scene::Background{glm::dvec3(1.0), glm::dvec3(1.0)};
    const auto picture = render_scattering(scene, 1, 1, {.samples = 20'000});
    EXPECT_LT(picture.largest_error, 2e-3);
    EXPECT_NEAR(picture.image.pixel(0, 0)[0], 1.0, 4.0 * picture.largest_error);
}

/// Two coloured volumes of different g, one rotated into the other, under two lights.
scene::Scene two_volumes() {
    auto scene = noisy_scene(0.9, 0.5, {0.9, 0.6, 0.3});
    scene.nodes["second"] = scene.nodes["volume"];
    let_scatter(scene, 0.7, -0.4, "second");
    scene.nodes["second"].transform =
        scene::Transform{.translation = {0.2, 0.1, 0.05}, .rotation_deg = {20.0, 30.0, 0}};
    scene.lights["sun"] = sun({0.3, 1.0, 0.4}, {1.0, 0.9, 0.7});
    auto spot = lamp({0.6, -0.3, 0.9}, 4.0);
    spot.kind = scene::LightKind::spot;
    spot.direction_world = {0.6, -0.3, 0.9};
    scene.lights["spot"] = spot;
    return scene;
}

TEST(ReferencePathTracer, OneBounceAgreesWithTheQuadrature) {
    const auto scene = two_volumes();
    const auto truth = render_scattering(scene, 20, 20, {.paths = LightPaths::single, .tolerance = 1e-4});
    EXPECT_LT(truth.largest_error, 2e-3);
    const auto picture = render_scattering(scene, 20, 20, {.samples = 400, .max_bounces = 1});
    expect_agreement(picture, truth.image, 200);
    EXPECT_GT(picture.cut_off_share, 0.0);
    EXPECT_LT(truth.largest_error, 0.3 * picture.rms_error) << "else the quadrature is no truth here";
    for (std::size_t n = 3; n < picture.image.rgba.size(); n += 4) {
        EXPECT_NEAR(picture.image.rgba[n], truth.image.rgba[n], 1e-4) << "alpha";
    }
}

TEST(ReferencePathTracer, UnlitVolumesAreSeenAndAbsorb) {
    auto scene = two_volumes();
    volume_in(scene, "second").optics.edit([](auto& optics) { optics.lighting = scene::VolumeLighting::none; });
    const auto truth = render_scattering(scene, 16, 16, {.paths = LightPaths::single, .tolerance = 1e-4});
    expect_agreement(render_scattering(scene, 16, 16, {.samples = 400, .max_bounces = 1}), truth.image, 150);
}

TEST(ReferencePathTracer, MoreBouncesAreBrighter) {
    // The same numbers draw the same paths: each step only lengthens them.
    const auto scene = two_volumes();
    double before = 0.0;
    for (const int bounces : {1, 2, 4, 100'000}) {
        const auto picture = render_scattering(scene, 12, 12, {.samples = 100, .max_bounces = bounces});
        double sum = 0.0;
        for (const float value : picture.image.rgba) {
            sum += value;
        }
        EXPECT_GT(sum, before);
        before = sum;
    }
}

TEST(ReferencePathTracer, SamePictureWithAnyNumberOfThreads) {
    const auto scene = two_volumes();
    const auto draw = [&](std::size_t threads, std::uint64_t seed) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return render_scattering(scene, 20, 20, {.samples = 10, .seed = seed}).image.rgba;
    };
    const auto once = draw(1, 0);
    EXPECT_EQ(once, draw(2, 0));
    EXPECT_NE(once, draw(2, 1));
}

TEST(ReferencePathTracer, RefusesWhatItCannotDo) {
    auto scene = noisy_scene(1.0, 0.0);
    EXPECT_THROW(render_scattering(scene, 4, 4, {.samples = 1}), InputError);
    EXPECT_THROW(render_scattering(scene, 4, 4, {.max_bounces = 0}), InputError);
    EXPECT_THROW(render_scattering(scene, 0, 4, {}), InputError);
    volume_in(scene).optics.edit([](auto& optics) { optics.density_scale = 1e9; });
    EXPECT_THROW(render_scattering(scene, 4, 4, {.samples = 2}), InputError);
}

}  // namespace
}  // namespace bruma::reference
