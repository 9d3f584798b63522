// Shelf: closed form and independent quadrature. Densities integrate to 1, samples follow them, estimators are right,
// and how many evaluations each needs for the same noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "reference/random.h"
#include "reference/subsurface/subsurface_noise.h"
#include "reference/subsurface/subsurface_sampling.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;
const glm::dvec3 up(0.0, 0.0, 1.0);

struct Material {
    const char* name;
    SubsurfaceMedium medium;
};
std::vector<Material> materials() {
    return {{"cream", cream()}, {"marble", marble()}, {"potato", potato()}, {"skin1", skin1()}, {"ketchup", ketchup()}};
}

/// Drawn points against the integral of p: how many fall within circles about x_o and to its right, and the mean of
/// 1 / p. `azimuths` is 1 for a density that depends on rho alone.
template <class Density>
void expect_samples_follow(const Density& density, int azimuths, double reach, const std::string& name) {
    constexpr int count = 40000;
    int within[3] = {0, 0, 0};
    int right = 0;
    double one_over_p = 0.0;
    RandomStream random(7, 0, 0);
    for (int n = 0; n < count; ++n) {
        const double u = random.uniform();
        const glm::dvec2 d = density.sample(u, random.uniform());
        ASSERT_GT(density.pdf(d), 0.0) << name;
        for (int k = 0; k < 3; ++k) {
            within[k] += glm::length(d) < reach * std::pow(4.0, -k) ? 1 : 0;
        }
        right += d.x > 0.0 && glm::length(d) < reach ? 1 : 0;
        one_over_p += glm::length(d) < 0.5 * reach ? 1.0 / density.pdf(d) : 0.0;
    }
    static const GaussLegendre rule(100);
    const auto share = [&](double radius, bool right_half) {
        double sum = 0.0;
        for (int n = 0; n < azimuths; ++n) {
            const double phi = 2.0 * pi * (n + 0.5) / azimuths;
            const glm::dvec2 way(std::cos(phi), std::sin(phi));
            if (azimuths == 1 || !right_half || way.x > 0.0) {
                // Squared nodes crowd towards x_o, where a core may be a thousandth of the circle.
                sum += rule.integrate(0.0, std::sqrt(radius), [&](double root) {
                    return 2.0 * root * root * root * density.pdf(root * root * way);
                });
            }
        }
        return sum * 2.0 * pi / azimuths * (azimuths == 1 && right_half ? 0.5 : 1.0);
    };
    const auto expect_count = [&](int found, double expected, const char* what) {
        // Five standard deviations; the quadrature stumbles over the bounding disk's edge by some 1e-4.
        const double deviation = std::sqrt(std::max(0.0, expected * (1.0 - expected)) / count);
        EXPECT_NEAR(double(found) / count, expected, 5.0 * deviation + 3e-4) << name << what;
    };
    for (int k = 0; k < 3; ++k) {
        expect_count(within[k], share(reach * std::pow(4.0, -k), false), " within a circle");
    }
    expect_count(right, share(reach, true), " to the right");
    // E[1 / p over a disk] is the disk's area wherever p is positive; 1 / p varies by up to twice its mean.
    EXPECT_NEAR(one_over_p / count / (pi * 0.25 * reach * reach), 1.0, 5.0 * 2.0 / std::sqrt(double(count))) << name;
}

TEST(SubsurfaceSampling, RadicalInverse) {
    const double by_2[] = {0.5, 0.25, 0.75, 0.125};
    const double by_3[] = {1.0 / 3.0, 2.0 / 3.0, 1.0 / 9.0, 4.0 / 9.0};
    for (unsigned n = 1; n <= 4; ++n) {
        EXPECT_DOUBLE_EQ(radical_inverse(n, 2), by_2[n - 1]);
        EXPECT_NEAR(radical_inverse(n, 3), by_3[n - 1], 1e-16);
    }
}

