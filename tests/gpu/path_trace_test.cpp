// Shelf: closed form. Path tracing against what is known exactly, or to many more digits; tolerances are 4 standard
// errors of the estimate itself, which a right program exceeds once in 16 000 checks and, with fixed random numbers,
// never again.
#include <cmath>
#include <numbers>

#include "path_tracing.h"

namespace bruma::render {
namespace {

using std::numbers::pi;

scene::Light beam(glm::dvec3 toward, double irradiance = 1.0) {
    return {.direction_world = toward, .intensity = irradiance};
}

/// Lumpy matter of two colours with a fresh camera.
scene::Scene lumps() {
    const auto grid = grid_of({11, 9, 10}, glm::dvec3(0.1), [](glm::ivec3 at) { return noise(at); });
    scene::TransferFunction tf;
    tf.reference_length = 0.1;
    tf.opacity = {{0.2, 0.0}, {0.5, 0.5}, {0.8, 0.1}, {1.0, 0.9}};
    scene::Scene scene = scene_with(grid, tf);
    scene.camera = oblique_camera(scene);
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { path_traced(optics).g = 0.5; });
    return scene;
}

// Matter that absorbs nothing, in light from all sides, cannot be seen; each single path says so.
TEST_F(PathTraced, Test24WhiteFurnace) {
    scene::Scene scene = lumps();
    scene.environment = scene::Environment{glm::dvec3(1.0)};
    scene.background = scene::Background{glm::dvec3(1.0), glm::dvec3(1.0)};
    const Traced traced = trace(scene, {16, 16}, {.samples = 32});
    for (std::size_t n = 0; n < traced.mean.pixel_count(); ++n) {
        EXPECT_NEAR(traced.mean.rgba[4 * n], 1.0, 1e-5) << n;
    }
    EXPECT_GT(estimate(traced, 3).mean, 0.3) << "there is matter in the picture";
}

// Matter that gives by itself what it absorbs is in equilibrium too, but its paths differ: the stated errors must be
// those that are there.
TEST_F(PathTraced, Test24GreyFurnaceErrorsAreAsStated) {
    scene::Scene scene = lumps();
    scene.environment = scene::Environment{glm::dvec3(1.0)};
    scene.background = scene::Background{glm::dvec3(1.0), glm::dvec3(1.0)};
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) {
        optics.albedo = glm::dvec3(0.6);
        optics.emission = 0.4;
    });
    const Traced traced = trace(scene, {24, 24}, {.samples = 256});
    const Estimate mean = estimate(traced, 1);
    report("mean - 1", mean.mean - 1.0);
    EXPECT_LE(std::abs(mean.mean - 1.0), 4.0 * mean.error);
    EXPECT_LT(mean.error, 2e-3) << "a test that could not fail";
    double squares = 0.0;
    int seen = 0;
    for (std::size_t n = 0; n < traced.mean.pixel_count(); ++n) {
        const double error = traced.error.rgba[4 * n + 1];
        if (error > 1e-4) {
            squares += std::pow((traced.mean.rgba[4 * n + 1] - 1.0) / error, 2.0);
            ++seen;
        }
    }
    ASSERT_GT(seen, 100);
    report("mean of z^2", squares / seen);
    // The mean of n squares of normal numbers varies by sqrt(2 / n).
    EXPECT_NEAR(squares / seen, 1.0, 4.0 * std::sqrt(2.0 / seen));
}

TEST_F(PathTraced, OpacityIsThatOfTheSlab) {
    for (const double tau : {0.1, 1.0, 3.0}) {
        const Estimate alpha = estimate(trace(wide_slab(tau / 0.01, 0.01, 0.0, 0.0), {32, 32}, {.samples = 64}), 3);
        EXPECT_LE(std::abs(alpha.mean + std::expm1(-tau)), 4.0 * alpha.error) << tau;
        EXPECT_LT(alpha.error, 3e-3);
    }
}

// Light and eye on the same side of a slab of depth 3, albedo 0.8, g 0.3: one scattering in closed form.
TEST_F(PathTraced, Section12SingleScatteringSlab) {
    for (const auto& [cosine, radiance] : {std::pair(1.0, 0.013151752), std::pair(0.5, 0.011782148)}) {
        scene::Scene scene = wide_slab(3.0, 1.0, 0.8, 0.3);
        scene.lights["sun"] = beam({std::sqrt(1.0 - cosine * cosine), 0.0, cosine});
        const Estimate light = estimate(trace(scene, {32, 32}, {.samples = 512, .scatterings = 1}), 0);
        report("single scattering / closed form - 1", light.mean / radiance - 1.0);
        EXPECT_LE(std::abs(light.mean - radiance), 4.0 * light.error) << cosine;
        EXPECT_LT(light.error, 2e-3 * radiance);
    }
}

