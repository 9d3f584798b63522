// Shelf: check values of the density, computed apart from this code; and identities of the field.
#include "reference/clouds/cloud_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/integer_hash.h"
#include "scene/clouds/cloud_presets.h"

namespace bruma::reference {
namespace {

constexpr double nine_digits = 5e-10;

CloudTerms golden_terms(const scene::CloudLayer& layer, const scene::CloudWeather& weather, double height) {
    return cloud_terms(layer, weather, effective_coverage(layer, weather), height,
                       base_shape(shape_texel<double>({10, 20, 30})), detail_octaves(detail_texel<double>({5, 7, 9})));
}

TEST(CloudField, DensityHasItsCheckValues) {
    scene::CloudLayer layer;
    layer.coverage = 0.8;
    layer.density = 0.8;
    const scene::CloudWeather weather{0.7, 0.9, 0.8, 0.6};
    const CloudTerms terms = golden_terms(layer, weather, 0.1);
    EXPECT_NEAR(terms.base, 0.861777707, nine_digits);
    EXPECT_NEAR(terms.coverage, 0.8 * 0.86, 1e-15);
    EXPECT_NEAR(terms.height_shape, 1.0, 1e-15);
    EXPECT_NEAR(terms.height_density, 0.064, 1e-15);
    EXPECT_NEAR(terms.shape, 0.799095504, nine_digits);
    EXPECT_NEAR(terms.erosion, 0.096042036, nine_digits);
    EXPECT_NEAR(terms.density, 0.049776011, nine_digits);
    layer.erosion = scene::CloudErosion::grows;
    EXPECT_NEAR(golden_terms(layer, weather, 0.1).density, 0.045122689, nine_digits);
    layer.erosion = scene::CloudErosion::fades;
    layer.coverage_rule = scene::CoverageRule::overlay;
    const CloudTerms overlay = golden_terms(layer, weather, 0.1);
    EXPECT_NEAR(overlay.coverage, 0.56, 1e-15);
    EXPECT_NEAR(overlay.shape, 0.753174476, nine_digits);
    EXPECT_NEAR(overlay.density, 0.046524814, nine_digits);
}

TEST(CloudField, DensityHasItsCheckValuesHigherUp) {
    scene::CloudLayer layer;
    layer.coverage = 0.9;
    layer.density = 0.8;
    const CloudTerms terms = golden_terms(layer, {0.9, 1.0, 0.9, 0.6}, 0.25);
    EXPECT_NEAR(terms.height_shape, 0.902777778, nine_digits);
    EXPECT_NEAR(terms.shape, 0.750834751, nine_digits);
    EXPECT_NEAR(terms.erosion, 0.100123314, nine_digits);
    EXPECT_NEAR(terms.density, 0.173546828, nine_digits);
}

TEST(CloudField, ErosionObeysItsBound) {
    // At the bottom of the layer the detail noise enters as it is, so that 1 gives the factor alone.
    scene::CloudLayer layer;
    for (const double coverage : {0.0, 0.4, 0.8, 1.0}) {
        layer.coverage = coverage;
        layer.erosion = scene::CloudErosion::fades;
        const double fades = cloud_terms(layer, {}, 0.5, 0.0, 0.9, 1.0).erosion;
        EXPECT_NEAR(fades, 0.35 * std::exp(-0.75 * coverage), 1e-15);
        EXPECT_LE(fades, 0.35);
        layer.erosion = scene::CloudErosion::grows;
        EXPECT_NEAR(cloud_terms(layer, {}, 0.5, 0.0, 0.9, 1.0).erosion, 0.35 * std::exp(0.75 * coverage), 1e-15);
    }
    EXPECT_NEAR(0.35 * std::exp(-0.75), 0.165, 5e-4);
    EXPECT_NEAR(0.35 * std::exp(0.75), 0.741, 5e-4) << "twice the bound that its text gives";
}

TEST(CloudField, EveryParameterAtItsEndsGivesANumber) {
    for (const double coverage : {0.0, 1e-4, 0.5, 1.0}) {
        for (const double density : {0.0, 1.0, 1e6}) {
            for (const double channel : {0.0, 1.0 / 255.0, 0.5, 1.0}) {
                for (const double top : {0.0, 1.0 / 255.0, 1.0}) {
                    for (const double height : {0.0, 1e-9, 0.5, 1.0}) {
                        for (const double noise : {0.0, 1.0}) {
                            for (const auto erosion : {scene::CloudErosion::fades, scene::CloudErosion::grows}) {
                                for (const bool follows : {false, true}) {
                                    scene::CloudLayer layer;
                                    layer.coverage = coverage;
                                    layer.density = density;
                                    layer.erosion = erosion;
                                    layer.density_follows_top = follows;
                                    const scene::CloudWeather weather{channel, 1.0 - channel, top, channel};
                                    const CloudTerms terms = cloud_terms(
                                        layer, weather, effective_coverage(layer, weather), height, noise, 1.0 - noise);
                                    ASSERT_TRUE(std::isfinite(terms.density));
                                    ASSERT_GE(terms.density, 0.0);
                                    ASSERT_LT(terms.erosion, 1.0);
                                    if (coverage == 0.0 || top == 0.0) {
                                        ASSERT_EQ(terms.density, 0.0);
                                    }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    EXPECT_EQ(ramp(0.5, 0.5, 0.5), 1.0) << "a step where the ramp has no width";
    EXPECT_EQ(ramp(0.4, 0.5, 0.5), 0.0);
}

/// Small textures: another field of the same sort, ready in milliseconds.
std::shared_ptr<const CloudNoise> small_noise() {
    static const auto noise = make_cloud_noise(scene::NoisePacking::channels, 32, 16);
    return noise;
}

glm::dvec3 place(std::uint32_t n, const scene::CloudLayer& layer) {
    const auto random = [&](std::uint32_t k) { return unit_interval(pcg(5 * n + k)); };
    return {1e5 * (random(0) - 0.5), layer.bottom_m + (layer.top_m - layer.bottom_m) * (1.2 * random(1) - 0.1),
            1e5 * (random(2) - 0.5)};
}

CloudField field_of(const scene::Cloud& cloud, double time_s = 0.0) {
    return {cloud.layer, scene::make_weather_map(cloud.weather.pattern, cloud.weather.variation, 128), small_noise(),
            time_s};
}

TEST(CloudField, EarlyOutsAndBoundsChangeNothing) {
    for (std::size_t type = 0; type < 6; ++type) {
        const scene::Cloud cloud = scene::cloud_preset(scene::CloudType(type));
        const CloudField field = field_of(cloud);
        int cloudy = 0;
        double most = 0.0;
        for (std::uint32_t n = 0; n < 20000; ++n) {
            const glm::dvec3 p = place(n, cloud.layer);
            const double density = field.density(p);
            const bool inside = p.y > cloud.layer.bottom_m && p.y < cloud.layer.top_m;
            ASSERT_NEAR(density, inside ? field.terms(p).density : 0.0, 1e-15);
            ASSERT_LE(density, field.density_without_detail(p));
            ASSERT_LE(density, field.majorant() * (1.0 + 1e-12));
            cloudy += density > 0.0 ? 1 : 0;
            most = std::max(most, density);
        }
        EXPECT_GT(cloudy, 200) << "preset " << type << " has hardly a cloud";
        EXPECT_LT(cloudy, 16000) << "preset " << type << " is a block";
        EXPECT_GT(most, 0.1 * field.majorant()) << "preset " << type << ": a majorant this loose wastes collisions";
    }
}

TEST(CloudField, TheWindCarriesThePattern) {
    scene::Cloud cloud = scene::cloud_preset(scene::CloudType::cumulus);
    cloud.layer.wind_azimuth_deg = 90.0;
    cloud.layer.wind_speed_m_s = 12.0;
    const glm::dvec3 east(1.0, 0.0, 0.0);
    EXPECT_NEAR(glm::distance(wind_direction_world(cloud.layer), east), 0.0, 1e-15);
    const CloudField before = field_of(cloud, 0.0);
    // A year from now the pattern has gone far and has lost nothing: metres in 1e8 keep 1e-8 m.
    for (const double time : {10.0, 1e7}) {
        const CloudField after = field_of(cloud, time);
        for (std::uint32_t n = 0; n < 300; ++n) {
            const glm::dvec3 p = place(n, cloud.layer);
            EXPECT_NEAR(after.density(p + east * (12.0 * time)), before.density(p), 1e-9);
        }
    }
    // With skew and without height: the top is the bottom's pattern from further back.
    scene::CloudLayer upright = cloud.layer, leaning = cloud.layer;
    leaning.coverage = upright.coverage = 0.8;
    upright.skew_m = 0.0;
    leaning.skew_m = 700.0;
    const auto map = scene::make_weather_map(scene::WeatherPattern::overcast, 1, 1);  // the same everywhere
    const CloudField straight(upright, map, small_noise()), skewed(leaning, map, small_noise());
    int seen = 0;
    for (std::uint32_t n = 0; n < 2000; ++n) {
        const glm::dvec3 p = place(n, cloud.layer);
        const double height = (p.y - upright.bottom_m) / (upright.top_m - upright.bottom_m);
        EXPECT_NEAR(skewed.density(p + east * (700.0 * height)), straight.density(p), 1e-9);
        seen += straight.density(p) > 0.0 ? 1 : 0;
    }
    EXPECT_GT(seen, 20);
}

TEST(CloudField, LinearCoverageIsTheCloudyShare) {
    // Where the profiles are 1 and the map says yes, the share of cloudy points is the coverage, up to erosion.
    scene::CloudLayer layer;
    layer.linear_coverage = true;
    auto map = std::make_shared<scene::WeatherMap>();
    map->width = map->height = 1;
    map->rgba = {255, 255, 255, 128};
    for (const double coverage : {0.2, 0.5, 0.8}) {
        layer.coverage = coverage;
        const CloudField field(layer, map, small_noise());
        int cloudy = 0;
        for (std::uint32_t n = 0; n < 20000; ++n) {
            glm::dvec3 p = place(n, layer);
            p.y = layer.bottom_m + 0.15 * (layer.top_m - layer.bottom_m);
            cloudy += field.density_without_detail(p) > 0.0 ? 1 : 0;
        }
        // One height cuts a plane through the noise, and filtering narrows its spread: within a tenth.
        EXPECT_NEAR(cloudy / 20000.0, coverage, 0.1);
    }
}

}  // namespace
}  // namespace bruma::reference
