// Shelf: closed form, and the direct product in double precision, O(n) for each of n^2 entries.
#include "render/volume/transfer_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace bruma::render {
namespace {

struct Bins {
    std::vector<double> sigma;
    std::vector<glm::dvec3> source, at_entries;
};

/// Bins with holes and peaks over six orders of magnitude.
Bins random_bins(int count, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> unit;
    Bins bins;
    for (int n = 0; n < count; ++n) {
        const double kind = unit(generator);
        bins.sigma.push_back(kind < 0.3 ? 0.0 : std::pow(10.0, -4.0 + 6.0 * unit(generator)));
        bins.source.emplace_back(unit(generator), unit(generator), unit(generator));
    }
    for (int n = 0; n <= count; ++n) {
        bins.at_entries.emplace_back(unit(generator), unit(generator), unit(generator));
    }
    return bins;
}

/// C / (1 - T) of the run of bins from entry `front` to entry `back`, by adding up bin after bin.
glm::dvec3 direct(const Bins& bins, int front, int back, double tau_of_full_step) {
    if (front == back) {
        return bins.at_entries[std::size_t(front)];
    }
    const int width = std::abs(back - front);
    double tau = 0.0;
    glm::dvec3 radiance(0.0);
    for (int k = 0; k < width; ++k) {
        const auto bin = std::size_t(front < back ? front + k : front - 1 - k);
        const double here = bins.sigma[bin] * tau_of_full_step / width;
        radiance += std::exp(-tau) * -std::expm1(-here) * bins.source[bin];
        tau += here;
    }
    const glm::dvec3 mean = 0.5 * (bins.at_entries[std::size_t(front)] + bins.at_entries[std::size_t(back)]);
    return tau > 0.0 ? radiance / -std::expm1(-tau) : mean;
}

/// Largest difference beyond the rounding of the table's numbers to float.
double largest_excess(const Bins& bins, double tau_of_full_step) {
    const std::vector<glm::vec4> table =
        preintegrate_source(bins.sigma, bins.source, bins.at_entries, tau_of_full_step);
    const int entries = int(bins.sigma.size()) + 1;
    double largest = 0.0;
    for (int front = 0; front < entries; ++front) {
        for (int back = 0; back < entries; ++back) {
            const glm::dvec3 expected = direct(bins, front, back, tau_of_full_step);
            const glm::vec4 found = table[std::size_t(back) * entries + front];
            for (int k = 0; k < 3; ++k) {
                const double difference = std::abs(double(found[k]) - expected[k]);
                // A comparison with NaN is false, so it must not be the one that raises.
                if (!(difference <= largest + 0x1p-24 * expected[k])) {
                    largest = difference - 0x1p-24 * expected[k];
                }
                if (!std::isfinite(found[k])) {
                    return std::numeric_limits<double>::infinity();
                }
            }
        }
    }
    return largest;
}

TEST(TransferTables, AllWindowsEqualTheDirectProduct) {
    // 1e-12: double rounding over at most 255 products; the sheet's prototype had 2.4e-15 for smooth curves.
    for (const int bins : {1, 2, 3, 17, 255}) {
        for (const double tau : {1e-3, 1.0, 40.0}) {
            EXPECT_LE(largest_excess(random_bins(bins, unsigned(bins)), tau), 1e-12)
                << bins << " bins, tau per sigma " << tau;
        }
    }
}

TEST(TransferTables, TheOrderOfFrontAndBackMatters) {
    // An opaque red bin and an opaque green one: what comes first is seen.
    const Bins bins{{50.0, 50.0}, {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}, std::vector<glm::dvec3>(3, glm::dvec3(0.0))};
    const std::vector<glm::vec4> table = preintegrate_source(bins.sigma, bins.source, bins.at_entries, 1.0);
    const glm::vec4 upwards = table[2 * 3 + 0];    // back 2, front 0
    const glm::vec4 downwards = table[0 * 3 + 2];  // back 0, front 2
    EXPECT_NEAR(upwards.x, 1.0, 1e-6);
    EXPECT_NEAR(upwards.y, std::exp(-25.0), 1e-6);
    EXPECT_NEAR(downwards.y, 1.0, 1e-6);
    EXPECT_NEAR(downwards.x, std::exp(-25.0), 1e-6);
}

TEST(TransferTables, ThinAndOpaqueLimits) {
    Bins bins = random_bins(64, 5);
    for (double& sigma : bins.sigma) {
        sigma = std::max(sigma, 0.01);
    }
    EXPECT_LE(largest_excess(bins, 1e-9), 1e-12) << "thin: digits of 1 - T must not be lost";
    EXPECT_LE(largest_excess(bins, 1e6), 1e-12) << "opaque: no division by a transmittance of 0";
    bins.sigma.assign(bins.sigma.size(), 1e6);
    EXPECT_LE(largest_excess(bins, 1e6), 1e-12);
    bins.sigma.assign(bins.sigma.size(), 0.0);
    EXPECT_LE(largest_excess(bins, 1.0), 1e-12) << "nothing there: a finite colour all the same";
}

scene::TransferFunction bent() {
    scene::TransferFunction tf;
    tf.reference_length = 0.002;
    tf.opacity = {{0.1, 0.0}, {0.3, 0.7}, {0.6, 0.0}, {0.9, 0.0}, {1.0, 1.0}};
    tf.color = {{0.0, {1.0, 0.0, 0.0}}, {1.0, {0.0, 0.0, 1.0}}};
    return tf;
}

TEST(TransferTables, KIsTheIntegralOfSigma) {
    const TransferTables tables = make_transfer_tables(bent(), {1.0, true, false});
    double prefix = 0.0;
    const auto sigma = [](int n) {
        return scene::extinction_of_opacity(scene::opacity_at(bent(), n / double(depth_entries - 1)), 1.0);
    };
    for (int n = 0; n < depth_entries; ++n) {
        prefix += n > 0 ? 0.5 * (sigma(n - 1) + sigma(n)) / (depth_entries - 1) : 0.0;
        // One rounding to float each.
        ASSERT_NEAR(tables.depth[std::size_t(n)].x, prefix, 0x1p-24 * prefix) << n;
        ASSERT_NEAR(tables.depth[std::size_t(n)].y, sigma(n), 0x1p-24 * sigma(n)) << n;
        ASSERT_EQ(tables.optics[std::size_t(n)].x, tables.depth[std::size_t(n)].y) << "one sigma in both tables";
    }
    // Against the integral of the exact curve. They part most in the last bin, where the opacity runs from 0.99 to 1:
    // the trapezoid has (4.6 + 11.1) / 2 there, the logarithm's integral is 4.6 + 1; the bends elsewhere add a tenth.
    double exact = 0.0;
    constexpr int fine = 200000;
    for (int n = 0; n < fine; ++n) {
        exact += scene::extinction_of_opacity(scene::opacity_at(bent(), (n + 0.5) / fine), 1.0) / fine;
    }
    EXPECT_NEAR(prefix, exact, 1.1 * 2.23 / (depth_entries - 1));
}

TEST(TransferTables, OpacityOneStaysFinite) {
    scene::TransferFunction tf;
    tf.opacity = {{0.0, 1.0}};
    for (const bool lit : {false, true}) {
        const TransferTables tables = make_transfer_tables(tf, {1e9, true, lit});
        for (const glm::vec2 depth : tables.depth) {
            ASSERT_TRUE(std::isfinite(depth.x) && std::isfinite(depth.y));
        }
        for (const glm::vec4 source : tables.source) {
            ASSERT_NEAR(source.x, 1.0, 1e-6);
        }
    }
}

TEST(TransferTables, VisibleBoundsHoldAllExtinction) {
    const TransferTables tables = make_transfer_tables(bent(), {});
    EXPECT_GT(tables.lowest_visible, 0.09F);
    EXPECT_LE(tables.lowest_visible, 0.1F + 1e-6F);
    EXPECT_GT(tables.highest_visible, 1.0F) << "visible at the end of the window, hence beyond it";
    scene::TransferFunction empty = bent();
    empty.opacity = {{0.0, 0.0}};
    EXPECT_GT(make_transfer_tables(empty, {}).lowest_visible, 1.0F) << "nothing is visible";
}

TEST(TransferTables, OwnLightIsApartOnlyWhenLit) {
    scene::TransferFunction tf = bent();
    EXPECT_FALSE(make_transfer_tables(tf, {1.0, true, true}).glows);
    tf.emission = {{0.0, 0.5}};
    const TransferTables lit = make_transfer_tables(tf, {1.0, true, true});
    const TransferTables unlit = make_transfer_tables(tf, {1.0, true, false});
    EXPECT_TRUE(lit.glows);
    EXPECT_FALSE(unlit.glows);
    EXPECT_TRUE(unlit.glow.empty());
    for (std::size_t n = 0; n < unlit.source.size(); n += 97) {
        for (int k = 0; k < 3; ++k) {
            ASSERT_NEAR(unlit.source[n][k], lit.source[n][k] + lit.glow[n][k], 1e-6) << "float sums";
        }
    }
    EXPECT_TRUE(make_transfer_tables(tf, {1.0, false, false}).source.empty()) << "not asked for";
}

}  // namespace
}  // namespace bruma::render
