// Shelf: closed form and independent programs. Point values of S_d, its invariances, and its integral over the plane.
#include <gtest/gtest.h>

#include "base/error.h"
#include "reference/subsurface/dipole.h"
#include "reference/subsurface/subsurface_random_walk.h"
#include "scene/subsurface/energy_table.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

constexpr double root_half = std::numbers::sqrt2 / 2.0;

struct Golden {
    const char* name;
    SubsurfaceChannel channel;
    glm::dvec3 to_light;
    SurfacePoint exit;
    double d, sigma_tr, d_e;
    double s_d;
};
const SubsurfaceChannel u1_medium{0.0041, 2.62, 0.0, 1.5};
const SubsurfaceChannel u5_medium{0.0024, 0.68, 0.0, 1.3};
const glm::dvec3 up(0.0, 0.0, 1.0);

// Light enters at 0 through the normal +z; lengths in mm.
const Golden goldens[] = {
    {"U1", u1_medium, up, {{1, 0, 0}, up}, 0.127027679, 0.179656422, 0.270907706, 1.576677203e-02},
    {"U2", u1_medium, up, {{0, 0, 0}, up}, 0.127027679, 0.179656422, 0.270907706, 1.558556887e+00},
    {"U3",
     u1_medium,
     {-root_half, 0, root_half},
     {{1, 0, 0}, up},
     0.127027679,
     0.179656422,
     0.270907706,
     1.894967818e-02},
    {"U4",
     u1_medium,
     {-root_half, 0, root_half},
     {{-1, 0, 0}, up},
     0.127027679,
     0.179656422,
     0.270907706,
     1.221321296e-02},
    {"U5", u5_medium, up, {{5, 0, 0}, up}, 0.488472059, 0.070094793, 1.04276928, 7.207105567e-04},
    {"U6", u5_medium, up, {{0.5, 0, -3}, -up}, 0.488472059, 0.070094793, 1.04276928, 3.782265542e-03},
    {"U7",
     {0.17, 0.88, 0.0, 1.3},
     {-0.5 * std::numbers::sqrt3, 0, 0.5},
     {{0.7, 0.2, -0.3}, {0.6, 0, 0.8}},
     0.317460317,
     0.731778655,
     0.738968982,
     3.570874535e-02},
    {"U8", {0.0024, 3.4, 0.8, 1.3}, up, {{0.5, 0, -3}, -up}, 0.488472059, 0.070094793, 1.04276928, 3.958085116e-03},
    {"U9", {1.45, 0.03, 0.0, 1.3}, up, {{1, 0, 0}, up}, 0.225225225, 2.53732142, 3.37109281, 1.281518384e-03},
};

double directional(const SubsurfaceChannel& channel, glm::dvec3 to_light, const SurfacePoint& exit,
                   SubsurfaceModel model = SubsurfaceModel::directional_dipole) {
    return Dipole(channel, model).s_d({}, refract_into(to_light, up, channel.eta), exit);
}

TEST(DirectionalDipole, GoldenPointValues) {
    for (const Golden& golden : goldens) {
        const DiffusionConstants k = diffusion_constants(golden.channel);
        EXPECT_NEAR(k.d, golden.d, 1e-8 * golden.d) << golden.name;  // nine printed digits
        EXPECT_NEAR(k.sigma_tr, golden.sigma_tr, 1e-8 * golden.sigma_tr) << golden.name;
        EXPECT_NEAR(k.d_e, golden.d_e, 1e-8 * golden.d_e) << golden.name;
        // Ten digits of a program that agrees with two published implementations to 1.5e-12.
        EXPECT_NEAR(directional(golden.channel, golden.to_light, golden.exit), golden.s_d, 1e-9 * golden.s_d)
            << golden.name;
    }
}

TEST(DirectionalDipole, StraightBelowTheEntryIsTheLimitFromAllSides) {
    // U6b: x parallel to n_i. Five printed digits; the limit itself holds to the distance from which it is approached.
    const double below = directional(u5_medium, up, {{0, 0, -3}, -up});
    EXPECT_NEAR(below, 3.9587e-3, 0.6e-7);
    for (int n = 0; n < 8; ++n) {
        const double phi = n * std::numbers::pi / 4.0;
        const double beside = directional(u5_medium, up, {{1e-4 * std::cos(phi), 1e-4 * std::sin(phi), -3}, -up});
        EXPECT_NEAR(beside, below, 1e-6 * below) << phi;
    }
    // At oblique incidence the azimuths differ, and the middle value is taken.
    const glm::dvec3 oblique(0.5 * std::numbers::sqrt3, 0.0, 0.5);
    EXPECT_NEAR(directional(u5_medium, oblique, {{0, 0, -3}, -up}), 3.459e-3, 0.6e-6);
    double low = 1.0;
    double high = 0.0;
    for (int n = 0; n < 720; ++n) {
        const double phi = n * std::numbers::pi / 360.0;
        const double beside = directional(u5_medium, oblique, {{1e-3 * std::cos(phi), 1e-3 * std::sin(phi), -3}, -up});
        low = std::min(low, beside);
        high = std::max(high, beside);
    }
    EXPECT_NEAR(low, 3.212e-3, 2e-6);
    EXPECT_NEAR(high, 3.705e-3, 2e-6);
}

