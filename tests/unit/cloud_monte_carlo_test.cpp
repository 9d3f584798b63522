// Shelf: closed form, and the fine march where both compute the same: path tracing must agree within its own error
// bars. Samples are fixed by their counters, so that a test that passes once passes always.
#include "reference/clouds/cloud_monte_carlo.h"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numbers>

#include "cloud_scenes.h"
#include "reference/clouds/cloud_phase.h"

namespace bruma::reference {
namespace {

/// Four standard errors: one in 16000 by chance, were the numbers drawn anew.
constexpr double bars = 4.0;

TEST(CloudMonteCarlo, TransmittanceAndSingleScatteringOfASlab) {
    const double sigma = 0.01, thickness = 200.0, tau = sigma * thickness;
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1000.0 + thickness, sigma)};
    media[0].majorant = 1.7;  // loose, so that there are null collisions
    media[0].optics.albedo = 0.8;
    const auto result =
        trace_paths(media, CloudLight{}, ray_along({0, 5000, 0}, {0, -1, 0}), {.samples = 20000, .most_orders = 1});
    EXPECT_NEAR(result.transmittance, std::exp(-tau), bars * result.transmittance_error);
    EXPECT_LE(result.transmittance_error, 2e-3);
    const double expected = 0.8 * dual_lobe(-1.0, media[0].optics) * -std::expm1(-2.0 * tau) / 2.0;
    EXPECT_NEAR(result.radiance.g, expected, bars * result.standard_error.g);
    EXPECT_LE(result.standard_error.g, 0.02 * expected);
}

TEST(CloudMonteCarlo, WhiteFurnace) {
    // Nothing absorbs and everything around shines 1: what is scattered in is what is scattered out.
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1400.0, 0.01), homogeneous_layer(1300.0, 1500.0, 0.005)};
    CloudLight light;
    light.sun_irradiance = [](double) { return glm::dvec3(0.0); };
    light.set_uniform_sky(glm::dvec3(1.0));
    light.ground_albedo = glm::dvec3(1.0);
    const auto result = trace_paths(media, light, ray_along({0, 10, 0}, {0.5, 0.5, 0.0}), {.samples = 4000});
    EXPECT_NEAR(result.radiance.g + result.transmittance, 1.0,
                bars * (result.standard_error.g + result.transmittance_error));
    EXPECT_GT(result.mean_orders, 3.0) << "thick enough to mean something";
}

// Air before a cloud dims its light and adds its own, once for each path that met the cloud.
TEST(CloudMonteCarlo, AirBeforeTheCloud) {
    const std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1100.0, 0.01)};
    const scene::Ray ray = ray_along({0, 0, 0}, {0, 1, 0});
    MonteCarloOptions options{.samples = 4000};
    const auto clear = trace_paths(media, CloudLight{}, ray, options);
    double nearest = 1e30, farthest = 0.0;
    options.air = [&](double distance_m) {
        nearest = std::min(nearest, distance_m);
        farthest = std::max(farthest, distance_m);
        return AirLight{glm::dvec3(0.25), glm::dvec3(0.5)};
    };
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const auto hazy = trace_paths(media, CloudLight{}, ray, options);
    const double met = (hazy.radiance.g - 0.5 * clear.radiance.g) / 0.25;
    EXPECT_NEAR(met, 1.0 - std::exp(-1.0), bars * std::sqrt(0.25 / 4000.0));
    EXPECT_GE(nearest, 1000.0);
    EXPECT_LE(farthest, 1100.0 + 1e-6);
}

/// A sun of irradiance 1 over black ground, no sky.
CloudLight lone_sun(double climb) {
    CloudLight light;
    light.to_sun_world = {std::sqrt(1.0 - climb * climb), climb, 0.0};
    light.sun_irradiance = [](double) { return glm::dvec3(1.0); };
    light.ground_albedo = glm::dvec3(0.0);
    return light;
}

/// Irradiance of level ground by scattered light beside that by the bare sun, by one direction, cosine-weighted for
/// uniform `s` and `turn`.
double scattered_down(const std::vector<CloudMedium>& media, const CloudLight& light, const glm::dvec3& at, double s,
                      double turn, const MonteCarloOptions& options) {
    const double phi = 2.0 * std::numbers::pi * turn;
    const glm::dvec3 toward(std::sqrt(s) * std::cos(phi), std::sqrt(1.0 - s), std::sqrt(s) * std::sin(phi));
    return std::numbers::pi * trace_paths(media, light, {at, toward, 0.0}, options).radiance.g / light.to_sun_world.y;
}

