// Shelf: closed form. Random numbers by their published values, the phase function by its integrals.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/phase_function.h"
#include "reference/random.h"

namespace bruma::reference {
namespace {

using Words = std::array<std::uint32_t, 4>;

TEST(ReferenceRandom, PhiloxGivesItsPublishedValues) {
    // Known-answer vectors of Random123, by the authors of the paper.
    EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}), (Words{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
    EXPECT_EQ(philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
              (Words{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
    EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
              (Words{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(ReferenceRandom, StreamsAreUniformAndIndependent) {
    // Means of 1e5 numbers: 5 standard errors of 1/2 (sqrt(1/12)), and of products of neighbours (sqrt(7)/12).
    const int count = 100'000;
    const double room = 5.0 / std::sqrt(double(count));
    const auto correlation = [&](auto a, auto b) {
        double sum = 0.0;
        for (int n = 0; n < count; ++n) {
            sum += a(std::uint32_t(n)) * b(std::uint32_t(n));
        }
        return sum / count;
    };
    const auto first_of = [](std::uint64_t seed, std::uint32_t pixel, std::uint64_t sample) {
        return RandomStream(seed, pixel, sample).uniform();
    };
    EXPECT_NEAR(correlation([&](auto n) { return first_of(0, n, 0); }, [](auto) { return 1.0; }), 0.5, 0.29 * room);
    const double independent = 0.25;
    const double spread = std::sqrt(7.0) / 12.0 * room;
    EXPECT_NEAR(correlation([&](auto n) { return first_of(0, n, 0); }, [&](auto n) { return first_of(0, n, 1); }),
                independent, spread);
    EXPECT_NEAR(correlation([&](auto n) { return first_of(0, n, 0); }, [&](auto n) { return first_of(0, n + 1, 0); }),
                independent, spread);
    EXPECT_NEAR(correlation([&](auto n) { return first_of(0, n, 0); }, [&](auto n) { return first_of(1, n, 0); }),
                independent, spread);
    RandomStream stream(7, 3, 9);
    double before = stream.uniform();
    double sum = 0.0;
    for (int n = 0; n < count; ++n) {
        const double next = stream.uniform();
        EXPECT_TRUE(next >= 0.0 && next < 1.0);
        sum += before * next;
        before = next;
    }
    EXPECT_NEAR(sum / count, independent, spread);
}

constexpr double asymmetries[] = {-0.99, -0.8, -0.3, 0.0, 1e-7, 1e-5, 0.5, 0.8, 0.9, 0.99};

/// Integral of p f(cosine) over the sphere, by the midpoint rule in the angle; its step resolves the peak at 0.99.
template <class Function>
double over_sphere(double g, Function f) {
    const int steps = 200'000;
    double sum = 0.0;
    for (int n = 0; n < steps; ++n) {
        const double angle = std::numbers::pi * (n + 0.5) / steps;
        sum += std::sin(angle) * henyey_greenstein(std::cos(angle), g) * f(std::cos(angle));
    }
    return sum * 2.0 * std::numbers::pi * std::numbers::pi / steps;
}

TEST(ReferencePhaseFunction, IntegralIsOneAndMeanCosineIsG) {
    for (const double g : asymmetries) {
        EXPECT_NEAR(over_sphere(g, [](double) { return 1.0; }), 1.0, 1e-6) << g;
        EXPECT_NEAR(over_sphere(g, [](double cosine) { return cosine; }), g, 1e-6) << g;
    }
}

TEST(ReferencePhaseFunction, SharesInCones) {
    // Closed form against the integral of p, and against the printed table, which has three digits.
    const double degrees[] = {15.0, 30.0, 45.0, 60.0};
    const double table[][5] = {{0.0, .017, .067, .146, .250},
                               {0.5, .093, .290, .482, .634},
                               {0.8, .393, .679, .810, .880},
                               {0.9, .660, .845, .912, .945}};
    for (const auto& row : table) {
        for (int n = 0; n < 4; ++n) {
            const double edge = std::cos(degrees[n] * std::numbers::pi / 180.0);
            EXPECT_NEAR(share_in_cone(row[0], edge), row[n + 1], 5.1e-4);
            EXPECT_NEAR(over_sphere(row[0], [&](double cosine) { return cosine >= edge ? 1.0 : 0.0; }),
                        share_in_cone(row[0], edge), 1e-4);
        }
    }
    for (const double g : asymmetries) {
        EXPECT_NEAR(share_in_cone(g, -1.0), 1.0, 1e-9) << g;
        EXPECT_NEAR(share_in_cone(g, 1.0), 0.0, 1e-9) << g;
    }
}

TEST(ReferencePhaseFunction, SamplingInvertsTheDistribution) {
    for (const double g : asymmetries) {
        for (int n = 0; n <= 1000; ++n) {
            const double u = n / 1000.0;
            const double cosine = sample_cosine(g, u);
            ASSERT_TRUE(cosine >= -1.0 && cosine <= 1.0) << g << ' ' << u;
            // The rounding of the cosine grows by the density, up to 1e4 in the peak.
            EXPECT_NEAR(1.0 - share_in_cone(g, cosine), u, 1e-6) << g << ' ' << u;
        }
    }
}

TEST(ReferencePhaseFunction, SampledWaysFollowIt) {
    // Chi-square over 20 cones of equal share and 8 sectors: 159 degrees of freedom, 99.99 % below 231.
    const int count = 160'000;
    for (const glm::dvec3 way : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.48, -0.6, 0.64),
                                 glm::dvec3(-1.0, 0.0, 0.0)}) {
        for (const double g : {-0.5, 0.0, 0.9}) {
            const glm::dvec3 side = glm::normalize(glm::cross(way, glm::dvec3(0.3, 0.9, 0.1)));
            const glm::dvec3 up = glm::cross(way, side);
            std::array<int, 160> bins{};
            RandomStream random(11, 0, 0);
            for (int n = 0; n < count; ++n) {
                const double u = random.uniform();
                const glm::dvec3 next = sample_henyey_greenstein(way, g, u, random.uniform());
                EXPECT_NEAR(glm::length(next), 1.0, 1e-12);
                const double share = share_in_cone(g, glm::dot(next, way));
                const double turn = std::atan2(glm::dot(next, side), glm::dot(next, up)) / (2.0 * std::numbers::pi);
                const int cone = std::clamp(int(share * 20.0), 0, 19);
                const int sector = std::clamp(int((turn + 0.5) * 8.0), 0, 7);
                ++bins[std::size_t(8 * cone + sector)];
            }
            double chi_square = 0.0;
            for (const int bin : bins) {
                chi_square += (bin - 1000.0) * (bin - 1000.0) / 1000.0;
            }
            EXPECT_LT(chi_square, 231.0) << g;
        }
    }
}

}  // namespace
}  // namespace bruma::reference
