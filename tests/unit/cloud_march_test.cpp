// Shelf: closed form. The fine march against integrals that can be written down, and its error estimate against a finer
// march.
#include "reference/clouds/cloud_march.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cloud_scenes.h"
#include "reference/clouds/cloud_phase.h"

namespace bruma::reference {
namespace {

constexpr double exact = 1e-9;

/// Light whose source is 1 everywhere: the artistic model without sun, under an even ambient light.
CloudLight even_light() {
    CloudLight light;
    light.sun_irradiance = [](double) { return glm::dvec3(0.0); };
    light.set_uniform_sky(glm::dvec3(1.0));
    return light;
}

std::vector<CloudMedium> evenly_lit(CloudMedium medium) {
    medium.optics.lighting = scene::CloudLighting::artistic;
    medium.optics.ambient = 1.0;
    return {std::move(medium)};
}

TEST(CloudMarch, HomogeneousSlab) {
    const auto media = evenly_lit(homogeneous_layer(1000.0, 1200.0, 0.013));
    for (const double climb : {0.2, 0.5, 1.0}) {
        const auto ray = ray_along({5.0, 10.0, -7.0}, {std::sqrt(1.0 - climb * climb), climb, 0.0});
        const double passed = std::exp(-0.013 * 200.0 / climb);
        for (const double step : {1000.0, 64.0, 3.3}) {
            const auto result = march_once(media, even_light(), ray, step, 1);
            EXPECT_NEAR(result.transmittance, passed, exact) << "at any step";
            EXPECT_NEAR(result.radiance.g, 1.0 - passed, 1e-7) << "the series in thin segments keeps 1e-9 each";
        }
        // Mean depth of exp(-sigma t) over [0, D] behind the entry.
        const double d = 200.0 / climb, sigma = 0.013;
        const double mean = 990.0 / climb + 1.0 / sigma - d * passed / (1.0 - passed);
        EXPECT_NEAR(march_once(media, even_light(), ray, 0.05, 1).mean_distance_m, mean, 1e-3 * mean);
    }
}

TEST(CloudMarch, ExponentialAndLinearProfiles) {
    const double climb = 0.4;
    const auto ray = ray_along({0.0, 0.0, 0.0}, {0.0, climb, std::sqrt(1.0 - climb * climb)});
    const auto exponential =
        evenly_lit(flat_layer(500.0, 2500.0, 0.01, [](double y) { return std::exp(-(y - 500.0) / 300.0); }));
    const auto found = march_clouds(exponential, even_light(), ray, {.tolerance = 1e-7});
    EXPECT_NEAR(found.transmittance, std::exp(-0.01 * 300.0 * -std::expm1(-2000.0 / 300.0) / climb), 1e-7);
    EXPECT_NEAR(found.radiance.g, 1.0 - found.transmittance, 1e-7);
    const auto linear = evenly_lit(flat_layer(500.0, 1500.0, 0.004, [](double y) { return (y - 500.0) / 1000.0; }));
    // Midpoints are exact for what is linear.
    EXPECT_NEAR(march_once(linear, even_light(), ray, 100.0, 1).transmittance, std::exp(-0.004 * 500.0 / climb), exact);
}

TEST(CloudMarch, SingleScatteringUnderAnOverheadSun) {
    const double sigma = 0.01, thickness = 300.0, tau = sigma * thickness;
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1000.0 + thickness, sigma)};
    media[0].optics.albedo = 0.7;
    const CloudLight light;  // overhead, irradiance 1, no sky
    const scene::CloudOptics& optics = media[0].optics;
    const auto up = march_clouds(media, light, ray_along({0, 0, 0}, {0, 1, 0}));
    // Every path through the slab is as long: exp(-tau) times the depth.
    EXPECT_NEAR(up.radiance.g, 0.7 * dual_lobe(1.0, optics) * tau * std::exp(-tau), 1e-4 * up.radiance.g);
    const auto down = march_clouds(media, light, ray_along({0, 5000, 0}, {0, -1, 0}));
    const double expected = 0.7 * dual_lobe(-1.0, optics) * -std::expm1(-2.0 * tau) / 2.0;
    EXPECT_NEAR(down.radiance.g, expected, 1e-4 * expected);
    EXPECT_LE(std::abs(down.radiance.g / expected - 1.0), down.view_error + down.sun_error);
    // The cone samples a constant exactly up to the exit: only the offsets of the samples leave the layer.
    const auto cone = march_clouds(media, light, ray_along({0, 0, 0}, {0, 1, 0}), {.sun_path = SunPath::cone});
    EXPECT_NEAR(cone.radiance.g, up.radiance.g, 1e-3 * up.radiance.g);
}

