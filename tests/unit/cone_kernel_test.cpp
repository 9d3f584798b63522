// Weights of the cone of light that Ropinski et al. 2010 gather. Shelf: closed form and quadrature of the phase
// function.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "render/light/cone_kernel.h"

namespace bruma::render {
namespace {

constexpr double right_angle = 1.5707963267948966;

double sum_of(const std::array<double, 9>& weights) {
    return std::accumulate(weights.begin(), weights.end(), 0.0);
}

TEST(ConeKernel, SumsToOneForAnyPhaseFunctionConeAndCell) {
    // Raw weights of point samples would sum to 0.25 for g = 0 and to 15 for g = 0.9, and light would explode.
    for (const double g : {-0.99, -0.5, 0.0, 0.3, 0.8, 0.9, 0.99}) {
        for (const double cone_deg : {1.0, 5.0, 30.0, 60.0, 90.0}) {
            for (const glm::dvec3 cell : {glm::dvec3(1.0), glm::dvec3(1.0, 2.0, 0.5), glm::dvec3(1e-6, 1e-6, 4e-6)}) {
                for (const glm::dvec2 shift : {glm::dvec2(0.0), glm::dvec2(0.4, -0.3), glm::dvec2(3.0, 1.0)}) {
                    const auto weights = cone_kernel(g, cone_deg / 90.0 * right_angle, cell, shift);
                    EXPECT_NEAR(sum_of(weights), 1.0, 1e-12) << g << ' ' << cone_deg;
                    for (const double weight : weights) {
                        EXPECT_GE(weight, 0.0);
                    }
                }
            }
        }
    }
}

TEST(ConeKernel, SpreadsAsThePhaseFunctionDoes) {
    // Variance in cells^2 along one direction of 3 x 3 cells at distance 1, against 400 x 400 points in each. The peak
    // for g = 0.9 is a few tenths of a cell wide: 15 x 15 points are within 1 % of it.
    for (const double g : {0.0, 0.5, 0.8, 0.9}) {
        double edge = 0.0, corner = 0.0, centre = 0.0;
        constexpr int fine = 400;
        for (int j = 0; j < 3 * fine; ++j) {
            for (int i = 0; i < 3 * fine; ++i) {
                const glm::dvec3 way((i + 0.5) / fine - 1.5, (j + 0.5) / fine - 1.5, 1.0);
                const double distance = glm::length(way);
                const double weight =
                    (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g / distance, 1.5) / (distance * distance * distance);
                const int off_centre = (i / fine != 1) + (j / fine != 1);
                (off_centre == 0 ? centre : off_centre == 1 ? edge : corner) += weight;
            }
        }
        const double exact = (0.5 * edge + corner) / (centre + edge + corner);
        const auto weights = cone_kernel(g, right_angle, glm::dvec3(1.0), glm::dvec2(0.0));
        const double variance = weights[0] + weights[2] + weights[3] + weights[5] + weights[6] + weights[8];
        EXPECT_NEAR(variance / exact, 1.0, 0.01) << g;
        // Forward light hardly spreads: 0.146 and 0.068 cells^2 for g of 0.8 and 0.9.
        if (g >= 0.8) {
            EXPECT_NEAR(variance, g > 0.85 ? 0.068 : 0.146, 2e-3);
        }
        // Even: the same to each side.
        EXPECT_NEAR(weights[0], weights[8], 1e-14);
        EXPECT_NEAR(weights[1], weights[7], 1e-14);
        EXPECT_NEAR(weights[3], weights[5], 1e-14);
    }
}

TEST(ConeKernel, ANarrowConeIsASingleFetch) {
    const auto weights = cone_kernel(0.0, 1e-3, glm::dvec3(1.0), glm::dvec2(0.25, 0.0));
    EXPECT_DOUBLE_EQ(weights[4], 1.0);
}

}  // namespace
}  // namespace bruma::render
