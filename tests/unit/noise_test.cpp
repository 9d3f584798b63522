// Shelf: check values, computed once in double from the definitions (Jarzynski and Olano 2020; Perlin 2002; Worley
// 1996) apart from this code, to as many digits as stand here.
#include "reference/clouds/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/integer_hash.h"
#include "reference/clouds/cloud_field.h"

namespace bruma::reference {
namespace {

constexpr glm::ivec3 texel(10, 20, 30);
constexpr double twelve_digits = 1e-12;

glm::dvec3 centre(const glm::ivec3& at, int size) {
    return (glm::dvec3(at) + 0.5) / double(size);
}

TEST(Noise, HashesHaveTheirPublishedBits) {
    EXPECT_EQ(pcg3d(0, 0, 0), (std::array<std::uint32_t, 3>{0x9bafd7c6, 0xa8e88a6b, 0x3f15482c}));
    EXPECT_EQ(pcg3d(1, 2, 3), (std::array<std::uint32_t, 3>{0xfa9f79a6, 0x48f2f44c, 0x596f5ab1}));
    EXPECT_EQ(pcg(0), 0x07bb2fe2U);
    EXPECT_EQ(pcg(1), 0xa8beea3cU);
    EXPECT_EQ(pcg(12345), 0xf45ead0eU);
    EXPECT_EQ(unit_interval(0xffffffffU), 1.0 - 0x1p-24) << "never 1";
    EXPECT_EQ(float(unit_interval(0xffffffffU)), unit_interval(0xffffffffU)) << "floats hold it exactly";
    EXPECT_EQ(cell_hash(-1, 8, 15, 8, 3), cell_hash(7, 0, 7, 8, 3)) << "repeats, negative indices too";
    EXPECT_NE(cell_hash(1, 2, 3, 8, 3), cell_hash(1, 2, 3, 8, 4)) << "streams differ";
}

TEST(Noise, TexelsHaveTheirCheckValues) {
    const glm::dvec3 p = centre(texel, 128);
    EXPECT_NEAR(perlin(p, 8, 0), 0.305682027056, twelve_digits);
    EXPECT_NEAR(worley(p, 8, 16), 0.412995517359, twelve_digits);
    EXPECT_NEAR(perlin_octaves(p, 8, 3, 0), 0.626638524734, twelve_digits);
    const glm::dvec4 shape = shape_texel<double>(texel);
    const glm::dvec4 expected(0.778997262223, 0.337875808886, 0.446981647787, 0.625508988876);
    const glm::dvec3 detail = detail_texel<double>({5, 7, 9});
    const glm::dvec3 expected_detail(0.423588942614, 0.578294280932, 0.230712642032);
    for (int channel = 0; channel < 4; ++channel) {
        EXPECT_NEAR(shape[channel], expected[channel], twelve_digits) << "shape channel " << channel;
    }
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(detail[channel], expected_detail[channel], twelve_digits) << "detail channel " << channel;
    }
    EXPECT_NEAR(base_shape(shape), 0.861777707, 5e-10);
    EXPECT_NEAR(detail_octaves(detail), 0.438155740, 5e-10);
}

TEST(Noise, RepeatsWithoutSeam) {
    for (int n = 0; n < 200; ++n) {
        const glm::dvec3 p = glm::dvec3(unit_interval(pcg(3 * n)), unit_interval(pcg(3 * n + 1)), 0.0);
        // The far face of the tile is the near face: the cell beyond the last is the first.
        const glm::dvec3 q(p.x, p.y, 1.0);
        EXPECT_NEAR(perlin_octaves(p, 8, 3, 0), perlin_octaves(q, 8, 3, 0), 1e-15);
        EXPECT_NEAR(worley_octaves3(p, 4, 5), worley_octaves3(q, 4, 5), 1e-15);
    }
    const NoiseTexture texture = make_detail_noise(8);
    for (int n = 0; n < 50; ++n) {
        const glm::dvec3 p(0.37 * n, -0.21 * n, 0.11 * n);
        EXPECT_NEAR(texture.sample(p).r, texture.sample(p + glm::dvec3(1.0, -3.0, 7.0)).r, 1e-13);
    }
}

TEST(Noise, NearestOf27CellsIsTheNearestOfAll) {
    // 125 cells must find no nearer feature point than 27 once distances are cut at one cell.
    for (int n = 0; n < 2000; ++n) {
        const glm::dvec3 at =
            6.0 * glm::dvec3(unit_interval(pcg(7 * n)), unit_interval(pcg(7 * n + 1)), unit_interval(pcg(7 * n + 2)));
        const glm::ivec3 cell(glm::floor(at));
        double nearest = 1.0;
        for (int dz = -2; dz <= 2; ++dz) {
            for (int dy = -2; dy <= 2; ++dy) {
                for (int dx = -2; dx <= 2; ++dx) {
                    const glm::ivec3 other = cell + glm::ivec3(dx, dy, dz);
                    const auto hash = cell_hash(other.x, other.y, other.z, 6, 9);
                    const glm::dvec3 feature(unit_interval(hash[0]), unit_interval(hash[1]), unit_interval(hash[2]));
                    nearest = std::min(nearest, glm::distance(glm::dvec3(other) + feature, at));
                }
            }
        }
        EXPECT_NEAR(worley(at / 6.0, 6, 9), 1.0 - nearest, 1e-14);
    }
}

TEST(Noise, SampleIsTheTexelAtItsCentreAndLinearBetween) {
    const NoiseTexture texture = make_detail_noise(8);
    for (int channel = 0; channel < 3; ++channel) {
        const double here = texture.texel(2, 7, 5)[channel];
        EXPECT_NEAR(texture.sample(centre({2, 7, 5}, 8))[channel], here, 1e-15);
        // Halfway over the seam of y.
        const double over = texture.texel(2, 0, 5)[channel];
        EXPECT_NEAR(texture.sample(centre({2, 7, 5}, 8) + glm::dvec3(0.0, 0.5 / 8.0, 0.0))[channel],
                    0.5 * (here + over), 1e-15);
    }
    EXPECT_NEAR(texture.texel(2, 7, 5)[1], detail_texel<double>({2, 7, 5}, 8).g, 1e-7);
}

double share_above(const std::vector<double>& sorted, double threshold) {
    const auto first = std::upper_bound(sorted.begin(), sorted.end(), threshold);
    return double(sorted.end() - first) / double(sorted.size());
}

// One test, since each test is a process of its own and the texture takes a second.
TEST(Noise, TheWholeTextureHasItsStatistics) {
    const NoiseTexture shape = make_shape_noise();
    glm::dvec4 mean(0.0);
    std::vector<double> base;
    int codes_apart = 0, code_apart = 0;
    double largest_difference = 0.0;
    for (int k = 0; k < 128; ++k) {
        for (int j = 0; j < 128; ++j) {
            for (int i = 0; i < 128; ++i) {
                const float* at = shape.texel(i, j, k);
                const glm::dvec4 value(at[0], at[1], at[2], at[3]);
                mean += value;
                base.push_back(base_shape(value));
            }
        }
    }
    mean /= double(base.size());
    const glm::dvec4 expected_mean(0.739, 0.479, 0.480, 0.479);
    for (int channel = 0; channel < 4; ++channel) {
        EXPECT_NEAR(mean[channel], expected_mean[channel], 1e-3) << "one unit of the last digit";
    }
    std::sort(base.begin(), base.end());
    const auto quantile = [&](double share) { return base[std::size_t(share * double(base.size() - 1))]; };
    const double base_mean = std::accumulate(base.begin(), base.end(), 0.0) / double(base.size());
    double variance = 0.0;
    for (const double b : base) {
        variance += (b - base_mean) * (b - base_mean) / double(base.size());
    }
    const double found[] = {base.front(), quantile(0.05), quantile(0.5),      quantile(0.95),
                            base.back(),  base_mean,      std::sqrt(variance)};
    const double expected[] = {0.523, 0.737, 0.832, 0.905, 0.980, 0.828, 0.051};
    for (int n = 0; n < 7; ++n) {
        EXPECT_NEAR(found[n], expected[n], 5e-4) << "statistic " << n << " of the base shape";
    }
    const double coverages[] = {0.10, 0.168, 0.2, 0.26, 0.3, 0.4};
    const double shares[] = {0.066, 0.50, 0.72, 0.945, 0.988, 0.9999};
    const double last_digits[] = {5e-4, 5e-3, 5e-3, 5e-4, 5e-4, 5e-5};
    for (int n = 0; n < 6; ++n) {
        EXPECT_NEAR(share_above(base, 1.0 - coverages[n]), shares[n], last_digits[n]) << coverages[n];
    }
    EXPECT_EQ(share_above(base, 1.0 - 0.478), 1.0);
    const LinearCoverage linear(shape);
    EXPECT_EQ(linear(0.0), 0.0);
    for (const double share : {0.1, 0.5, 0.9}) {
        // A thousand quantiles: half a thousandth of the share lies between two of them.
        EXPECT_NEAR(share_above(base, 1.0 - linear(share)), share, 5e-4);
    }

    // What single precision loses, over the first 64^3 texels.
    for (int k = 0; k < 64; ++k) {
        for (int j = 0; j < 64; ++j) {
            for (int i = 0; i < 64; ++i) {
                const glm::vec4 single = shape_texel<float>({i, j, k});
                for (int channel = 0; channel < 4; ++channel) {
                    const double exact = shape.texel(i, j, k)[channel];
                    largest_difference = std::max(largest_difference, std::abs(single[channel] - exact));
                    const int code = int(std::floor(255.0F * single[channel] + 0.5F));
                    const int exact_code = int(std::floor(255.0 * exact + 0.5));
                    codes_apart += code == exact_code ? 0 : 1;
                    code_apart = std::max(code_apart, std::abs(code - exact_code));
                }
            }
        }
    }
    // Measured 1.4e-7 to doubles; the texture itself is rounded to floats, 6e-8 more.
    EXPECT_LE(largest_difference, 2.1e-7);
    EXPECT_LE(code_apart, 1);
    EXPECT_LE(codes_apart, 40) << "of a million; 12 were measured against doubles";
}

TEST(Noise, TheDetailHasItsStatistics) {
    const NoiseTexture detail = packed_detail(make_detail_noise());
    const auto [low, high] = std::minmax_element(detail.texels.begin(), detail.texels.end());
    EXPECT_NEAR(*low, 0.177, 5e-4);
    EXPECT_NEAR(*high, 0.786, 5e-4);
    EXPECT_NEAR(std::accumulate(detail.texels.begin(), detail.texels.end(), 0.0) / double(detail.texels.size()), 0.474,
                1e-3);
}

TEST(Noise, PackingIsExactForTheDetailOnly) {
    const NoiseTexture detail = make_detail_noise(8);
    const NoiseTexture packed = packed_detail(detail);
    const NoiseTexture shape = make_shape_noise(8);
    const NoiseTexture base = packed_shape(shape);
    double apart = 0.0;
    for (int n = 0; n < 100; ++n) {
        const glm::dvec3 p(0.617 * n, 0.433 * n, 0.271 * n);
        EXPECT_NEAR(packed.sample(p).r, detail_octaves(glm::dvec3(detail.sample(p))), 1e-7) << "floats";
        apart = std::max(apart, std::abs(base.sample(p).r - base_shape(shape.sample(p))));
    }
    EXPECT_GT(apart, 1e-4) << "another field, or this test sees nothing";
    EXPECT_LT(apart, 0.1) << "and yet much the same";
    EXPECT_EQ(rounded_to_8_bits(detail).texels[5], std::round(255.0F * detail.texels[5]) / 255.0F);
}

}  // namespace
}  // namespace bruma::reference