// Shelf: random paths. What of the sun's light reaches the ground, straight and scattered, in the mean over places: the
// model that pictures take against paths of all orders.
TEST(CloudMonteCarlo, LightOnTheGroundBelowClouds) {
    for (const scene::CloudType type :
         {scene::CloudType::cumulus, scene::CloudType::stratocumulus, scene::CloudType::stratus}) {
        for (const double climb : {0.85, 0.35}) {
            const std::vector<CloudMedium> media{preset_medium(type, {0.0, 2.0, 0.0})};
            const CloudLight light = lone_sun(climb);
            double model = 0.0, straight = 0.0, paths = 0.0, squares = 0.0;
            constexpr int points = 400;
            for (int n = 0; n < points; ++n) {
                const auto u = [&](double step) { return std::fmod(0.5 + step * n, 1.0); };  // Kronecker's points
                const glm::dvec3 at(20e3 * u(0.7548776662), 0.0, 20e3 * u(0.5698402910));
                const double depth = optical_depth(media, at, light.to_sun_world, 64);
                model += light_on_ground_below_clouds(depth, climb, media[0].optics) / points;
                straight += std::exp(-depth) / points;
                const double share =
                    std::exp(-depth) + scattered_down(media, light, at, u(0.4301597090), u(0.8191725134),
                                                      {.samples = 16, .pixel = std::uint32_t(n)});
                paths += share / points;
                squares += share * share / points;
            }
            const double error = std::sqrt((squares - paths * paths) / points);
            EXPECT_NEAR(model, paths, 3.0 * error) << "preset " << int(type) << ", sun at " << climb;
            EXPECT_LE(error, 0.03);
            if (type != scene::CloudType::stratus) {
                EXPECT_GT(paths, straight + 6.0 * error) << "there is scattered light to miss";
            }
            RecordProperty(fmt::format("preset_{}_{}", int(type), climb),
                           fmt::format("model {:.3f}, paths {:.3f} +- {:.3f}", model, paths, error));
        }
    }
}

// Shelf: random paths. The same below closed decks, thin to thick.
TEST(CloudMonteCarlo, LightOnTheGroundBelowADeck) {
    for (const double depth : {1.0, 5.0, 25.0}) {
        for (const double climb : {0.85, 0.35}) {
            const std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1300.0, depth / 300.0)};
            const CloudLight light = lone_sun(climb);
            constexpr int directions = 300;
            double paths = std::exp(-depth / climb);
            for (int n = 0; n < directions; ++n) {
                paths += scattered_down(media, light, glm::dvec3(0.0), (n + 0.5) / directions,
                                        std::fmod(0.618034 * n, 1.0), {.samples = 64, .pixel = std::uint32_t(n)}) /
                         directions;
            }
            const double model = light_on_ground_below_clouds(depth / climb, climb, media[0].optics);
            // Of the light without clouds; two terms in direction leave that much under a thin deck and a low sun.
            EXPECT_NEAR(model, paths, 0.02) << "depth " << depth << ", sun at " << climb;
            EXPECT_NEAR(model / paths, 1.0, 0.15);  // 0.11 under 25 and 0.35: of a twentieth of the light
        }
    }
}

/// Chandrasekhar's H function of isotropic scattering (Radiative Transfer, 1960, chapter V), at midpoints in mu.
std::vector<double> h_function(double albedo, int n) {
    std::vector<double> h(std::size_t(n), 1.0);
    for (int iteration = 0; iteration < 200; ++iteration) {
        std::vector<double> next;
        for (int i = 0; i < n; ++i) {
            double sum = 0.0;
            for (int j = 0; j < n; ++j) {
                const double mu = (j + 0.5) / n;
                sum += mu * h[std::size_t(j)] / ((i + 0.5) / n + mu) / n;
            }
            next.push_back(1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * sum));
        }
        h = next;
    }
    return h;
}