TEST(CloudMarch, SkyLightOfASlab) {
    // Ambient light of a uniform sky over a black ground: S(z) = exp(-sigma (top - z)) / 2, looked at from above.
    const double sigma = 0.01, thickness = 300.0;
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1000.0 + thickness, sigma)};
    media[0].optics.ambient = 1.0;
    CloudLight light = even_light();
    light.ground_albedo = glm::dvec3(0.0);
    const auto down = march_clouds(media, light, ray_along({0, 5000, 0}, {0, -1, 0}));
    const double expected = 0.5 * -std::expm1(-2.0 * sigma * thickness) / 2.0;
    EXPECT_NEAR(down.radiance.g, expected, 1e-4 * expected);
}

TEST(CloudMarch, OverlappingLayersAreTheirSum) {
    std::vector<CloudMedium> apart{homogeneous_layer(1000.0, 1400.0, 0.004), homogeneous_layer(1200.0, 1500.0, 0.007)};
    std::vector<CloudMedium> together{flat_layer(1000.0, 1500.0, 0.011, [](double y) {
        return ((y < 1400.0 ? 0.004 : 0.0) + (y > 1200.0 ? 0.007 : 0.0)) / 0.011;
    })};
    const auto ray = ray_along({0, 0, 0}, {0.3, 0.8, 0.1});
    CloudLight light;
    light.to_sun_world = glm::normalize(glm::dvec3(0.5, 0.6, 0.2));
    const auto a = march_clouds(apart, light, ray);
    const auto b = march_clouds(together, light, ray, {.tolerance = 1e-3});
    EXPECT_NEAR(a.radiance.g, b.radiance.g, 2e-3 * a.radiance.g);
    EXPECT_NEAR(a.transmittance, std::exp(-(0.004 * 400.0 + 0.007 * 300.0) / ray.direction_world.y), exact);
    EXPECT_EQ(stretches(apart, ray.origin_world, ray.direction_world).size(), 3U);
    EXPECT_TRUE(stretches(apart, ray.origin_world, {0.0, -1.0, 0.0}).empty());
}

TEST(CloudMarch, ErrorEstimateHoldsOnRealClouds) {
    const glm::dvec3 eye(0.0, 2.0, 0.0);
    const std::vector<CloudMedium> media{preset_medium(scene::CloudType::stratocumulus, eye)};
    CloudLight light;
    light.to_sun_world = glm::normalize(glm::dvec3(0.3, 0.9, 0.2));
    int cloudy = 0;
    for (int n = 0; n < 6; ++n) {
        const auto ray = ray_along(eye, {std::sin(2.4 * n), 1.2, std::cos(2.4 * n)});
        const auto found = march_clouds(media, light, ray, {.tolerance = 4e-3, .fewest_sun_samples = 32});
        const auto finer = march_once(media, light, ray, found.step_m / 4.0, found.sun_samples * 4);
        const double size = std::max(finer.radiance.g, 1e-9);
        EXPECT_LE(std::abs(found.radiance.g - finer.radiance.g) / size, found.view_error + found.sun_error + 1e-6) << n;
        EXPECT_LE(std::abs(found.transmittance - finer.transmittance), found.view_error + 1e-6) << n;
        EXPECT_LE(found.view_error + found.sun_error, 4e-3) << n;
        cloudy += found.transmittance < 0.99 ? 1 : 0;
    }
    EXPECT_GE(cloudy, 3) << "rays that meet a cloud";
}

TEST(CloudMarch, FiniteFromEverywhere) {
    for (const double height : {0.0, 1500.0, 2000.0, 4000.0, 1e5}) {
        const glm::dvec3 eye(100.0, height, 50.0);
        const std::vector<CloudMedium> media{preset_medium(scene::CloudType::cumulus, eye)};
        for (const double sun : {1.0, 0.0, -0.3}) {
            CloudLight light;
            light.to_sun_world = {0.0, sun, -std::sqrt(1.0 - sun * sun)};
            light.set_uniform_sky(glm::dvec3(0.1));
            for (const double climb : {-1.0, -0.05, 0.0, 0.3, 1.0}) {
                const auto ray = ray_along(eye, {std::sqrt(1.0 - climb * climb), climb, 0.0});
                const auto result = march_once(media, light, ray, 500.0, 4);
                ASSERT_TRUE(std::isfinite(result.radiance.r) && std::isfinite(result.mean_distance_m));
                ASSERT_TRUE(result.transmittance >= 0.0 && result.transmittance <= 1.0 && result.radiance.r >= 0.0);
            }
        }
    }
}

}  // namespace
}  // namespace bruma::reference