TEST(SubsurfaceSampling, LitDensitiesIntegrateToOne) {
    for (const Material& material : materials()) {
        for (const double texel : {0.0, 2.0}) {
            const CoreTailDensity density(material.medium, 1e3, texel);
            const double slowest = *std::min_element(density.rates().begin(), density.rates().end());
            const double all = integrate_plane(slowest, 1e-4, [&](double rho) {
                return density.pdf({0.6 * rho, 0.8 * rho});
            });
            EXPECT_NEAR(all, 1.0, 1e-9) << material.name;
            EXPECT_LE(texel * density.rates()[3], 2.0);
        }
        const ExponentialDisk disk = ExponentialDisk::published(material.medium, 1e3);
        for (const ExponentialDisk& each : {disk, disk.cut_to(0.1 / disk.rate())}) {
            const double inside = integrate_plane(
                each.rate(), 1e-4,
                [&](double rho) {
                    return each.pdf({-rho, 0.0});
                },
                each.radius());
            EXPECT_NEAR(inside, 1.0, 1e-9) << material.name;
            EXPECT_EQ(each.pdf({0.0, 1.001 * each.radius()}), 0.0);
        }
    }
}

TEST(SubsurfaceSampling, SamplesFollowTheirDensities) {
    for (const Material& material : materials()) {
        const double slowest = CoreTailDensity(material.medium, 1e3).rates()[0];
        expect_samples_follow(CoreTailDensity(material.medium, 1e3), 1, 1.0 / slowest, material.name);
        expect_samples_follow(CoreTailDensity(material.medium, 1e3, 2.0), 1, 1.0 / slowest, material.name);
        const ExponentialDisk disk = ExponentialDisk::published(material.medium, 1e3);
        expect_samples_follow(disk, 1, disk.radius(), material.name);
        for (const double depth : {1.0, 8.0}) {
            // Short of the disk's rim, where the density is infinite.
            expect_samples_follow(BackLitDensity(material.medium, depth, {{3.0, -2.0}, 10.0}), 256, 6.0, material.name);
        }
    }
}

TEST(SubsurfaceSampling, BackLitDensityIntegratesToOne) {
    // Both parts in coordinates of their own: p minus the uniform part is the part around x_o.
    for (const Material& material : materials()) {
        const BoundingDisk outline{{3.0, -2.0}, 10.0};
        const BackLitDensity density(material.medium, 6.0, outline);
        const BackLitDensity thin(material.medium, 2.4, outline);
        EXPECT_EQ(thin.uniform_share(), 0.25);
        EXPECT_EQ(thin.hemisphere_share(), 0.0);
        EXPECT_EQ(thin.disk_pdf({0.0, 0.0}), 0.25 / (pi * 100.0));
        // rho = radius sqrt(1 - w^2) takes the infinite rim away.
        static const GaussLegendre rule(24);
        const double in_disk = rule.integrate(0.0, 1.0, [&](double w) {
            const glm::dvec2 d(outline.radius * std::sqrt(1.0 - w * w), 0.0);
            return 2.0 * pi * outline.radius * outline.radius * w * density.disk_pdf(outline.centre + d);
        });
        EXPECT_NEAR(in_disk, density.uniform_share() + density.hemisphere_share(), 1e-9) << material.name;
        const double around = integrate_plane(0.05, 1e-3, [&](double rho) {
            const glm::dvec2 d(-rho, 0.0);
            return density.pdf(d) - density.disk_pdf(d);
        });
        EXPECT_NEAR(around, 1.0 - in_disk, 1e-6) << material.name;
        EXPECT_FALSE(is_back_lit(material.medium, 0.0));
        EXPECT_TRUE(is_back_lit(material.medium, 40.0));
    }
}

TEST(SubsurfaceSampling, NoAbsorptionKeepsTheTailFinite) {
    const SubsurfaceMedium spectralon{glm::dvec3(0.0), {11.6, 20.4, 14.9}, glm::dvec3(0.0), 1.3};
    const CoreTailDensity density(spectralon, 50.0);
    EXPECT_GT(density.rates()[0], 0.0);
    EXPECT_GT(density.pdf({1.0, 0.0}), 0.0);
    EXPECT_LE(ExponentialDisk::published(spectralon, 50.0).cut_to(50.0).radius(), 100.0);
    const glm::dvec2 last = density.sample(1.0 - 0x1p-53, 0.5);
    EXPECT_TRUE(std::isfinite(last.x) && std::isfinite(last.y));
}