TEST(CloudMonteCarlo, AllOrdersOfAThickIsotropicSlab) {
    const double albedo = 0.9;
    const auto h = h_function(albedo, 100);
    double mean = 0.0;
    for (const double value : h) {
        mean += value / double(h.size());
    }
    EXPECT_NEAR(mean, 2.0 / albedo * (1.0 - std::sqrt(1.0 - albedo)), 1e-4) << "its integral is known";
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1040.0, 1.0)};
    media[0].optics.albedo = albedo;
    media[0].optics.forward_g = media[0].optics.backward_g = 0.0;
    const double mu = 0.705, mu_sun = 0.405;  // midpoints 70 and 40
    CloudLight light;
    light.to_sun_world = {0.0, mu_sun, std::sqrt(1.0 - mu_sun * mu_sun)};
    const auto result =
        trace_paths(media, light, ray_along({0, 1100, 0}, {std::sqrt(1.0 - mu * mu), -mu, 0.0}), {.samples = 40000});
    const double expected = albedo / (4.0 * std::numbers::pi) * mu_sun / (mu + mu_sun) * h[70] * h[40];
    EXPECT_NEAR(result.radiance.g, expected, bars * result.standard_error.g);
    EXPECT_LE(result.standard_error.g, 0.01 * expected);
}

TEST(CloudMonteCarlo, GroundLightOfALambertPlane) {
    // Very thin matter over a sunlit ground: with an isotropic phase, half of all directions see the ground, whose
    // radiance is its albedo over pi.
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1001.0, 1e-3)};
    media[0].optics.forward_g = media[0].optics.backward_g = 0.0;
    CloudLight light;
    light.ground_albedo = glm::dvec3(0.5);
    const auto result = trace_paths(media, light, ray_along({0, 5000, 0}, {0, -1, 0}), {.samples = 400000});
    const double direct = 1.0 / (4.0 * std::numbers::pi);
    const double from_ground = 0.5 * 0.5 / std::numbers::pi;
    EXPECT_NEAR(result.radiance.g, 1e-3 * (direct + from_ground), bars * result.standard_error.g + 1e-5 * 1e-3);
    EXPECT_LE(result.standard_error.g, 0.06e-3 * (direct + from_ground) * 1.5);
}

TEST(CloudMonteCarlo, SingleScatteringAgreesWithTheMarchOnRealClouds) {
    const glm::dvec3 eye(0.0, 2.0, 0.0);
    std::vector<CloudMedium> media{preset_medium(scene::CloudType::stratocumulus, eye)};
    media[0].optics.multiple_scattering = scene::MultipleScattering::octaves;
    media[0].optics.octaves = 1;
    media[0].optics.ambient = 0.0;
    CloudLight light;
    light.to_sun_world = glm::normalize(glm::dvec3(0.3, 0.9, 0.2));
    int cloudy = 0;
    for (int n = 0; n < 4; ++n) {
        const auto ray = ray_along(eye, {std::sin(2.4 * n), 1.2, std::cos(2.4 * n)});
        const auto march = march_once(media, light, ray, 8.0, 128);
        const auto paths =
            trace_paths(media, light, ray, {.samples = 3000, .pixel = std::uint32_t(n), .most_orders = 1});
        EXPECT_NEAR(paths.radiance.g, march.radiance.g, bars * paths.standard_error.g + 2e-3 * march.radiance.g) << n;
        EXPECT_NEAR(paths.transmittance, march.transmittance, bars * paths.transmittance_error + 1e-3) << n;
        cloudy += march.transmittance < 0.9 ? 1 : 0;
    }
    EXPECT_GE(cloudy, 2);
}

TEST(CloudMonteCarlo, SameBitsOnAnyNumberOfThreadsAndHonestErrors) {
    std::vector<CloudMedium> media{homogeneous_layer(1000.0, 1300.0, 0.01)};
    const auto ray = ray_along({0, 0, 0}, {0.2, 1.0, 0.0});
    CloudLight light;
    light.to_sun_world = glm::normalize(glm::dvec3(0.5, 0.5, 0.0));
    const auto many = trace_paths(media, light, ray, {.samples = 500});
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(trace_paths(media, light, ray, {.samples = 500}).radiance, many.radiance);
    }
    // The spread of 40 independent means is what each says of itself.
    double mean = 0.0, square = 0.0, claimed = 0.0;
    for (std::uint32_t pixel = 0; pixel < 40; ++pixel) {
        const auto result = trace_paths(media, light, ray, {.samples = 400, .pixel = pixel});
        mean += result.radiance.g / 40.0;
        square += result.radiance.g * result.radiance.g / 40.0;
        claimed += result.standard_error.g / 40.0;
    }
    const double spread = std::sqrt((square - mean * mean) * 40.0 / 39.0);
    EXPECT_NEAR(spread / claimed, 1.0, 0.35) << "of 40 means the spread itself is known to a tenth";
}

}  // namespace
}  // namespace bruma::reference
