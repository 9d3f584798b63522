// Shelf: check values computed apart from this code, and published ones for the place of the sun.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "reference/sky/sky_look.h"
#include "reference/sky/sky_preetham.h"
#include "scene/sky/sky.h"

namespace bruma::reference {
namespace {

constexpr double rad = std::numbers::pi / 180.0;

TEST(SkyComparison, PreethamHasItsCheckValues) {
    constexpr double six_digits = 5e-7;
    const glm::dvec3 zenith = preetham_zenith_Yxy(2.0, 60.0 * rad);
    EXPECT_NEAR(zenith.x, 3.487327, six_digits);
    EXPECT_NEAR(zenith.y, 0.238013, six_digits);
    EXPECT_NEAR(zenith.z, 0.241988, six_digits);
    const glm::dvec3 near_sun = preetham_Yxy(2.0, 45.0 * rad, 60.0 * rad, 15.0 * rad);
    EXPECT_NEAR(near_sun.x, 14.575902, six_digits);
    EXPECT_NEAR(near_sun.y, 0.268477, six_digits);
    EXPECT_NEAR(near_sun.z, 0.274622, six_digits);
    const glm::dvec3 away = preetham_Yxy(2.0, 45.0 * rad, 60.0 * rad, 105.0 * rad);
    EXPECT_NEAR(away.x, 3.885409, six_digits);
    EXPECT_NEAR(away.y, 0.231945, six_digits);
    EXPECT_NEAR(away.z, 0.240741, six_digits);
    EXPECT_NEAR(preetham_zenith_Yxy(1.0, 0.0).x, -2.35, 5e-3) << "why turbidity begins at 2";
    EXPECT_NEAR(preetham_zenith_Yxy(1.2, 0.0).x, 1.60, 5e-3);
    EXPECT_TRUE(std::isfinite(preetham_Yxy(2.0, 90.0 * rad, 90.0 * rad, 0.0).x)) << "at the horizon";
}

TEST(SkyComparison, ColoursOfAKnownWhite) {
    const glm::dvec3 white = rec709_from_Yxy({1.0, 0.3127, 0.3290});
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(white[channel], 1.0, 1e-3) << "D65";
    }
}

TEST(SkyComparison, TheLookHasItsCoefficients) {
    const glm::dvec3 air = rayleigh_coefficient({680e-9, 550e-9, 450e-9});
    EXPECT_NEAR(air.r, 5.804542996e-6, 5e-16);
    EXPECT_NEAR(air.g, 1.356291142e-5, 5e-15);
    EXPECT_NEAR(air.b, 3.026590247e-5, 5e-15);
    EXPECT_NEAR(look_air_mass(0.0), 1.0, 1e-3);
    EXPECT_NEAR(look_air_mass(60.0), 2.0, 0.01);
}

TEST(SkyComparison, TheLookHasADiscOfTwiceTheSun) {
    const scene::Sky sky;
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
    const auto at = [&](double off_deg) {
        const double angle = (45.0 + off_deg) * rad;
        return look_radiance(sky, {0.0, std::sin(angle), -std::cos(angle)}, to_sun);
    };
    EXPECT_GT(at(0.38).g, 0.999 * at(0.0).g) << "full within 0.391 degrees";
    EXPECT_LT(at(0.45).g, 0.95 * at(0.38).g);
    EXPECT_LT(at(0.54).g, 0.2 * at(0.0).g) << "nothing of the disc beyond 0.5333 degrees";
    EXPECT_GT(at(30.0).b, at(30.0).r) << "blue";
    for (const double sun_deg : {-30.0, 0.0, 90.0}) {
        for (const double view_deg : {-90.0, 0.0, 45.0, 90.0}) {
            const glm::dvec3 l = look_radiance(sky, {0.0, std::sin(view_deg * rad), std::cos(view_deg * rad)},
                                               {0.0, std::sin(sun_deg * rad), std::cos(sun_deg * rad)});
            EXPECT_TRUE(std::isfinite(l.r) && std::isfinite(l.g) && std::isfinite(l.b));
        }
    }
}

TEST(SkyComparison, TheSunStandsWhereAlmanacsSay) {
    // Reda and Andreas 2004 (NREL/TP-560-34302), appendix: 17 October 2003, 12:30:30 at UTC-7, 39.742476 N,
    // 105.1786 W: azimuth 194.34024, zenith angle 50.11162 with 0.014 of refraction, some 0.002 of parallax.
    const scene::SunAngles example = scene::sun_angles(39.742476, -105.1786, {2003, 10, 17}, 19.0 + 30.5 / 60.0);
    EXPECT_NEAR(example.azimuth_deg, 194.34024, 0.02);
    EXPECT_NEAR(example.elevation_deg, 90.0 - 50.11162 - 0.014, 0.015);
    // Noon at Greenwich on the solstices: 90 - latitude +- 23.44; at the poles the elevation is the declination.
    EXPECT_NEAR(scene::sun_angles(51.4778, 0.0, {2026, 6, 21}, 12.03).elevation_deg, 90.0 - 51.4778 + 23.436, 0.02);
    EXPECT_NEAR(scene::sun_angles(90.0, 0.0, {2026, 12, 21}, 15.0).elevation_deg, -23.436, 0.02);
    EXPECT_NEAR(scene::sun_angles(0.0, 0.0, {2026, 3, 20}, 6.1).azimuth_deg, 90.0, 0.3) << "rises in the east";
}

TEST(SkyComparison, SunDirectionFollowsTheCompass) {
    scene::Sun sun;
    sun.elevation_deg = 0.0;
    sun.azimuth_deg = 90.0;
    EXPECT_NEAR(scene::to_sun_world(sun).x, 1.0, 1e-15) << "east is +x";
    sun.azimuth_deg = 0.0;
    EXPECT_NEAR(scene::to_sun_world(sun).z, -1.0, 1e-15) << "north is -z";
    sun.elevation_deg = 30.0;
    EXPECT_NEAR(scene::to_sun_world(sun).y, 0.5, 1e-15);
    sun.placement = scene::SunPlacement::place_and_time;
    EXPECT_NO_THROW(scene::check(sun, "sun"));
    sun.date = {2026, 2, 29};
    EXPECT_THROW(scene::check(sun, "sun"), InputError);
    sun.date = {2028, 2, 29};
    EXPECT_NO_THROW(scene::check(sun, "sun"));
}

}  // namespace
}  // namespace bruma::reference