TEST(DirectionalDipole, RaySourceIsTheExitanceOfItsFluence) {
    // M = C_phi phi - C_E D n . grad phi, by central differences of phi.
    const SubsurfaceChannel channel = u5_medium;
    const DiffusionConstants k = diffusion_constants(channel);
    const DiffuseBoundary b = diffuse_boundary(channel.eta);
    const auto fluence = [&](glm::dvec3 y, glm::dvec3 w) {
        const double r = glm::length(y);
        return std::exp(-k.sigma_tr * r) / (4.0 * std::numbers::pi * k.d * r) *
               (1.0 + 3.0 * k.d * (1.0 + k.sigma_tr * r) / r * glm::dot(y, w) / r);
    };
    const glm::dvec3 n_o = glm::normalize(glm::dvec3(0.2, 0.1, 1.0));
    const glm::dvec3 w = glm::normalize(glm::dvec3(0.3, 0.2, -1.0));
    for (const glm::dvec3 y : {glm::dvec3(1.1, 0.4, -0.7), glm::dvec3(-6.0, 0.1, 2.0), glm::dvec3(0.0, 0.3, 0.1)}) {
        const double h = 1e-5;
        const double slope = (fluence(y + h * n_o, w) - fluence(y - h * n_o, w)) / (2.0 * h);
        const double expected =
            (b.c_phi * fluence(y, w) - b.c_e * k.d * slope) / (4.0 * std::numbers::pi * b.c_phi_inverse);
        // h^2 times third derivatives on one side, rounding over h on the other.
        EXPECT_NEAR(ray_source_radiance(k, b, y, w, n_o, glm::dot(y, y)), expected, 1e-7 * std::abs(expected));
    }
    EXPECT_NEAR(ray_source_radiance(k, b, {1.1, 0.4, -0.7}, w, n_o, 1.86), 8.758112e-3, 5.1e-10);
}

TEST(DirectionalDipole, TangentNormalLiesAcrossTheWayAndOutwards) {
    const glm::dvec3 n_i = glm::normalize(glm::dvec3(0.2, -0.3, 1.0));
    for (const glm::dvec3 x : {glm::dvec3(1, 2, 3), glm::dvec3(-1e-9, 2e-9, 0), glm::dvec3(0, 0, -4e5)}) {
        const glm::dvec3 n = modified_tangent_normal(n_i, -n_i, x);
        EXPECT_NEAR(glm::dot(n, glm::normalize(x)), 0.0, 1e-15);
        EXPECT_NEAR(glm::length(n), 1.0, 1e-15);
        EXPECT_GE(glm::dot(n, n_i), 0.0);
    }
    EXPECT_EQ(modified_tangent_normal(n_i, -n_i, glm::dvec3(0.0)), n_i);
}

TEST(DirectionalDipole, DoesNotDependOnTheUnitOfLength) {
    for (const SubsurfaceModel model : {SubsurfaceModel::standard_dipole, SubsurfaceModel::directional_dipole,
                                        SubsurfaceModel::normalised_directional_dipole}) {
        for (const Golden& golden : goldens) {
            const double value = directional(golden.channel, golden.to_light, golden.exit, model);
            for (const double k : {1e-3, 0.37, 1000.0}) {
                SubsurfaceChannel scaled = golden.channel;
                scaled.sigma_a *= k;
                scaled.sigma_s *= k;
                SurfacePoint exit = golden.exit;
                exit.position /= k;
                EXPECT_NEAR(directional(scaled, golden.to_light, exit, model), k * k * value, 1e-12 * k * k * value)
                    << golden.name << " in units " << k << " times as long";
            }
        }
    }
    const SubsurfaceChannel per_metre{4.1, 2620.0, 0.0, 1.5};
    EXPECT_NEAR(directional(per_metre, up, {{0.001, 0, 0}, up}), 1.576677203e+04, 1e-5);
}

