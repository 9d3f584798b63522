// Shelf: closed forms, and check values of the converged integrals computed apart from this code.
#include "reference/sky/sky_atmosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "reference/clouds/light_of_sky.h"
#include "reference/sky/sky_tables.h"

namespace bruma::reference {
namespace {

constexpr double rad = std::numbers::pi / 180.0;
const scene::Atmosphere earth;

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double tolerance, const std::string& where) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(found[channel], expected[channel], tolerance) << where << ", channel " << channel;
    }
}

TEST(SkyAtmosphere, TransmittanceHasItsCheckValues) {
    const auto at = [](double elevation_deg, int steps) {
        return transmittance_to_top(earth, 1500.0, std::sin(elevation_deg * rad), steps);
    };
    constexpr double six_digits = 5e-7;
    expect_near(at(90.0, 20000), {0.951461, 0.887221, 0.800653}, six_digits, "overhead");
    expect_near(at(5.0, 20000), {0.614063, 0.313026, 0.105051}, six_digits, "5 degrees");
    expect_near(at(0.0, 20000), {0.198497, 0.025797, 0.000365}, six_digits, "level");
    expect_near(at(90.0, 40), {0.951822, 0.887720, 0.801535}, six_digits, "overhead, 40 midpoints");
}

TEST(SkyAtmosphere, TableCoordinatesGoThereAndBack) {
    double apart = 0.0;
    for (int i = 0; i <= 100; ++i) {
        for (int j = 1; j < 100; ++j) {
            const glm::dvec2 to(i / 100.0, j / 100.0);
            const glm::dvec2 back = transmittance_coordinates(earth, transmittance_place(earth, to));
            apart = std::max({apart, std::abs(back.x - to.x), std::abs(back.y - to.y)});
        }
    }
    // Two square roots of the planet's size, in metres: 6e6 eps over the shortest span of some 1e5 m, times some ten.
    EXPECT_LE(apart, 1e-11);
    EXPECT_NEAR(transmittance_place(earth, {0.0, 0.3}).climb, 1.0, 1e-12) << "u = 0 is the zenith";
    const TransmittancePlace horizon = transmittance_place(earth, {1.0, 0.3});
    EXPECT_NEAR(horizon.climb, horizon_climb(earth, horizon.altitude_m), 1e-12) << "u = 1 is the horizon";

    for (const double altitude : {1.0, 1500.0, 20000.0}) {
        for (int i = 0; i <= 20; ++i) {
            for (int j = 0; j <= 40; ++j) {
                const glm::dvec2 to(i / 20.0, j / 40.0);
                const glm::dvec2 back =
                    sky_view_coordinates(earth, altitude, sky_view_place(earth, altitude, to), to.y > 0.5);
                // Square roots at their zeros keep half of the digits.
                EXPECT_NEAR(back.x, to.x, 1e-7);
                EXPECT_NEAR(back.y, to.y, 1e-7);
            }
        }
        EXPECT_NEAR(std::cos(sky_view_place(earth, altitude, {0.0, 0.5}).zenith_angle), horizon_climb(earth, altitude),
                    1e-9)
            << "v = 0.5 is the horizon";
    }
}

TEST(SkyAtmosphere, TheTransmittanceTableHasItsError) {
    const AtmosphereTables tables(earth, {.multiple_scattering = false});
    std::vector<double> errors;
    double largest_high = 0.0, largest = 0.0;
    for (int i = 0; i <= 60; ++i) {
        const double altitude = 1000.0 * i;
        for (int j = 0; j <= 60; ++j) {
            const double lowest = horizon_climb(earth, altitude);
            const double share = j / 60.0;
            const double climb = lowest + (1.0 - lowest) * share * share;  // dense at the horizon
            const glm::dvec3 apart =
                glm::abs(tables.transmittance(altitude, climb) - transmittance_to_top(earth, altitude, climb, 2000));
            for (int channel = 0; channel < 3; ++channel) {
                errors.push_back(apart[channel]);
                largest = std::max(largest, apart[channel]);
                if (climb > std::sin(5.0 * rad)) {
                    largest_high = std::max(largest_high, apart[channel]);
                }
            }
        }
    }
    std::sort(errors.begin(), errors.end());
    // Measured for 40 midpoints: median 1.2e-4, 99 of 100 below 2e-3, at most 3.3e-3 above 5 degrees and 6e-3 at all.
    EXPECT_LE(errors[errors.size() / 2], 2.5e-4);
    EXPECT_LE(errors[errors.size() * 99 / 100], 3e-3);
    EXPECT_LE(largest_high, 3.5e-3);
    EXPECT_LE(largest, 6.5e-3);
    EXPECT_GE(largest, 1e-4) << "too good to have looked at a table";
}