TEST(SubsurfaceSampling, NoiseOnALitSlabIsThatOfItsTable) {
    struct Row {
        double disk[3], core_tail[3];
    };
    // Per-sample relative standard deviations by independent quadrature, red, green, blue. Two digits are printed, so 3
    // %.
    const Row rows[] = {{{49, 39, 26}, {0.62, 0.73, 0.88}},
                        {{7.6, 9.4, 11}, {0.60, 0.61, 0.62}},
                        {{5.2, 6.3, 11}, {0.51, 0.45, 0.46}},
                        {{2.2, 4.4, 7.9}, {0.76, 0.27, 0.52}},
                        {{1.4, 11, 16}, {1.03, 0.63, 0.83}}};
    const auto all = materials();
    for (std::size_t m = 0; m < all.size(); ++m) {
        const SubsurfaceMedium& medium = all[m].medium;
        const ExponentialDisk disk = ExponentialDisk::published(medium, 1e3);
        const CoreTailDensity core_tail(medium, 1e3);
        for (int c = 0; c < 3; ++c) {
            const Dipole dipole(medium.channel(c), SubsurfaceModel::directional_dipole);
            const double rate = std::min(disk.rate(), dipole.diffusion().sigma_tr);
            const double by_disk = lit_slab_moments(dipole, rate, pdf_of(disk), disk.radius()).deviation();
            const double by_core_tail = lit_slab_moments(dipole, rate, pdf_of(core_tail)).deviation();
            EXPECT_NEAR(by_disk, rows[m].disk[c], 0.05 * rows[m].disk[c]) << all[m].name << c;
            EXPECT_NEAR(by_core_tail, rows[m].core_tail[c], 0.02 * rows[m].core_tail[c] + 0.005) << all[m].name << c;
            const double fewer = by_disk * by_disk / (by_core_tail * by_core_tail);
            std::printf("    lit slab, %-8s channel %d: %8.1f times fewer evaluations for the same noise\n",
                        all[m].name, c, fewer);
            if (m < 2) {
                EXPECT_GE(fewer, 50.0) << all[m].name << c;
            }
        }
    }
}

TEST(SubsurfaceSampling, NoiseBehindASphereIsThatOfItsTable) {
    struct Row {
        const char* name;
        SubsurfaceMedium medium;
        double radius, cosine;
        double disk[3], back_lit[3];
    };
    const Row rows[] = {
        {"marble, back pole", marble(), 10.0, -1.0, {1.8, 1.8, 2.0}, {0.738, 0.775, 0.829}},
        {"marble, -0.5", marble(), 10.0, -0.5, {2.3, 2.7, 3.2}, {0.972, 1.142, 1.385}},
        {"cream, back pole", cream(), 10.0, -1.0, {2.7, 2.9, 3.3}, {0.738, 0.826, 0.984}},
        {"potato, back pole", potato(), 10.0, -1.0, {2.5, 2.6, 3.3}, {0.740, 0.770, 1.041}},
        {"skin1, back pole", skin1(), 10.0, -1.0, {1.6, 2.8, 4.8}, {0.905, 1.370, 2.228}},
        {"ketchup, back pole", ketchup(), 5.0, -1.0, {1.7, 3.5, 5.0}, {0.767, 1.420, 1.905}},
    };
    for (const Row& row : rows) {
        const SurfacePoint exit = on_sphere(row.radius, row.cosine);
        const double depth = -2.0 * exit.position.z;
        const ExponentialDisk disk = ExponentialDisk::published(row.medium, row.radius);
        const BackLitDensity back(row.medium, depth, {-glm::dvec2(exit.position), row.radius});
        ASSERT_TRUE(is_back_lit(row.medium, depth));
        for (int c = 0; c < 3; ++c) {
            const Dipole dipole(row.medium.channel(c), SubsurfaceModel::directional_dipole);
            const double by_disk = sphere_moments(dipole, row.medium.eta, row.radius, exit, pdf_of(disk)).deviation();
            const double by_back = sphere_moments(dipole, row.medium.eta, row.radius, exit, pdf_of(back)).deviation();
            // Two printed digits of a sum over texels; ours does not move by 1 % under a finer rule.
            EXPECT_NEAR(by_disk, row.disk[c], 0.08 * row.disk[c]) << row.name << c;
            EXPECT_NEAR(by_back, row.back_lit[c], 0.08 * row.back_lit[c]) << row.name << c;
            const double fewer = by_disk * by_disk / (by_back * by_back);
            const ExponentialDisk cut = disk.cut_to(row.radius);
            const double by_cut = sphere_moments(dipole, row.medium.eta, row.radius, exit, pdf_of(cut)).deviation();
            std::printf(
                "    %-18s channel %d: %6.2f times fewer evaluations for the same noise, %.2f than the cut disk\n",
                row.name, c, fewer, by_cut * by_cut / (by_back * by_back));
            // Even beside the disk of which nothing is drawn beside the body in vain.
            if (row.name[0] == 'm' || row.name[0] == 'c') {
                EXPECT_GE(by_cut * by_cut / (by_back * by_back), 3.0) << row.name << c;
            }
        }
    }
}

