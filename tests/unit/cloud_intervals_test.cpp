// Shelf: closed form. Rays and layers of clouds against long double, and against sampled altitudes.
#include "reference/clouds/cloud_intervals.h"

#include <gtest/gtest.h>

#include "base/integer_hash.h"

namespace bruma::reference {
namespace {

constexpr double planet_m = 6360000.0;

/// Distance to the far or near side of a sphere as textbooks have it.
template <class Real>
Real textbook_root(Real from, Real climb, Real sphere, Real side) {
    const Real r = Real(planet_m) + from, edge = Real(planet_m) + sphere;
    const Real b = Real(2) * r * climb, c = r * r - edge * edge;
    return (-b + side * std::sqrt(b * b - Real(4) * c)) / Real(2);
}

TEST(CloudIntervals, SphereHitsHoldInSinglePrecision) {
    struct Case {
        double from, climb, exact, single;
        bool far;
    };
    const Case cases[] = {{2.0, 0.01, 88392.653, 88392.656, true},
                          {2.0, 0.0, 138046.405, 138046.406, true},
                          {2.0, 0.5, 2994.9425, 2994.9424, true},
                          {1600.0, -0.1, 1000.7793, 1000.7793, false},
                          {1499.0, 0.1, 9.99992, 9.99992, true}};
    for (const Case& c : cases) {
        const auto exact = sphere_hits<long double>(planet_m, c.from, c.climb, 1500.0);
        const auto twice = sphere_hits<double>(planet_m, c.from, c.climb, 1500.0);
        const auto single = sphere_hits<float>(planet_m, float(c.from), float(c.climb), 1500.0F);
        const auto of = [&](const auto& hits) { return double(c.far ? hits.far : hits.near); };
        const double digits = 1e-6 * c.exact;  // as many as are printed
        EXPECT_NEAR(of(exact), c.exact, digits);
        EXPECT_NEAR(of(twice), of(exact), 1e-12 * c.exact) << "double";
        EXPECT_NEAR(of(single), c.single, digits) << "float";
        const double side = c.far ? 1.0 : -1.0;
        const double textbook = textbook_root<float>(float(c.from), float(c.climb), 1500.0F, float(side));
        EXPECT_GT(std::abs(textbook - c.exact), 20.0 * std::abs(of(single) - c.exact))
            << "the textbook form would have done";
        EXPECT_NEAR(double(textbook_root<long double>(c.from, c.climb, 1500.0, side)), of(exact), 1e-9 * c.exact);
    }
}

TEST(CloudIntervals, AltitudeHoldsInSinglePrecision) {
    const double exact = altitude_above<double>(planet_m, {3000.0, 1234.5, 40000.0});
    EXPECT_NEAR(exact, 1360.967905, 5e-7);
    EXPECT_NEAR(exact,
                double(std::sqrt(3000.0L * 3000.0L + (planet_m + 1234.5L) * (planet_m + 1234.5L) + 16e8L) - planet_m),
                1e-8);
    EXPECT_NEAR(altitude_above<float>(float(planet_m), {3000.0F, 1234.5F, 40000.0F}), 1360.967896, 5e-7);
    const glm::vec3 from_centre(3000.0F, float(planet_m) + 1234.5F, 40000.0F);
    EXPECT_NEAR(glm::length(from_centre) - float(planet_m), 1360.5, 0.6) << "steps of half a metre";
}

/// Whether a point on a ray is in the layer and not behind the ground, from its altitude alone.
struct Truth {
    double from, climb, bottom, top;
    double altitude(double t) const {
        return altitude_above<double>(planet_m, {t * std::sqrt(1.0 - climb * climb), from + t * climb, 0.0});
    }
    double hidden_from() const {  // by bisection up to the lowest point of the ray
        double high = -(planet_m + from) * climb;
        if (high <= 0.0 || altitude(high) > 0.0) {
            return 1e300;
        }
        double low = 0.0;
        for (int n = 0; n < 80; ++n) {
            const double middle = 0.5 * (low + high);
            (altitude(middle) > 0.0 ? low : high) = middle;
        }
        return low;
    }
};

TEST(CloudIntervals, ShellAgreesWithSampledAltitudes) {
    int mismatches = 0, twice = 0, inside = 0, points = 0;
    std::uint32_t n = 0;
    const auto random = [&] { return unit_interval(pcg(n++)); };
    for (int ray = 0; ray < 20000; ++ray) {
        const double from = 2.0 * std::pow(15000.0, random());
        // Half of the rays near the horizon, where both parts occur.
        const double climb = ray % 2 == 0 ? 2.0 * random() - 1.0 : 0.2 * (random() - 0.5);
        const Truth truth{from, climb, 1500.0, 4000.0};
        const double hidden = truth.hidden_from();
        const auto parts = shell_intervals(planet_m, from, climb, 1500.0, 4000.0);
        twice += parts.count == 2 ? 1 : 0;
        for (int sample = 0; sample < 40; ++sample) {
            const double t = 2.0 * std::pow(5e5, random());
            const double altitude = truth.altitude(t);
            if (std::abs(altitude - 1500.0) < 1e-3 || std::abs(altitude - 4000.0) < 1e-3 ||
                std::abs(t - hidden) < 1e-3 * t) {
                continue;  // on an edge either answer is right
            }
            const bool expected = altitude > 1500.0 && altitude < 4000.0 && t < hidden;
            bool found = false;
            for (int part = 0; part < parts.count; ++part) {
                const auto& interval = parts.parts[std::size_t(part)];
                found = found || (t > interval.begin && t < interval.end);
            }
            mismatches += found == expected ? 0 : 1;
            inside += expected ? 1 : 0;
            ++points;
        }
    }
    EXPECT_EQ(mismatches, 0) << "of " << points;
    EXPECT_GT(twice, 100) << "rays that meet the layer twice";
    EXPECT_GT(inside, 50000);
}

TEST(CloudIntervals, ShellAtItsEdges) {
    const auto at = [](double from, double climb) { return shell_intervals(planet_m, from, climb, 1500.0, 4000.0); };
    EXPECT_EQ(at(1500.0, -1.0).count, 0) << "on the bottom, down: the gap below is no cloud";
    EXPECT_EQ(at(1500.0, 1.0).count, 1);
    EXPECT_NEAR(at(1500.0, 1.0).parts[0].end, 2500.0, 1e-6);
    EXPECT_EQ(at(10000.0, 0.5).count, 0) << "above, up: both roots are behind";
    EXPECT_EQ(at(10000.0, -1.0).count, 1);
    EXPECT_NEAR(at(10000.0, -1.0).parts[0].begin, 6000.0, 1e-6);
    EXPECT_NEAR(at(10000.0, -1.0).parts[0].end, 8500.0, 1e-6);
    EXPECT_EQ(at(4000.0, -0.03).count, 2) << "grazes the gap below and comes up again";
    EXPECT_EQ(at(2.0, -0.5).count, 0) << "into the ground";
}

TEST(CloudIntervals, BoxFromInsideOutsideAndInAFace) {
    const glm::dvec3 low(-1.0, 2.0, -3.0), high(1.0, 4.0, 3.0);
    const auto at = [&](glm::dvec3 origin, glm::dvec3 direction) {
        return box_intervals(origin, direction, low, high);
    };
    EXPECT_NEAR(at({0, 0, 0}, {0, 1, 0}).parts[0].begin, 2.0, 1e-12);
    EXPECT_NEAR(at({0, 0, 0}, {0, 1, 0}).parts[0].end, 4.0, 1e-12);
    EXPECT_EQ(at({0, 3, 0}, {1, 0, 0}).parts[0].begin, 0.0) << "no sample behind a camera inside";
    EXPECT_NEAR(at({0, 3, 0}, {1, 0, 0}).parts[0].end, 1.0, 1e-12);
    EXPECT_EQ(at({0, 5, 0}, {0, 1, 0}).count, 0);
    EXPECT_EQ(at({2, 3, 0}, {0, 0, 1}).count, 0);
    // In the plane of a face: either answer, but a number.
    const auto face = at({1.0, 3.0, -5.0}, {0.0, 0.0, 1.0});
    EXPECT_TRUE(face.count == 0 || std::abs(face.parts[0].end - 8.0) < 1e-6);
    const auto edge = box_intervals<float>({1.0F, 2.0F, -5.0F}, {0.0F, -0.0F, 1.0F}, glm::vec3(low), glm::vec3(high));
    EXPECT_TRUE(edge.count == 0 || std::isfinite(edge.parts[0].end));
}

}  // namespace
}  // namespace bruma::reference
