// Shelf: check values of the converged integral, and the tables of the reference, which know nothing of the lamp.
#include "scene/sky/sun_lamp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/sky/sky_tables.h"

namespace bruma::scene {
namespace {

constexpr double rad = std::numbers::pi / 180.0;

TEST(SunLamp, ItsLightHasTheCheckValues) {
    const auto expect_at = [](double elevation_deg, const glm::dvec3& expected, double share) {
        const glm::dvec3 found = sun_transmittance(Atmosphere{}, 1500.0, std::sin(elevation_deg * rad));
        for (int channel = 0; channel < 3; ++channel) {
            // Of 256 points; the check values have six digits.
            EXPECT_NEAR(found[channel], share * expected[channel], 2e-5) << elevation_deg;
        }
    };
    expect_at(90.0, {0.951461, 0.887221, 0.800653}, 1.0);
    expect_at(5.0, {0.614063, 0.313026, 0.105051}, 1.0);
    // From 1500 m the horizon is 1.24 degrees down, so all of the disc is seen at 0.
    expect_at(0.0, {0.198497, 0.025797, 0.000365}, 1.0);
}

TEST(SunLamp, ItSetsAsInTheReference) {
    for (const double altitude : {0.0, 100.0, 8000.0, 99e3}) {
        for (double elevation = -12.0; elevation <= 90.0; elevation += elevation < 2.0 ? 0.05 : 4.0) {
            const double climb = std::sin(elevation * rad);
            const double horizon = reference::horizon_climb({}, altitude);
            const glm::dvec3 expected = reference::sun_disc_above_horizon({}, altitude, climb) *
                                        reference::transmittance_to_top({}, altitude, std::max(climb, horizon), 5000);
            const glm::dvec3 found = sun_transmittance({}, altitude, climb);
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(found[channel], expected[channel], 2e-5) << altitude << " m, " << elevation;
            }
        }
    }
}

TEST(SunLamp, ItShinesFromTheSunAndGoesOutBelowTheHorizon) {
    const Light high = sun_lamp(Sun{.elevation_deg = 30.0, .azimuth_deg = 90.0, .irradiance = glm::dvec3(3.0)}, {});
    EXPECT_NEAR(high.direction_world.x, std::cos(30.0 * rad), 1e-12) << "east is +x";
    EXPECT_NEAR(high.direction_world.y, 0.5, 1e-12);
    EXPECT_GT(high.color.r, high.color.b) << "air takes blue first";
    EXPECT_LT(high.color.r, 3.0);
    EXPECT_TRUE(shines(high));
    EXPECT_FALSE(shines(sun_lamp(Sun{.elevation_deg = -1.0}, {})));
}

}  // namespace
}  // namespace bruma::scene
