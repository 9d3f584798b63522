// Shelf: closed form. Fresnel's formulas at single angles, and their moments by an independent quadrature.
#include <gtest/gtest.h>

#include <numbers>

#include "reference/subsurface/fresnel.h"

namespace bruma::reference {
namespace {

glm::dvec3 direction_at(double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    return {std::sin(angle), 0.0, std::cos(angle)};
}

TEST(Fresnel, TransmittanceAtFiveAngles) {
    const double angles_deg[] = {0.0, 30.0, 45.0, 60.0, 80.0};
    const double at_1_3[] = {0.982987, 0.982038, 0.976183, 0.946600, 0.663882};
    const double at_1_5[] = {0.960000, 0.958477, 0.949760, 0.910813, 0.612296};
    for (int n = 0; n < 5; ++n) {
        const double cosine = direction_at(angles_deg[n]).z;
        EXPECT_NEAR(fresnel_transmittance(cosine, 1.3), at_1_3[n], 5.1e-7) << angles_deg[n];  // six printed digits
        EXPECT_NEAR(fresnel_transmittance(cosine, 1.5), at_1_5[n], 5.1e-7) << angles_deg[n];
    }
    EXPECT_NEAR(fresnel_transmittance(1.0, 1.5), 24.0 / 25.0, 1e-15);
    EXPECT_EQ(fresnel_transmittance(0.0, 1.3), 0.0);
    EXPECT_EQ(fresnel_transmittance(-0.5, 1.3), 0.0);
    EXPECT_EQ(fresnel_transmittance(0.3, 1.0), 1.0);
}

TEST(Fresnel, TheReversedPathPassesTheSame) {
    for (const double eta : {1.0, 1.3, 1.5, 2.5}) {
        for (int angle_deg = 0; angle_deg < 90; angle_deg += 3) {
            const glm::dvec3 to_light = direction_at(angle_deg);
            const glm::dvec3 normal(0.0, 0.0, 1.0);
            const glm::dvec3 inside = refract_into(to_light, normal, eta);
            EXPECT_NEAR(glm::length(inside), 1.0, 1e-15);
            EXPECT_NEAR(eta * inside.x, -to_light.x, 1e-14) << "Snell's law at " << angle_deg;
            EXPECT_LT(inside.z, 0.0);
            EXPECT_NEAR(1.0 - fresnel_reflectance(-inside.z, 1.0 / eta), fresnel_transmittance(to_light.z, eta), 1e-12);
            const auto back = refract_out(-inside, normal, eta);
            ASSERT_TRUE(back);
            EXPECT_NEAR(glm::length(*back - to_light), 0.0, 1e-12);
        }
        const double beyond = std::sqrt(1.0 - 1.0 / (eta * eta)) - 1e-9;
        if (eta > 1.0) {
            EXPECT_EQ(fresnel_reflectance(beyond, 1.0 / eta), 1.0);
            EXPECT_FALSE(refract_out({std::sqrt(1.0 - beyond * beyond), 0.0, beyond}, {0.0, 0.0, 1.0}, eta));
        }
    }
}

TEST(Fresnel, MomentsAgreeWithTheirTables) {
    struct Row {
        double index, fit_1, exact_1, fit_2, exact_2;
    };
    // Fits of d'Eon and Irving 2011 and independent quadrature, to six decimals.
    const Row rows[] = {
        {1.05, 0.105000, 0.105565, 0.031239, 0.035510}, {0.95, 0.014470, 0.014525, 0.004538, 0.004446},
        {1.20, 0.335906, 0.336306, 0.194946, 0.198496}, {0.80, 0.052903, 0.052898, 0.028677, 0.028679},
        {1.30, 0.445295, 0.444457, 0.297448, 0.300267}, {1 / 1.3, 0.061116, 0.061132, 0.035378, 0.035350},
        {1.40, 0.529885, 0.528985, 0.386347, 0.388783}, {1 / 1.4, 0.076788, 0.076812, 0.049084, 0.049039},
        {1.50, 0.596541, 0.596346, 0.462609, 0.464431}, {1 / 1.5, 0.091774, 0.091778, 0.063068, 0.063048},
        {2.00, 0.790536, 0.790149, 0.706720, 0.704870}, {0.50, 0.160589, 0.160597, 0.133975, 0.133965},
        {2.50, 0.876878, 0.875499, 0.827561, 0.820640}, {0.40, 0.221913, 0.221867, 0.200752, 0.200848},
        {3.00, 1.153879, 0.919578, 1.092376, 0.882685},
    };
    for (const Row& row : rows) {
        const FresnelMoments fit = fitted_fresnel_moments(row.index);
        const FresnelMoments exact = exact_fresnel_moments(row.index);
        EXPECT_NEAR(fit.twice_c1, row.fit_1, 6e-7) << row.index;
        EXPECT_NEAR(fit.thrice_c2, row.fit_2, 6e-7) << row.index;
        // The tables' own quadrature has 64 midpoints, good to 1e-5.
        EXPECT_NEAR(exact.twice_c1, row.exact_1, 1e-5) << row.index;
        EXPECT_NEAR(exact.thrice_c2, row.exact_2, 1e-5) << row.index;
    }
    // Walsh's closed form of 2 C1 for light outside; 1943, as printed by Ryde and Cooper.
    const double n = 1.5;
    const double n2 = n * n;
    const double root = (n2 - 1.0) / (n2 + 1.0);
    const double walsh =
        0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0)) +
        n2 * root * root / (n2 + 1.0) * std::log((n - 1.0) / (n + 1.0)) -
        2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0)) +
        8.0 * n2 * n2 * (n2 * n2 + 1.0) / ((n2 + 1.0) * (n2 * n2 - 1.0) * (n2 * n2 - 1.0)) * std::log(n);
    EXPECT_NEAR(exact_fresnel_moments(1.0 / n).twice_c1, walsh, 1e-12);
    // Both sides of the boundary are joined by n^2: (1 - 2 C1(n)) n^2 = 1 - 2 C1(1/n).
    for (const double index : {1.01, 1.3, 1.5, 2.5, 3.0}) {
        EXPECT_NEAR((1.0 - exact_fresnel_moments(index).twice_c1) * index * index,
                    1.0 - exact_fresnel_moments(1.0 / index).twice_c1, 1e-11);
    }
}