TEST(DirectionalDipole, IsTotalAndNeverNegative) {
    // Coincident, opposed, grazing and far points, without absorption and almost without scattering.
    const glm::dvec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const SubsurfaceChannel& channel :
         {SubsurfaceChannel{0.0, 14.9, 0.0, 1.3}, SubsurfaceChannel{3.0, 1e-6, 0.0, 1.3},
          SubsurfaceChannel{1e-9, 1e3, 0.99, 2.6}, SubsurfaceChannel{1.0, 1.0, -0.9, 1.0}}) {
        const Bssrdf bssrdf(
            {glm::dvec3(channel.sigma_a), glm::dvec3(channel.sigma_s), glm::dvec3(channel.g), channel.eta},
            SubsurfaceModel::directional_dipole);
        for (const glm::dvec3 n_i : axes) {
            for (const glm::dvec3 n_o : axes) {
                for (const glm::dvec3 to_light : {n_i, glm::normalize(n_i + 1e3 * glm::dvec3(n_i.y, n_i.z, n_i.x))}) {
                    for (const glm::dvec3 toward : axes) {
                        for (const double distance : {0.0, 1e-12, 1e-3, 1.0, 1e6}) {
                            const glm::dvec3 inside = refract_into(to_light, n_i, channel.eta);
                            const glm::dvec3 s = bssrdf.s_d({{0, 0, 0}, n_i}, inside, {distance * toward, n_o});
                            EXPECT_TRUE(std::isfinite(s.x) && s.x >= 0.0);
                        }
                    }
                }
            }
        }
    }
}

// Integral of max(0, S_d) over the plane times 4 pi C_phi(1/eta): what of the light that entered leaves again.
double half_space(const Dipole& dipole, double eta, double angle_deg) {
    constexpr int azimuths = 48;
    const DiffusionConstants& k = dipole.diffusion();
    const double total = integrate_plane(k.sigma_tr, 1e-2 * k.d, [&](double rho) {
        double sum = 0.0;
        for (int n = 0; n < azimuths; ++n) {
            sum += flat_s_d(dipole, eta, angle_deg, rho, (n + 0.5) * std::numbers::pi / azimuths);  // half: symmetric
        }
        return sum / azimuths;
    });
    return 4.0 * std::numbers::pi * dipole.boundary().c_phi_inverse * total;
}

TEST(DirectionalDipole, HalfSpaceReflectanceOfEveryMaterial) {
    for (const HalfSpaceTruth& truth : half_space_truths) {
        const Dipole dipole(truth.channel(), SubsurfaceModel::directional_dipole);
        for (std::size_t n = 0; n < half_space_angles_deg.size(); ++n) {
            // Five printed digits of a log-polar sum of 1500 x 96 nodes that ends at a finite radius.
            EXPECT_NEAR(half_space(dipole, truth.eta, half_space_angles_deg[n]), truth.dipole[n], 2e-4) << truth.name;
        }
    }
}

TEST(NormalisedDipole, ReturnsWhatARandomWalkReturns) {
    for (const HalfSpaceTruth& truth : half_space_truths) {
        const Dipole dipole(truth.channel(), SubsurfaceModel::normalised_directional_dipole);
        const double found = half_space(dipole, truth.eta, 0.0);
        // The table of factors and its interpolation are good to 1 %; four standard errors of the walks on top.
        EXPECT_NEAR(found, truth.walk[0], 0.011 * truth.walk[0] + 4.0 * truth.walk_error[0]) << truth.name;
    }
}

// Shelf: random walks. The factors again, from the physics that they stand for.
TEST(LongNormalisedDipole, FactorsAreThoseOfRandomWalks) {
    constexpr int paths = 400'000;
    constexpr double least_paths_of_the_table = 1e5, digits = 0.5e-4, sigmas = 4.0;
    std::uint64_t seed = 7000;
    for (const scene::EnergyRow& row : scene::energy_table) {
        for (const double eta : {1.3, 1.5}) {
            const SubsurfaceChannel channel{1.0 - row.albedo, row.albedo, 0.0, eta};
            const Estimate walk = half_space_reflectance(channel, 1.0, paths, ++seed);
            const double dipole = half_space(Dipole(channel, SubsurfaceModel::directional_dipole), eta, 0.0);
            const double error_of_table = std::sqrt(walk.mean * (1.0 - walk.mean) / least_paths_of_the_table);
            EXPECT_NEAR(eta == 1.3 ? row.at_1_3 : row.at_1_5, walk.mean / dipole,
                        digits + sigmas * std::hypot(walk.standard_error, error_of_table) / dipole)
                << "albedo " << row.albedo << ", index " << eta;
        }
    }
}