// Uneven matter in many macrocells, whose bounds are far from what is there. Light from behind the eye meets on its way
// what the eye's ray has met, so that one scattering is albedo p E (1 - exp(-2 tau)) / 2, however tau is spread.
TEST_F(PathTraced, UnevenMatterIsMetAsOftenAsItIsThere) {
    constexpr int samples = 41;
    const auto value = [](int z) { return z % 9 == 4 ? 0.95 : 0.1 * noise({0, 0, z}); };
    const double sigma = 8.0;
    double tau = 0.0;
    for (int z = 0; z < samples; ++z) {
        tau += sigma * value(z) / samples;
    }
    scene::Scene scene = wide_slab(1.0, 1.0, 0.9, 0.0);
    volume_in(scene).grid.set(
        grid_of({1, 1, samples}, {400.0, 400.0, 1.0 / samples}, [&](glm::ivec3 at) { return value(at.z); }));
    volume_in(scene).transfer_function = linear_extinction(0.0, sigma, glm::dvec3(1.0), glm::dvec3(1.0));
    scene.lights["sun"] = beam({0.0, 0.0, 1.0});
    const Traced traced = trace(scene, {32, 32}, {.samples = 256, .scatterings = 1});
    const Estimate alpha = estimate(traced, 3);
    EXPECT_LE(std::abs(alpha.mean + std::expm1(-tau)), 4.0 * alpha.error);
    EXPECT_LT(alpha.error, 2e-3);
    const Estimate light = estimate(traced, 0);
    const double expected = 0.9 / (4.0 * pi) * -std::expm1(-2.0 * tau) / 2.0;
    report("uneven single scattering / closed form - 1", light.mean / expected - 1.0);
    EXPECT_LE(std::abs(light.mean - expected), 4.0 * light.error);
    EXPECT_LT(light.error, 2e-3 * expected);
}

// All of the light: the eye's ray sees, of an environment of radiance 1, what by reciprocity a beam along it would lose
// to all sides: R + T - exp(-tau) of the anchors (10^7 analogue histories, two figures of standard error 1.6e-4 each).
TEST_F(PathTraced, Section12SlabAnchors) {
    struct Anchor {
        double tau, albedo, g, reflected, transmitted;
    };
    for (const Anchor& a : {Anchor{1.0, 0.9, 0.0, 0.2675, 0.5917}, Anchor{4.0, 0.9, 0.8, 0.1121, 0.4418}}) {
        scene::Scene scene = wide_slab(a.tau, 1.0, a.albedo, a.g);
        scene.environment = scene::Environment{glm::dvec3(1.0)};
        const Estimate light = estimate(trace(scene, {32, 32}, {.samples = 512}), 2);
        const double expected = a.reflected + a.transmitted - std::exp(-a.tau);
        report("anchor difference", light.mean - expected);
        EXPECT_LE(std::abs(light.mean - expected), 4.0 * std::hypot(light.error, 1.6e-4 * std::sqrt(2.0))) << a.tau;
        EXPECT_LT(light.error, 1e-3);
    }
}

// Thin matter, scattered once, unshadowed to 1e-3: I sigma H albedo / (4 pi distance^2).
TEST_F(PathTraced, PointAndSpotLightsFallWithTheSquareOfTheDistance) {
    scene::Scene scene = wide_slab(0.1, 0.01, 0.5, 0.0);
    for (const scene::LightKind kind : {scene::LightKind::point, scene::LightKind::spot}) {
        scene.lights["lamp"] = scene::Light{.kind = kind,
                                            .direction_world = {0.0, 0.0, 1.0},
                                            .position_world = {0.0, 0.0, 0.5},
                                            .spot_angle_deg = 20.0,
                                            .intensity = 2.0};
        const Estimate light = estimate(trace(scene, {32, 32}, {.samples = 512, .scatterings = 1}), 0);
        const double expected = 2.0 * 1e-3 * 0.5 / (4.0 * pi * 0.25);
        EXPECT_LE(std::abs(light.mean - expected), 4.0 * light.error + 2e-3 * expected) << int(kind);
        EXPECT_LT(light.error, 0.06 * expected);
    }
    scene.lights.at("lamp").edit([](scene::Light& light) { light.direction_world = {1.0, 0.0, 0.0}; });
    EXPECT_EQ(estimate(trace(scene, {8, 8}, {.samples = 64, .scatterings = 1}), 0).mean, 0.0) << "outside of the cone";
}