TEST(SkyAtmosphere, TheSunSetsSmoothlyAndIsGoneBelow) {
    const AtmosphereTables tables(earth, {.multiple_scattering = false});
    for (const double altitude : {0.0, 1500.0, 10000.0}) {
        const double horizon = std::asin(horizon_climb(earth, altitude)) / rad;
        const auto red = [&](double over_horizon_deg) {
            return tables.sun_transmittance(altitude, std::sin((horizon + over_horizon_deg) * rad)).r;
        };
        EXPECT_EQ(red(-0.28), 0.0) << "the whole disc has set";
        EXPECT_GT(red(-0.2), 0.0);
        EXPECT_LT(red(0.0), red(0.2));
        EXPECT_NEAR(sun_disc_above_horizon(earth, altitude, std::sin(horizon * rad)), 0.5, 1e-6);
    }
    // From a height the sun is seen under the level, and there it is red.
    const glm::dvec3 low = tables.sun_transmittance(3000.0, std::sin(-1.0 * rad));
    EXPECT_GT(low.r, 3.0 * low.g);
    EXPECT_GT(low.r, 1e-3);
}

TEST(SkyAtmosphere, PhasesIntegrateToOne) {
    for (const auto& phase :
         std::vector<std::function<double(double)>>{rayleigh_phase, [](double mu) { return mie_phase(mu, 0.8); },
                                                    [](double mu) { return mie_phase(mu, 0.0); }}) {
        double sum = 0.0;
        for (int n = 0; n < 100000; ++n) {
            sum += 2.0 * std::numbers::pi * phase(2.0 * (n + 0.5) / 100000.0 - 1.0) * 2.0 / 100000.0;
        }
        EXPECT_NEAR(sum, 1.0, 1e-7);
    }
}

TEST(SkyAtmosphere, LookingAtTheSunOverheadIsAClosedForm) {
    // Every scattering point of the vertical ray lies on the same vertical path from the sun: L = T_total sum of the
    // scattering depths times phases at mu = 1, exactly, and the depths of exponentials are known.
    const AtmosphereTables tables(
        earth, {.transmittance_size = {2, 512}, .transmittance_steps = 2000, .multiple_scattering = false});
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const AirLight light = tables.air_light(0.0, up, up, earth.height_m, 20000);
    const auto depth = [](double per_m, double scale) { return per_m * scale * -std::expm1(-1e5 / scale); };
    for (int channel = 0; channel < 3; ++channel) {
        const double rayleigh = depth(earth.rayleigh_scattering_per_m[channel], 8000.0);
        const double mie = depth(earth.mie_scattering_per_m, 1200.0);
        const double ozone = earth.ozone_absorption_per_m[channel] * 15000.0;
        const double passed = std::exp(-rayleigh - mie - depth(earth.mie_absorption_per_m, 1200.0) - ozone);
        EXPECT_NEAR(light.transmittance[channel], passed, 1e-6);
        const double expected = passed * (rayleigh * rayleigh_phase(1.0) + mie * mie_phase(1.0, 0.8));
        EXPECT_NEAR(light.radiance[channel], expected, 2e-4 * expected) << "bilinear lookups of 512 altitudes";
    }
}

TEST(SkyAtmosphere, MultipleScatteringIsConvergedEnough) {
    // Texels at 0 and 10 km, where the air is, by 64 directions and 20 steps against 4 and 8 times as many.
    const AtmosphereTables coarse(earth, {.multiple_size = {5, 11}});
    const AtmosphereTables fine(
        earth,
        {.transmittance_steps = 400, .multiple_size = {5, 11}, .multiple_directions = 16, .multiple_steps = 160});
    for (int x = 2; x < 5; ++x) {
        for (int y = 0; y < 2; ++y) {
            const glm::dvec3 a = coarse.multiple_table().at(x, y), b = fine.multiple_table().at(x, y);
            for (int channel = 0; channel < 3; ++channel) {
                // Twenty midpoints of long level rays: 22 % where the sun stands on the horizon.
                EXPECT_NEAR(a[channel] / b[channel], 1.0, x == 2 ? 0.25 : 0.1) << x << ' ' << y << ' ' << channel;
                EXPECT_GT(b[channel], 0.0);
            }
        }
    }
    scene::Atmosphere dark = earth;
    dark.ground_albedo = glm::dvec3(0.0);
    const AtmosphereTables without_ground(dark, {.multiple_size = {5, 11}});
    EXPECT_LT(without_ground.multiple_table().at(4, 0).g, coarse.multiple_table().at(4, 0).g) << "the ground shines up";
}

TEST(SkyAtmosphere, IsotropicFurnaceFillsTheTable) {
    // Conservative, thin, grey air over a white ground: what is not scattered in a direction comes back from it, so
    // that L2 / (1 - f) stays below the radiance E mu / pi of the ground, and nears it without air in between.
    scene::Atmosphere thin = earth;
    thin.rayleigh_scattering_per_m = glm::dvec3(1e-12);
    thin.mie_scattering_per_m = thin.mie_absorption_per_m = 0.0;
    thin.ozone_absorption_per_m = glm::dvec3(0.0);
    thin.ground_albedo = glm::dvec3(1.0);
    const AtmosphereTables tables(thin, {.multiple_size = {3, 3}, .multiple_directions = 64});
    // At the ground half of all directions see it, lit from straight above.
    EXPECT_NEAR(tables.multiple_table().at(2, 0).g, 0.5 * std::numbers::inv_pi, 2e-3);
}

