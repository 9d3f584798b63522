// Shelf: closed form (Chandrasekhar's H function, light that is not scattered) and an independent program of random
// walks.
#include <gtest/gtest.h>

#include <cstdio>

#include "reference/subsurface/subsurface_random_walk.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;

/// Chandrasekhar's H function for isotropic scattering, by iteration of its integral equation in the form that
/// converges without doubt: 1/H = sqrt(1 - a) + a/2 integral of mu' H(mu') / (mu + mu').
double chandrasekhar_h(double albedo, double mu) {
    static const GaussLegendre rule(64);
    const auto integral = [&](double at, const std::vector<double>& h) {
        double sum = 0.0;
        for (std::size_t n = 0; n < h.size(); ++n) {
            sum += rule.weight[n] * rule.node[n] * h[n] / (at + rule.node[n]);
        }
        return 1.0 / (std::sqrt(1.0 - albedo) + 0.5 * albedo * sum);
    };
    std::vector<double> h(rule.node.size(), 1.0);
    for (int turn = 0; turn < 200; ++turn) {
        std::vector<double> next(h.size());
        for (std::size_t n = 0; n < h.size(); ++n) {
            next[n] = integral(rule.node[n], h);
        }
        h = next;
    }
    return integral(mu, h);
}

SubsurfaceChannel of_albedo(double albedo, double eta, double g = 0.0) {
    // sigma_t' = 1
    return {1.0 - albedo, albedo / (1.0 - g), g, eta};
}

// Independent samples: four standard errors are exceeded once in 16 000 checks, and seeds are fixed.
constexpr double sigmas = 4.0;

