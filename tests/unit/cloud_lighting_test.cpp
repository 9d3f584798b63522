// Shelf: closed form (phase functions integrate to 1, constant media) and check values computed apart from this code.
#include "reference/clouds/cloud_lighting.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>

#include "base/integer_hash.h"
#include "cloud_scenes.h"
#include "reference/clouds/cloud_monte_carlo.h"
#include "reference/clouds/cloud_phase.h"

namespace bruma::reference {
namespace {

/// Over the sphere, by midpoints in the cosine or, for sharp peaks, in the angle.
double over_sphere(const std::function<double(double)>& phase, bool in_angle = false) {
    constexpr int n = 200000;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const double x = (i + 0.5) / n;
        const double theta = std::numbers::pi * x;
        sum +=
            in_angle ? phase(std::cos(theta)) * std::sin(theta) * std::numbers::pi / n : phase(2.0 * x - 1.0) * 2.0 / n;
    }
    return 2.0 * std::numbers::pi * sum;
}

TEST(CloudLighting, PhaseFunctionsIntegrateToOne) {
    const scene::CloudOptics optics;
    EXPECT_NEAR(over_sphere([&](double mu) { return dual_lobe(mu, optics); }), 1.0, 5e-9);
    EXPECT_NEAR(over_sphere([&](double mu) { return dual_lobe(mu, optics, 0.25); }), 1.0, 5e-9);
    EXPECT_NEAR(over_sphere([](double mu) { return draine(mu, 0.55567, 21.9955); }), 1.0, 5e-9);
    EXPECT_NEAR(schlick_k(0.8), 0.9584, 5e-5);
    EXPECT_NEAR(over_sphere([](double mu) { return schlick(mu, schlick_k(0.8)); }), 1.0, 5e-9);
    EXPECT_NEAR(over_sphere(droplets_10_um, true), 1.0, 5e-8) << "midpoints of the peak err by 4e-8";
    EXPECT_GT(schlick(1.0, schlick_k(0.8)), schlick(-1.0, schlick_k(0.8))) << "k > 0 is forward";
    EXPECT_GT(henyey_greenstein(1.0, 0.5), henyey_greenstein(-1.0, 0.5)) << "g > 0 peaks towards the sun";
}

TEST(CloudLighting, DrawnDirectionsFollowTheLobe) {
    // The mean cosine of a Henyey-Greenstein lobe is g, its mean second Legendre polynomial g^2.
    for (const double g : {-0.3, 0.0, 0.0005, 0.6, 0.9}) {
        const glm::dvec3 forward = glm::normalize(glm::dvec3(0.3, -0.5, -0.8));
        double first = 0.0, second = 0.0;
        glm::dvec3 mean(0.0);
        constexpr int edge = 300;
        for (int n = 0; n < edge * edge; ++n) {
            const glm::dvec3 d = sample_henyey_greenstein(forward, g, (n % edge + 0.5) / edge, (n / edge + 0.5) / edge);
            const double mu = glm::dot(d, forward);
            ASSERT_NEAR(glm::length(d), 1.0, 1e-12);
            first += mu / (edge * edge);
            second += 0.5 * (3.0 * mu * mu - 1.0) / (edge * edge);
            mean += d / double(edge * edge);
        }
        EXPECT_NEAR(first, g, 2e-3) << "g " << g;
        EXPECT_NEAR(second, g * g, 2e-3) << "g " << g;
        EXPECT_NEAR(glm::distance(mean, g * forward), 0.0, 2e-3) << "the lobe leans to a side";
    }
}

scene::CloudOptics as_printed() {
    scene::CloudOptics optics;
    optics.powder = scene::CloudPowder::everywhere;
    return optics;
}

TEST(CloudLighting, ArtisticHasItsCheckValues) {
    const scene::CloudOptics optics = as_printed();
    constexpr double nine_digits = 5e-10;
    EXPECT_NEAR(powdered_attenuation(0.8, 0.4, optics), 0.738251668, nine_digits);
    EXPECT_NEAR(in_out_scatter(0.8, optics), 0.991125515, nine_digits);
    EXPECT_NEAR(artistic_scatter(0.8, 0.4, optics), 0.731700065, nine_digits);
    EXPECT_NEAR(powdered_attenuation(-0.3, 1.2, optics), 0.547740979, nine_digits);
    EXPECT_NEAR(in_out_scatter(-0.3, optics), 0.073114665, nine_digits);
    EXPECT_NEAR(artistic_scatter(-0.3, 1.2, optics), 0.040047898, nine_digits);
    EXPECT_NEAR(in_out_scatter(1.0, optics), 1.5296, 5e-5);
    EXPECT_NEAR(in_out_scatter(0.5, optics), 0.40868, 5e-6);
    EXPECT_NEAR(in_out_scatter(0.0, optics), 0.07482, 5e-6);
    EXPECT_NEAR(in_out_scatter(-1.0, optics), 0.07614, 5e-6);
    EXPECT_NEAR(over_sphere([&](double mu) { return in_out_scatter(mu, optics); }), 3.84, 5e-3)
        << "a look, not a phase";
}

TEST(CloudLighting, PowderPeaksWhereItShouldAndLeavesTheSunSideBright) {
    scene::CloudOptics optics = as_printed();
    const double peak = std::log(3.0) / 2.0;
    EXPECT_NEAR(powdered_attenuation(0.3, peak, optics), 4.0 / (3.0 * std::sqrt(3.0)), 1e-14);
    EXPECT_LT(powdered_attenuation(0.3, peak + 0.01, optics), powdered_attenuation(0.3, peak, optics));
    EXPECT_EQ(powdered_attenuation(1.0, 0.0, optics), 0.0) << "black, as printed";
    optics.powder = scene::CloudPowder::away_from_sun;
    EXPECT_NEAR(powdered_attenuation(1.0, 0.7, optics), std::exp(-0.7), 1e-15) << "towards the sun: no dark edge";
    EXPECT_NEAR(powdered_attenuation(-1.0, 0.7, optics), std::exp(-0.7) * 2.0 * (1.0 - std::exp(-1.4)), 1e-15);
    optics.silver_exponent = 0.0;
    EXPECT_EQ(silver_rim(0.0, optics), 0.0);
    EXPECT_EQ(silver_rim(0.1, optics), optics.silver_intensity);
}

TEST(CloudLighting, OctavesHaveTheirCheckValues) {
    scene::CloudOptics optics;
    optics.forward_g = 0.7;
    constexpr double nine_digits = 5e-10;
    EXPECT_NEAR(scattering_octaves(1.0, 2.0, optics), 0.166649995, nine_digits);
    EXPECT_NEAR(scattering_octaves(0.0, 8.0, optics), 0.013472422, nine_digits);
    EXPECT_NEAR(scattering_octaves(-0.5, 20.0, optics), 0.005039985, nine_digits);
    optics.octaves = 3;
    EXPECT_NEAR(scattering_octaves(1.0, 2.0, optics), 0.149148104, nine_digits);
    EXPECT_NEAR(scattering_octaves(0.0, 8.0, optics), 0.003225136, nine_digits);
    EXPECT_NEAR(scattering_octaves(-0.5, 20.0, optics), 0.000122472, nine_digits);
    optics.octaves = 1;
    EXPECT_NEAR(scattering_octaves(1.0, 2.0, optics), 0.104704830, nine_digits);
    EXPECT_NEAR(scattering_octaves(0.0, 8.0, optics), 1.58e-5, 5e-8);
    EXPECT_NEAR(scattering_octaves(-0.5, 20.0, optics), 1.2e-10, 5e-12);
}

TEST(CloudLighting, SegmentWeightConservesEnergy) {
    // Constant matter, cut up anyhow, shines 1 - exp(-tau); naive sums do not, by these measured amounts.
    const auto sums = [](double tau, int steps) {
        double exact = 0.0, before = 0.0, after = 0.0, passed = 1.0;
        const double ds = 1.0 / steps;
        for (int n = 0; n < steps; ++n) {
            exact += passed * tau * segment_weight(tau, ds);
            before += passed * tau * ds;
            passed *= std::exp(-tau * ds);
            after += passed * tau * ds;
        }
        return std::array{exact, before, after};
    };
    for (const int steps : {1, 4, 16, 10000}) {
        EXPECT_NEAR(sums(8.0, steps)[0], -std::expm1(-8.0), 1e-7) << "four terms of the series: 1e-9 per segment";
    }
    EXPECT_NEAR(sums(8.0, 4)[1], 2.312, 5e-4);
    EXPECT_NEAR(sums(8.0, 4)[2], 0.313, 5e-4);
    EXPECT_NEAR(sums(8.0, 16)[1], 1.270, 5e-4);
    EXPECT_NEAR(sums(8.0, 16)[2], 0.770, 1e-3);
    double largest = 0.0;
    for (int n = 0; n <= 40000; ++n) {
        const float x = std::pow(10.0F, -8.0F + 9.5F * float(n) / 40000.0F);
        const double exact = -std::expm1(-double(x)) / double(x);
        largest = std::max(largest, std::abs(double(segment_weight(x, 1.0F)) / exact - 1.0));
    }
    // Behind the switch at 0.02 the rounding of exp(-x), 2^-25, is divided by 0.02.
    EXPECT_LE(largest, 1.6e-6) << "single precision";
    EXPECT_EQ(segment_weight(0.0, 7.0), 7.0) << "no division by 0";
}

TEST(CloudLighting, ConeHasItsFixedKernelAndTilesItsReach) {
    const auto& kernel = cone_kernel();
    EXPECT_NEAR(glm::distance(kernel[0], {-0.184917, -0.939600, -0.288023}), 0.0, 1e-6);
    EXPECT_NEAR(glm::distance(kernel[4], {-0.202527, -0.785777, 0.584412}), 0.0, 1e-6);
    EXPECT_EQ(kernel[5], glm::dvec3(0.0));
    const scene::CloudOptics optics;
    for (const double exit : {1e9, 900.0, 100.0, 0.0}) {
        double length = 0.0, begin = 0.0;
        for (const ConeSample& sample : cone_samples(optics, 2500.0, exit)) {
            EXPECT_NEAR(sample.distance_m, begin + 0.5 * sample.length_m, 1e-9);
            EXPECT_LE(glm::length(sample.offset_world), optics.cone_spread * sample.distance_m + 1e-9) << "a tube";
            begin += sample.length_m;
            length += sample.length_m;
        }
        EXPECT_NEAR(length, std::min(exit, 4.0 * 0.4 * 2500.0), 1e-9);
    }
}

TEST(CloudLighting, AmbientOfAWhiteWorldIsOne) {
    // Sky of radiance 1 over a white ground lit by it alone: radiance 1 from everywhere, hence a source of 1.
    CloudLight light;
    light.sun_irradiance = [](double) { return glm::dvec3(0.0); };
    light.set_uniform_sky(glm::dvec3(1.0));
    light.ground_albedo = glm::dvec3(1.0);
    EXPECT_NEAR(ambient_source(light, {0, 1, 0}, 0.0, 0.0).r, 1.0, 1e-15);
    EXPECT_NEAR(ambient_source(light, {0, 1, 0}, 2.0, 1e9).r, 0.5 * std::exp(-2.0), 1e-15);
}

TEST(CloudLighting, DiffusedLightHasItsLimits) {
    const scene::CloudOptics optics;
    EXPECT_EQ(scattered_again(0.3, 0.7, {}, optics), 0.0) << "nothing scatters it again";
    // What the sky sends and what the ground sends are shares of one.
    CloudLight light;
    light.sun_irradiance = [](double) { return glm::dvec3(0.0); };
    light.set_uniform_sky(glm::dvec3(1.0));
    light.ground_albedo = glm::dvec3(1.0);
    EXPECT_NEAR(diffused_ambient_source(light, {0, 1, 0}, {}, optics).r, 1.0, 1e-15) << "a white world";
    EXPECT_NEAR(share_from_above({.up = 3.0, .down = 7.0}, optics) + share_from_above({.up = 7.0, .down = 3.0}, optics),
                1.0, 1e-15)
        << "as much from above here as from below there";
    // Deep in a thick layer light falls as 1 / depth, and not as exp(-depth).
    const auto deep = [&](double depth) {
        return scattered_again(0.0, 0.7, {.sun = depth, .up = depth, .down = 0.0}, optics);
    };
    EXPECT_NEAR(deep(4000.0) / deep(2000.0), 0.5, 0.01);
    scene::CloudOptics black = optics;
    black.albedo = 0.0;
    EXPECT_EQ(scattered_again(0.3, 0.7, {5.0, 5.0, 5.0}, black), 0.0);
    black.albedo = 0.9;
    EXPECT_LT(scattered_again(0.3, 0.7, {5.0, 5.0, 5.0}, black),
              0.6 * scattered_again(0.3, 0.7, {5.0, 5.0, 5.0}, optics));
}

// Shelf: random paths. Slabs, which no preset is and nothing was fitted to.
TEST(CloudLighting, DiffusedLightOfSlabsIsNearThatOfRandomPaths) {
    for (const double depth : {0.3, 3.0, 12.0}) {
        for (const double climb : {0.35, 0.9}) {
            CloudMedium medium = homogeneous_layer(1000.0, 1300.0, depth / 300.0);
            medium.optics = scene::CloudOptics{.extinction_per_m = depth / 300.0};
            const std::vector<CloudMedium> media{medium};
            CloudLight light;
            light.to_sun_world = {std::sqrt(1.0 - climb * climb), climb, 0.0};
            light.set_uniform_sky(glm::dvec3(0.08));
            light.ground_albedo = glm::dvec3(0.3);
            for (const double side : {1.0, -1.0}) {
                const auto ray = ray_along({0, side > 0.0 ? 0.0 : 2000.0, 0}, {0.3, side, 0.6});
                const double modelled = march_once(media, light, ray, 4.0, 16).radiance.g;
                const auto paths = trace_paths(media, light, ray, {.samples = 3000});
                EXPECT_NEAR(modelled / paths.radiance.g, 1.0, 0.3 + 4.0 * paths.standard_error.g / paths.radiance.g)
                    << "depth " << depth << ", sun " << climb << ", from " << (side > 0.0 ? "below" : "above");
                RecordProperty(fmt::format("ratio_{}_{}_{}", depth, climb, side),
                               fmt::format("{:.3f}", modelled / paths.radiance.g));
            }
        }
    }
}

}  // namespace
}  // namespace bruma::reference