TEST(SubsurfaceSampling, EveryChoiceIsUnbiasedBehindASphere) {
    const double radius = 10.0;
    const SubsurfaceMedium medium = marble();
    const Dipole dipole(medium.channel(1), SubsurfaceModel::directional_dipole);
    for (const double cosine : {-1.0, -0.5}) {
        const SurfacePoint exit = on_sphere(radius, cosine);
        const BackLitDensity back(medium, -2.0 * exit.position.z, {-glm::dvec2(exit.position), radius});
        const CoreTailDensity core_tail(medium, radius);
        const double truth = sphere_moments(dipole, medium.eta, radius, exit, pdf_of(back)).mean;
        const auto ratio = [&](const auto& density, double deviation) {
            constexpr int count = 40000;
            double sum = 0.0;
            for (unsigned n = 1; n <= count; ++n) {
                const glm::dvec2 d = density.sample(radical_inverse(n, 2), radical_inverse(n, 3));
                sum += sphere_kernel(dipole, medium.eta, radius, d + glm::dvec2(exit.position), exit) / density.pdf(d);
            }
            // Halton points do better than independent ones, which would stay within four of these.
            EXPECT_NEAR(sum / count / truth, 1.0, 4.0 * deviation / std::sqrt(double(count))) << cosine;
        };
        ratio(back, 1.4);
        ratio(core_tail, 3.0);
    }
}

/// Ratios of estimators to quadrature, flat half-space of potato in normal light, sigma* R = 10.
class EstimatorRegression : public testing::Test {
  protected:
    SubsurfaceMedium medium = potato();
    Bssrdf bssrdf{medium, SubsurfaceModel::directional_dipole};
    double rate = bssrdf.channel(0).diffusion().sigma_tr;
    ExponentialDisk disk{rate, 10.0 / rate};

    glm::dvec3 s_d(double rho) const { return bssrdf.s_d({}, -up, {{rho, 0.0, 0.0}, up}); }
    glm::dvec3 truth() const {
        glm::dvec3 sum;
        for (int c = 0; c < 3; ++c) {
            sum[c] = integrate_plane(rate, 1e-4, [&](double rho) { return s_d(rho)[c]; });
        }
        return sum;
    }
    /// Integral over the disk of S_d times a weight.
    template <class Weight>
    glm::dvec3 over_disk(const Weight& weight) const {
        glm::dvec3 sum;
        for (int c = 0; c < 3; ++c) {
            sum[c] = integrate_plane(
                rate, 1e-4, [&](double rho) { return s_d(rho)[c] * weight(rho); }, disk.radius());
        }
        return sum;
    }
    void expect_ratio(glm::dvec3 estimate, glm::dvec3 expected, double tolerance) const {
        const glm::dvec3 ratio = estimate / truth();
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(ratio[c], expected[c], tolerance * expected[c]) << "channel " << c;
        }
    }
};