TEST(Fresnel, BoundaryConstants) {
    const DiffuseBoundary fit = diffuse_boundary(1.3);
    EXPECT_NEAR(fit.c_phi, 0.138676, 6e-7);
    EXPECT_NEAR(fit.c_e, 0.351276, 6e-7);
    EXPECT_NEAR(fit.c_phi_inverse, 0.234721, 6e-7);
    EXPECT_NEAR(fit.a, 2.338986, 6e-7);
    const DiffuseBoundary exact = diffuse_boundary(1.5, MomentSource::exact);
    EXPECT_NEAR(exact.c_phi, 0.100914, 1e-5);
    EXPECT_NEAR(exact.c_e, 0.267785, 1e-5);
    EXPECT_NEAR(exact.c_phi_inverse, 0.227056, 1e-5);
    EXPECT_NEAR(exact.a, 3.627933, 2e-4);
    // A matched boundary reflects nothing, and above 2.5 the fits give way: both must leave A finite and above 1.
    EXPECT_DOUBLE_EQ(diffuse_boundary(1.0).a, 1.0);
    EXPECT_DOUBLE_EQ(diffuse_boundary(1.0).c_phi, 0.25);
    EXPECT_DOUBLE_EQ(diffuse_boundary(3.0).a, diffuse_boundary(3.0, MomentSource::exact).a);
    EXPECT_GT(diffuse_boundary(3.0).a, diffuse_boundary(2.5).a);
}

}  // namespace
}  // namespace bruma::reference