TEST(SubsurfaceRandomWalk, MatchedHalfSpaceIsChandrasekhars) {
    EXPECT_NEAR(1.0 - chandrasekhar_h(0.9, 1.0) * std::sqrt(0.1), 0.41495, 1e-5) << "the closed form itself";
    for (const double albedo : {0.5, 0.9, 0.99}) {
        for (const double mu : {1.0, 0.5}) {
            const double expected = 1.0 - chandrasekhar_h(albedo, mu) * std::sqrt(1.0 - albedo);
            const Estimate found = half_space_reflectance(of_albedo(albedo, 1.0), mu, 40'000);
            EXPECT_NEAR(found.mean, expected, sigmas * found.standard_error) << albedo << ", " << mu;
            EXPECT_LT(found.standard_error, 0.0025);
        }
    }
}

TEST(SubsurfaceRandomWalk, SlabOfGlassIndexIsGiovanellis) {
    // Giovanelli 1955: 0.2600 with the specular 0.04, albedo 0.9, index 1.5; four digits.
    const Estimate found = half_space_reflectance(of_albedo(0.9, 1.5), 1.0, 100'000);
    EXPECT_NEAR(0.04 + 0.96 * found.mean, 0.2600, sigmas * found.standard_error + 5e-5);
}

TEST(SubsurfaceRandomWalk, HalfSpaceReflectanceOfEveryMaterial) {
    std::uint64_t seed = 100;
    for (const HalfSpaceTruth& truth : half_space_truths) {
        const Estimate found = half_space_reflectance(truth.channel(), 1.0, 4'000, ++seed);
        EXPECT_NEAR(found.mean, truth.walk[0], sigmas * std::hypot(found.standard_error, truth.walk_error[0]))
            << truth.name;
    }
}

TEST(LongSubsurfaceRandomWalk, HalfSpaceReflectanceOfEveryMaterialAtThreeAngles) {
    std::uint64_t seed = 1000;
    for (const HalfSpaceTruth& truth : half_space_truths) {
        std::printf("    %-12s", truth.name);
        for (std::size_t n = 0; n < half_space_angles_deg.size(); ++n) {
            const double cosine = std::cos(half_space_angles_deg[n] * pi / 180.0);
            const Estimate found = half_space_reflectance(truth.channel(), cosine, 200'000, ++seed);
            const double error = std::hypot(found.standard_error, truth.walk_error[n]);
            EXPECT_NEAR(found.mean, truth.walk[n], sigmas * error) << truth.name << " at " << half_space_angles_deg[n];
            std::printf("  %.5f +- %.5f (%+.1f)", found.mean, found.standard_error,
                        (found.mean - truth.walk[n]) / error);
        }
        std::printf("\n");
    }
}

TEST(LongSubsurfaceRandomWalk, GridOfAlbedosIndicesAndAngles) {
    struct Row {
        double albedo, eta, angle_deg, walk, walk_error, dipole;
    };
    const Row rows[] = {
        {0.5000, 1.3, 0, 0.06359, 0.00026, 0.22439},  {0.5000, 1.3, 60, 0.07296, 0.00028, 0.27562},
        {0.8000, 1.3, 0, 0.18185, 0.00048, 0.35648},  {0.8000, 1.3, 60, 0.20117, 0.00050, 0.40473},
        {0.9000, 1.3, 0, 0.29160, 0.00059, 0.47517},  {0.9000, 1.3, 30, 0.29803, 0.00059, 0.48764},
        {0.9000, 1.3, 60, 0.31706, 0.00060, 0.51822}, {0.9000, 1.3, 80, 0.32876, 0.00060, 0.53539},
        {0.9500, 1.3, 0, 0.40774, 0.00063, 0.60211},  {0.9500, 1.3, 60, 0.43622, 0.00063, 0.63784},
        {0.9800, 1.3, 0, 0.55665, 0.00063, 0.76427},  {0.9800, 1.3, 60, 0.58443, 0.00063, 0.78886},
        {0.9900, 1.3, 0, 0.65770, 0.00060, 0.87173},  {0.9900, 1.3, 30, 0.66343, 0.00060, 0.87641},
        {0.9900, 1.3, 60, 0.68027, 0.00059, 0.88817}, {0.9900, 1.3, 80, 0.69023, 0.00058, 0.89495},
        {0.9950, 1.3, 0, 0.74035, 0.00055, 0.96146},  {0.9950, 1.3, 60, 0.75974, 0.00054, 0.97073},
        {0.9990, 1.3, 0, 0.87183, 0.00069, 1.10317},  {0.9990, 1.3, 60, 0.88306, 0.00066, 1.10055},
        {0.9999, 1.3, 0, 0.95662, 0.00042, 1.19446},  {0.9999, 1.3, 60, 0.96100, 0.00040, 1.18387},
        {0.5000, 1.5, 0, 0.04611, 0.00023, 0.16882},  {0.5000, 1.5, 60, 0.05064, 0.00024, 0.19583},
        {0.8000, 1.5, 0, 0.13744, 0.00044, 0.26736},  {0.8000, 1.5, 60, 0.14810, 0.00045, 0.29336},
        {0.9000, 1.5, 0, 0.22939, 0.00055, 0.36062},  {0.9000, 1.5, 30, 0.23305, 0.00055, 0.36797},
        {0.9000, 1.5, 60, 0.24221, 0.00056, 0.38491}, {0.9000, 1.5, 80, 0.24944, 0.00057, 0.39363},
        {0.9500, 1.5, 0, 0.33440, 0.00062, 0.46991},  {0.9500, 1.5, 60, 0.35095, 0.00062, 0.49150},
        {0.9800, 1.5, 0, 0.47998, 0.00065, 0.62643},  {0.9800, 1.5, 60, 0.49810, 0.00065, 0.64310},
        {0.9900, 1.5, 0, 0.58538, 0.00064, 0.74092},  {0.9900, 1.5, 30, 0.58996, 0.00063, 0.74469},
        {0.9900, 1.5, 60, 0.60088, 0.00063, 0.75338}, {0.9900, 1.5, 80, 0.60646, 0.00063, 0.75785},
        {0.9950, 1.5, 0, 0.67803, 0.00060, 0.84303},  {0.9950, 1.5, 60, 0.69094, 0.00059, 0.85138},
        {0.9990, 1.5, 0, 0.83549, 0.00077, 1.01604},  {0.9990, 1.5, 60, 0.84279, 0.00075, 1.01685},
        {0.9999, 1.5, 0, 0.94334, 0.00048, 1.13490},  {0.9999, 1.5, 60, 0.94627, 0.00046, 1.13018},
    };
    std::uint64_t seed = 5000;
    for (const Row& row : rows) {
        const Estimate found = half_space_reflectance(of_albedo(row.albedo, row.eta),
                                                      std::cos(row.angle_deg * pi / 180.0), 200'000, ++seed);
        EXPECT_NEAR(found.mean, row.walk, sigmas * std::hypot(found.standard_error, row.walk_error))
            << row.albedo << ", " << row.eta << ", " << row.angle_deg;
    }
}

TEST(SubsurfaceRandomWalk, SimilarityHoldsForForwardScattering) {
    // eta 1.3, normal light, the same sigma_s' with g = 0.9: values +- 0.0005 of another program.
    struct Row {
        double albedo, g, expected;
    };
    for (const Row& row : {Row{0.90, 0.5, 0.27864}, Row{0.90, 0.9, 0.27605}, Row{0.99, 0.8, 0.65536}}) {
        const Estimate found = half_space_reflectance(of_albedo(row.albedo, 1.3, row.g), 1.0, 10'000);
        EXPECT_NEAR(found.mean, row.expected, sigmas * std::hypot(found.standard_error, 0.0005)) << row.g;
    }
}

TEST(SubsurfaceRandomWalk, SphereExitance) {
    for (const SphereTruth& truth : sphere_truths) {
        const auto found = sphere_exitance(truth.channel, truth.radius, 10, 20'000, 3);
        for (std::size_t bin = 0; bin < 10; ++bin) {
            EXPECT_NEAR(found[bin].mean, truth.walk[bin],
                        sigmas * std::hypot(found[bin].standard_error, truth.walk_error[bin]))
                << truth.name << ", bin " << bin;
        }
    }
}

TEST(LongSubsurfaceRandomWalk, SphereExitance) {
    for (const SphereTruth& truth : sphere_truths) {
        const auto found = sphere_exitance(truth.channel, truth.radius, 10, 1'000'000, 3);
        for (std::size_t bin = 0; bin < 10; ++bin) {
            const double error = std::hypot(found[bin].standard_error, truth.walk_error[bin]);
            EXPECT_NEAR(found[bin].mean, truth.walk[bin], sigmas * error) << truth.name << ", bin " << bin;
            std::printf("    %-10s bin %zu: %.5f +- %.5f (%+.1f)\n", truth.name, bin, found[bin].mean,
                        found[bin].standard_error, (found[bin].mean - truth.walk[bin]) / error);
        }
    }
}

TEST(SubsurfaceRandomWalk, LightThatIsNotScatteredFollowsItsRefractedRay) {
    // Almost no scattering: what reaches the back cap of the sphere is T^2 e^(-sigma_t chord) along one refracted ray,
    // less the little that was reflected inside and comes back.
    const double radius = 5.0;
    const SubsurfaceChannel channel{0.241, 1e-9, 0.0, 1.3};
    static const GaussLegendre rule(64);
    std::vector<double> expected(10, 0.0);
    for (int panel = 0; panel < 400; ++panel) {
        for (std::size_t n = 0; n < rule.node.size(); ++n) {
            const double u = (panel + rule.node[n]) / 400.0;  // squared height over the axis
            const double cosine = std::sqrt(1.0 - u);
            const double inside = std::sqrt(1.0 - u / (channel.eta * channel.eta));
            // The ray turns by the refraction angle at entry: it leaves at 2 theta_t - theta_i past the far pole.
            const double leaves = std::cos(pi - 2.0 * std::acos(inside) + std::acos(cosine));
            const double t = fresnel_transmittance(cosine, channel.eta);
            const auto bin = std::size_t(std::clamp(int(5.0 * (leaves + 1.0)), 0, 9));
            expected[bin] +=
                2.5 * rule.weight[n] / 400.0 * t * t * unscattered_transmittance(channel, 2.0 * radius * inside);
        }
    }
    // The same share of the ketchup sphere's back cap, by another program.
    EXPECT_NEAR(expected[0], 0.29892, sigmas * 0.00238);
    const auto found = sphere_exitance(channel, radius, 10, 100'000, 11);
    double inside_again = 0.0;
    for (std::size_t bin = 0; bin < 10; ++bin) {
        inside_again += found[bin].mean - expected[bin];
        EXPECT_GE(found[bin].mean + sigmas * found[bin].standard_error, expected[bin]);
    }
    EXPECT_NEAR(found[0].mean, expected[0], sigmas * found[0].standard_error + 0.002);
    EXPECT_LT(inside_again, 0.01) << "reflected inside: under 3 % at each turn, through another 2.4 mean free paths";
}

TEST(SubsurfaceRandomWalk, MeshOfASphereIsTheSphere) {
    const SphereTruth& truth = sphere_truths[1];
    const RayMesh mesh(sphere_mesh(truth.radius, 4, {3.0, -2.0, 50.0}));
    const auto found = mesh_exitance(mesh, truth.radius, truth.channel, 10, 20'000, 5);
    for (std::size_t bin = 0; bin < 10; ++bin) {
        // 5120 flat faces: their normals are off by up to 1.5 degrees, the radius by 0.1 %.
        EXPECT_NEAR(found[bin].mean, truth.walk[bin],
                    sigmas * std::hypot(found[bin].standard_error, truth.walk_error[bin]) + 0.005 * truth.walk[bin])
            << bin;
    }
}

TEST(SubsurfaceRandomWalk, EnergyIsConservedWithoutAbsorption) {
    const SubsurfaceChannel channel{0.0, 0.5, 0.3, 1.5};
    const RayMesh mesh(box_mesh({-1.0, -2.0, -1.5}, {1.0, 2.0, 1.5}));
    const MeshBody body(mesh);
    int escaped = 0;
    int lost = 0;
    constexpr int paths = 4000;
    for (int n = 0; n < paths; ++n) {
        RandomStream random(1, 0, std::uint64_t(n));
        const glm::dvec3 entry(1.8 * random.uniform() - 0.9, 3.6 * random.uniform() - 1.8, 1.5);
        const glm::dvec3 d = refract_into(glm::normalize(glm::dvec3(0.4, 0.1, 1.0)), {0.0, 0.0, 1.0}, channel.eta);
        const Walk walk = random_walk(body, channel, entry, d, random);
        escaped += walk.fate == WalkFate::escaped ? 1 : 0;
        lost += walk.fate == WalkFate::lost ? 1 : 0;
        if (walk.fate == WalkFate::escaped) {
            EXPECT_EQ(walk.weight, 1.0);
            EXPECT_GT(glm::dot(walk.direction, walk.normal), 0.0);
            EXPECT_NEAR(glm::length(walk.direction), 1.0, 1e-12);
        }
    }
    EXPECT_EQ(escaped + lost, paths);
    // A seam is as wide as a float's rounding: 1e-6 of the box, some dozens of flights each.
    EXPECT_LE(lost, 2);
}

TEST(SubsurfaceRandomWalk, UnitOfLengthAndThreadsDoNotMatter) {
    const SubsurfaceChannel channel = potato().channel(1);
    const Estimate in_mm = half_space_reflectance(channel, 0.7, 3000);
    const Estimate again = half_space_reflectance(channel, 0.7, 3000);
    EXPECT_EQ(in_mm.mean, again.mean);
    EXPECT_EQ(in_mm.standard_error, again.standard_error);
    SubsurfaceChannel scaled = channel;
    scaled.sigma_a *= 1024.0;
    scaled.sigma_s *= 1024.0;  // a power of two: the same walks, bit for bit
    EXPECT_EQ(half_space_reflectance(scaled, 0.7, 3000).mean, in_mm.mean);
    EXPECT_NE(half_space_reflectance(channel, 0.7, 3000, 2).mean, in_mm.mean);
}

}  // namespace
}  // namespace bruma::reference