TEST_F(PathTraced, Test23LightsAddUp) {
    scene::Scene scene = lumps();
    const PathGoal goal{.samples = 128};
    const auto with = [&](std::vector<scene::Light> lights) {
        scene.lights.clear();
        for (std::size_t n = 0; n < lights.size(); ++n) {
            scene.lights["lamp " + std::to_string(n)] = lights[n];
        }
        return trace(scene, {16, 16}, goal);
    };
    const scene::Light key = beam({1.0, 1.0, 0.5}, 3.0);
    const scene::Light fill{.kind = scene::LightKind::point, .position_world = {-1.0, 0.2, 1.0}, .intensity = 4.0};
    const Traced first = with({key});
    const Estimate one = estimate(first, 0);
    const Estimate other = estimate(with({fill}), 0);
    const Estimate both = estimate(with({key, fill}), 0);
    EXPECT_LE(apart(both, {one.mean + other.mean, std::hypot(one.error, other.error)}), 4.0);
    EXPECT_GT(std::abs(both.mean - one.mean), 10.0 * both.error) << "a test that could not fail";

    scene::Light off = fill;
    off.on = false;
    scene::Light black = fill;
    black.color = glm::dvec3(0.0);
    EXPECT_TRUE(same_bits(with({key, off, black}).mean, first.mean));

    // Of more than four lamps one is drawn by lot.
    scene::Light sixth = key;
    sixth.intensity /= 6.0;
    const Estimate six = estimate(with({sixth, sixth, sixth, sixth, sixth, sixth}), 0);
    EXPECT_LE(apart(six, one), 4.0);
}

TEST_F(PathTraced, Test18ForwardScatteringShinesTowardsTheLight) {
    scene::Scene scene = wide_slab(0.5, 1.0, 1.0, 0.8);
    scene.lights["sun"] = beam({0.0, 0.0, -1.0});  // behind the slab
    const Estimate toward = estimate(trace(scene, {16, 16}, {.samples = 32}), 0);
    scene.lights["sun"] = beam({0.0, 0.0, 1.0});
    const Estimate away = estimate(trace(scene, {16, 16}, {.samples = 32}), 0);
    EXPECT_GT(toward.mean, 10.0 * away.mean);
}

TEST_F(PathTraced, VolumesInOnePlaceAreOneMedium) {
    scene::Scene scene = lumps();
    scene.lights["key"] = beam({1.0, 1.0, 0.5}, 3.0);
    scene.environment = scene::Environment{glm::dvec3(0.2)};
    const PathGoal goal{.samples = 128};
    const Traced whole = trace(scene, {16, 16}, goal);
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.density_scale = 0.5; });
    scene::Node node;
    node.content = volume_in(scene);
    scene.nodes["second"] = node;
    const Traced halves = trace(scene, {16, 16}, goal);
    for (const int channel : {0, 3}) {
        EXPECT_LE(apart(estimate(whole, channel), estimate(halves, channel)), 4.0) << channel;
    }
    // A red and a green half meet one half of the light each; what only one of them asks for, both get.
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.albedo = {1.0, 0.0, 0.0}; });
    volume_in(scene, "second").optics.edit([](scene::VolumeOptics& optics) { optics.albedo = {0.0, 1.0, 0.0}; });
    volume_in(scene, "second").optics.edit([](scene::VolumeOptics& o) { o.lighting = scene::VolumeLighting::none; });
    const Traced colored = trace(scene, {16, 16}, {.samples = 128, .scatterings = 1});
    EXPECT_LE(apart(estimate(colored, 0), estimate(colored, 1)), 4.0);
    EXPECT_GT(estimate(colored, 0).mean, 20.0 * estimate(colored, 0).error);
    EXPECT_EQ(estimate(colored, 2).mean, 0.0);
}

TEST_F(PathTraced, ExtremesStayFiniteAndEnd) {
    for (const double density : {0.0, 1e-9, 1e9}) {
        for (const double g : {-0.99, 0.0, 0.99}) {
            scene::Scene scene = lumps();
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) {
                optics.density_scale = density;
                optics.g = g;
                optics.emission = density > 1.0 ? 0.0 : 1e6;
                optics.albedo = {0.9, 0.5, 0.0};
            });
            scene.lights["centre"] =
                scene::Light{.kind = scene::LightKind::point, .position_world = {}, .intensity = 1e12};
            scene.lights["corner"] = scene::Light{.kind = scene::LightKind::point,
                                                  .position_world = {0.55, 0.45, 0.5},
                                                  .color = glm::dvec3(1e6),
                                                  .intensity = 1e12};
            scene.lights["far"] =
                scene::Light{.kind = scene::LightKind::point, .position_world = {1e30, 0.0, 0.0}, .intensity = 1e12};
            const Traced traced = trace(scene, {5, 5}, {.samples = 3});
            for (std::size_t n = 0; n < traced.mean.pixel_count(); ++n) {
                EXPECT_GE(traced.mean.rgba[4 * n + 3], 0.0F);
                EXPECT_LE(traced.mean.rgba[4 * n + 3], 1.0F);
            }
        }
    }
    for (const double unit : {1e-9, 1e9}) {
        scene::Scene scene =
            scene_with(grid_of(glm::ivec3(4), glm::dvec3(unit), [](glm::ivec3 at) { return noise(at); }),
                       rich_transfer_function(unit));
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { path_traced(optics); });
        scene.camera = oblique_camera(scene);
        scene.lights["key"] = beam({1.0, 1.0, 0.5});
        EXPECT_GT(estimate(trace(scene, {5, 5}, {.samples = 4}), 0).mean, 0.0) << unit;
    }
}

}  // namespace
}  // namespace bruma::render