TEST(NormalisedDipole, FactorIsContinuousAndKnownAtItsNodes) {
    EXPECT_DOUBLE_EQ(energy_normalisation(0.5, 1.3), 0.2834);
    EXPECT_DOUBLE_EQ(energy_normalisation(0.999, 1.5), 0.8223);
    // Along the logarithm of 1 - albedo above one half, along the albedo below.
    EXPECT_NEAR(energy_normalisation(1.0 - std::sqrt(0.1 * 0.05), 1.3), 0.5 * (0.6137 + 0.6772), 1e-12);
    EXPECT_NEAR(energy_normalisation(0.45, 1.3), 0.5 * (0.2209 + 0.2834), 1e-12);
    EXPECT_DOUBLE_EQ(energy_normalisation(0.9, 1.4), 0.5 * (0.6137 + 0.6361));
    EXPECT_DOUBLE_EQ(energy_normalisation(0.9, 1.1), 0.6137);
    EXPECT_DOUBLE_EQ(energy_normalisation(0.9, 2.0), 0.6361);
    EXPECT_DOUBLE_EQ(energy_normalisation(1.0, 1.3), 0.8009) << "no absorption at all";
    EXPECT_NEAR(energy_normalisation(0.01, 1.3), 0.0054, 1e-12);
    double before = 0.0;
    for (int n = 1; n <= 10000; ++n) {
        const double k = energy_normalisation(n / 10000.0, 1.3);
        EXPECT_GE(k, before);
        EXPECT_LT(k - before, 0.011) << n;
        before = k;
    }
}

TEST(StandardDipole, TotalReflectanceOfEveryMaterial) {
    for (const HalfSpaceTruth& truth : half_space_truths) {
        const DiffusionConstants k = diffusion_constants(truth.channel());
        // Four printed digits.
        EXPECT_NEAR(standard_dipole_reflectance(k.albedo_reduced, standard_dipole_exact_a(truth.eta)),
                    truth.standard_dipole, 5.1e-5)
            << truth.name;
        // pi S_d integrated over the plane is the closed form of the total.
        const Dipole dipole(truth.channel(), SubsurfaceModel::standard_dipole);
        const double total = integrate_plane(k.sigma_tr, 1e-2 * k.d, [&](double rho) {
            return std::numbers::pi * flat_s_d(dipole, truth.eta, 0.0, rho, 0.0);
        });
        const double expected = standard_dipole_reflectance(k.albedo_reduced, standard_dipole_a(truth.eta));
        EXPECT_NEAR(total, expected, 1e-8) << truth.name;
    }
    EXPECT_NEAR(standard_dipole_exact_a(1.3), 2.600079, 1e-4);  // 2 C1 of the table is good to 1e-5
    EXPECT_NEAR(standard_dipole_exact_a(1.5), 3.954736, 2e-4);
    EXPECT_NEAR(standard_dipole_a(1.3), 2.602064, 6e-7);
    EXPECT_NEAR(standard_dipole_a(1.5), 3.959497, 6e-7);
}

TEST(SubsurfaceMedium, UnscatteredLightFollowsDeltaEddington) {
    const SubsurfaceChannel juice{0.0096, 0.3513, 0.548, 1.3};
    EXPECT_NEAR(unscattered_extinction(juice), 0.0096 + 0.3513 * (1.0 - 0.548 * 0.548), 1e-15);
    EXPECT_NEAR(unscattered_transmittance(juice, 7.0), std::exp(-7.0 * unscattered_extinction(juice)), 1e-15);
    // Splitting off the forward peak leaves the reduced scattering alone: (1 - g^2)(1 - g / (1 + g)) = 1 - g.
    EXPECT_NEAR((unscattered_extinction(juice) - juice.sigma_a) * (1.0 - juice.g / (1.0 + juice.g)),
                diffusion_constants(juice).sigma_s_reduced, 1e-15);
}

TEST(SubsurfaceMedium, RefusesWhatIsOutOfRange) {
    for (const SubsurfaceChannel& channel :
         {SubsurfaceChannel{-1.0, 1.0, 0.0, 1.3}, SubsurfaceChannel{0.0, 0.0, 0.0, 1.3},
          SubsurfaceChannel{0.0, 1.0, 1.0, 1.3}, SubsurfaceChannel{0.0, 1.0, 0.0, 0.9},
          SubsurfaceChannel{0.0, std::nan(""), 0.0, 1.3}}) {
        EXPECT_THROW(check(channel), InputError);
        EXPECT_THROW(Dipole(channel, SubsurfaceModel::directional_dipole), InputError);
    }
    EXPECT_NO_THROW(check(potato()));
}

}  // namespace
}  // namespace bruma::reference