TEST_F(EstimatorRegression, RejectionDividedByWhatWasAcceptedIsFiftyTimesTooBright) {
    const double area = pi * disk.radius() * disk.radius();
    EXPECT_NEAR(area / disk.normaliser(), 50.0, 0.1);
    glm::dvec3 sum(0.0);
    std::uint64_t accepted = 0;
    const std::uint64_t tried = 4'000'000;
    for (std::uint64_t n = 1; n <= tried; ++n) {
        const double rho = disk.radius() * std::sqrt(radical_inverse(n, 2));  // the azimuth does not matter here
        if (radical_inverse(n, 3) < std::exp(-rate * rho)) {
            ++accepted;
            sum += s_d(rho) * std::exp(rate * rho);
        }
    }
    // 80 000 accepted points of a deviation of 5 to 11 would give 2 to 4 %; Halton's do better.
    expect_ratio(area / double(accepted) * sum, {50.1, 50.1, 50.2}, 0.02);
    expect_ratio(area / double(tried) * sum, {1.002, 1.002, 1.004}, 0.02);
}

TEST_F(EstimatorRegression, NormalisedExponentialDiskIsRight) {
    glm::dvec3 sum(0.0);
    const unsigned count = 200'000;
    for (unsigned n = 1; n <= count; ++n) {
        const double rho = glm::length(disk.sample(radical_inverse(n, 2), radical_inverse(n, 3)));
        sum += s_d(rho) / disk.pdf({rho, 0.0});
    }
    // A smooth one-dimensional integrand and 2e5 points; the cut at sigma* R = 10 takes 5e-4.
    expect_ratio(sum / double(count), {1.002, 1.002, 1.004}, 0.006);
}

TEST_F(EstimatorRegression, DiskFromAProjectedSphereIsTooDark) {
    // Dropping z of a point on the sphere crowds the rim; Z / N then is the wrong normaliser.
    static const GaussLegendre rule(200);
    const auto crowding = [&](double rho) {
        return 0.5 / std::sqrt(std::max(1e-12, 1.0 - rho * rho / (disk.radius() * disk.radius())));
    };
    const double z = 2.0 * pi * rule.integrate(0.0, 1.0, [&](double t) {
        const double rho = disk.radius() * (1.0 - t * t);  // smooth across the crowded rim
        return 2.0 * disk.radius() * t * rho * crowding(rho) * std::exp(-rate * rho);
    });
    expect_ratio(disk.normaliser() / z * over_disk(crowding), {0.964, 0.963, 0.962}, 0.003);
}

TEST_F(EstimatorRegression, ClosestOfManyPointsAreBiased) {
    // The chance that a point is among the 50 nearest of 1000, from the binomial distribution of the others.
    constexpr int kept = 50;
    constexpr int others = 999;
    const auto is_kept = [&](double rho) {
        const double t = rate * rho;
        const double inside =
            std::clamp((1.0 - (1.0 + t) * std::exp(-t)) / (1.0 - 11.0 * std::exp(-10.0)), 1e-300, 1.0 - 1e-16);
        double sum = 0.0;
        for (int n = 0; n < kept; ++n) {
            sum += std::exp(std::lgamma(others + 1.0) - std::lgamma(n + 1.0) - std::lgamma(others - n + 1.0) +
                            n * std::log(inside) + (others - n) * std::log1p(-inside));
        }
        return sum;
    };
    const glm::dvec3 by_all = over_disk(is_kept);  // Z / M: the tail is lost
    expect_ratio(by_all, {0.63, 0.72, 0.93}, 0.01);
    expect_ratio(by_all * (1000.0 / kept), {12.5, 14.3, 18.7}, 0.01);  // Z / N
}

TEST_F(EstimatorRegression, CoreAndTailIsRight) {
    const CoreTailDensity density(medium, 1e3);
    glm::dvec3 sum(0.0);
    const unsigned count = 200'000;
    for (unsigned n = 1; n <= count; ++n) {
        const glm::dvec2 d = density.sample(radical_inverse(n, 2), radical_inverse(n, 3));
        sum += s_d(glm::length(d)) / density.pdf(d);
    }
    expect_ratio(sum / double(count), glm::dvec3(1.0), 0.0015);
}

}  // namespace
}  // namespace bruma::reference