TEST(SkyAtmosphere, SkyViewIsTheDirectIntegral) {
    const AtmosphereTables tables(earth);
    for (const double elevation : {60.0, 5.0, -3.0}) {
        const glm::dvec3 to_sun(0.0, std::sin(elevation * rad), -std::cos(elevation * rad));
        const SkyView view(tables, 2.0, to_sun);
        double square = 0.0, scale = 0.0;
        for (int n = 0; n < 200; ++n) {
            const double zenith = (90.0 - 85.0 * std::pow((n % 20 + 0.5) / 20.0, 2.0)) * rad;
            const double azimuth = 2.0 * std::numbers::pi * (n / 20 + 0.37) / 10.0;
            const glm::dvec3 d(std::sin(zenith) * std::sin(azimuth), std::cos(zenith),
                               -std::sin(zenith) * std::cos(azimuth));
            if (glm::dot(d, to_sun) > std::cos(5.0 * rad)) {
                continue;  // the aureole is finer than the table: a known limit, drawn apart
            }
            const glm::dvec3 direct = tables.air_light(2.0, d, to_sun, distance_to_top(earth, 2.0, d.y), 500).radiance;
            const glm::dvec3 apart = view.radiance(d) - direct;
            square += glm::dot(apart, apart);
            scale += glm::dot(direct, direct);
        }
        EXPECT_LE(std::sqrt(square / scale), 0.02) << "30 steps and 192 x 108 texels, sun at " << elevation;
        EXPECT_GT(scale, 0.0);
    }
}

TEST(SkyAtmosphere, DayFallsThroughTwilightIntoNight) {
    const AtmosphereTables tables(earth);
    glm::dvec3 before(1e9);
    for (const double elevation : {60.0, 10.0, 0.0, -6.0, -12.0}) {
        const glm::dvec3 to_sun(0.0, std::sin(elevation * rad), -std::cos(elevation * rad));
        const SkyView view(tables, 2.0, to_sun);
        const glm::dvec3 level = view.planar_irradiance();
        EXPECT_LT(level.g, before.g) << elevation;
        EXPECT_TRUE(level.r >= 0.0 && std::isfinite(level.b));
        // Twice the cosine is 1 on average over the hemisphere: both irradiances are of one size.
        EXPECT_GT(view.scalar_irradiance().g, level.g);
        before = level;
    }
    EXPECT_LT(before.g, 1e-4);
}

TEST(SkyAtmosphere, LightOnCloudsIsThatOfTheTables) {
    const auto tables = std::make_shared<const AtmosphereTables>(earth);
    scene::Sun sun;
    sun.irradiance = {2.0, 1.0, 0.5};
    sun.elevation_deg = 90.0;
    const CloudLight noon = light_of_sky(tables, sun, 2.0);
    // Converged, at 1500 m, and 2e-3 of the table.
    expect_near(noon.sun_irradiance(1500.0), glm::dvec3(0.951461, 0.887221, 0.800653) * sun.irradiance, 6e-3, "noon");
    const glm::dvec3 sky = noon.sky_radiance(glm::normalize(glm::dvec3(0.5, 0.5, 0.0)));
    EXPECT_GT(sky.b / sun.irradiance.b, sky.r / sun.irradiance.r) << "the sky is blue";
    sun.elevation_deg = -1.0;
    const CloudLight dusk = light_of_sky(tables, sun, 2.0);
    EXPECT_EQ(dusk.sun_irradiance(0.0), glm::dvec3(0.0)) << "the sun has set on the ground";
    const glm::dvec3 tops = dusk.sun_irradiance(12000.0) / sun.irradiance;
    EXPECT_GT(tops.r, 0.05) << "and still shines on high tops";
    EXPECT_GT(tops.r, 1.5 * tops.b) << "red";
}

TEST(SkyAtmosphere, TheDiscKeepsItsIrradiance) {
    for (const bool darkened : {false, true}) {
        const double radius = 0.004675;
        glm::dvec3 sum(0.0);
        constexpr int rings = 20000;
        for (int n = 0; n < rings; ++n) {
            const double angle = radius * (n + 0.5) / rings;
            sum += sun_disc_radiance(angle, radius, darkened) *
                   (2.0 * std::numbers::pi * std::sin(angle) * radius / rings);
        }
        expect_near(sum, glm::dvec3(1.0), 1e-4, "midpoints of a root at the rim");
    }
    EXPECT_NEAR(1.0 / sun_disc_radiance(0.0, 0.004675, false).r, 6.866e-5, 5e-9);
    const glm::dvec3 rim = sun_disc_radiance(0.0045, 0.004675, true);
    EXPECT_GT(rim.r, rim.b);
    EXPECT_EQ(sun_disc_radiance(0.0047, 0.004675, true).r, 0.0);
}

}  // namespace
}  // namespace bruma::reference
