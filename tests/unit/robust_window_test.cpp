// Shelf: closed form. Ranks, fills, outliers and windows of arrays whose answers are counted by hand.
#include "scene/volume/robust_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/builtin/builtin.h"

namespace bruma::scene {
namespace {

template <class T>
VolumeGrid line_of(VoxelType type, const std::vector<T>& samples) {
    VolumeGrid grid;
    grid.name = "line";
    grid.size = {int(samples.size()), 1, 1};
    grid.type = type;
    grid.voxels.resize(samples.size() * sizeof(T));
    std::memcpy(grid.voxels.data(), samples.data(), grid.voxels.size());
    return grid;
}
VolumeGrid floats(const std::vector<float>& samples) {
    return line_of(VoxelType::float32, samples);
}

/// 5000 floats evenly in [-1, 1], and 500 of each of some others.
VolumeGrid even_floats(const std::vector<float>& others) {
    std::vector<float> samples;
    for (int i = 0; i < 5000; ++i) {
        samples.push_back(float(-1.0 + 2.0 * i / 4999.0));
    }
    for (const float other : others) {
        samples.insert(samples.end(), 500, other);
    }
    return floats(samples);
}

RobustWindow window_of(const VolumeGrid& grid) {
    SampleRanks ranks(grid);
    return robust_window(ranks, Fills::left_out);
}

void expect_window(const RobustWindow& found, double low, double high) {
    EXPECT_NEAR(found.window[0], low, 1e-7);
    EXPECT_NEAR(found.window[1], high, 1e-7);
}

TEST(RobustWindow, LeavesThePaddingOfAScanOut) {
    std::vector<std::int16_t> samples(4000, -32768);
    for (int i = 0; i < 6000; ++i) {
        samples.push_back(std::int16_t(-1024 + 4095 * i / 5999));
    }
    const RobustWindow found = window_of(line_of(VoxelType::int16, samples));
    expect_window(found, -1021.0, 3066.0);
    ASSERT_EQ(found.fills.size(), 1U);
    EXPECT_EQ(found.fills[0].value, -32768.0);
    EXPECT_EQ(found.fills[0].count, 4000U);
    EXPECT_EQ(found.smallest, -1024.0);
}

TEST(RobustWindow, OneVoxelAtTheEndOfTheTypeDecidesNothing) {
    std::vector<std::int16_t> samples;
    for (int i = 0; i < 9999; ++i) {
        samples.push_back(std::int16_t(4095 * i / 9998));
    }
    samples.push_back(32767);
    const RobustWindow found = window_of(line_of(VoxelType::int16, samples));
    expect_window(found, 3.0, 4091.0);
    EXPECT_EQ(found.largest, 4095.0);
}

TEST(RobustWindow, LeavesFillsOfFloatsOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const std::vector<float>& others :
         {std::vector<float>{1e20F}, {-9999.0F}, {1e20F, -9999.0F}, {nan}, {9.96921e36F, -999.0F, nan}, {}}) {
        const RobustWindow found = window_of(even_floats(others));
        expect_window(found, -0.9983997, 0.9979996);
        const auto is_number = [](float other) { return std::isfinite(other); };
        EXPECT_EQ(found.fills.size(), std::size_t(std::count_if(others.begin(), others.end(), is_number)));
        EXPECT_EQ(found.smallest, -1.0);
        EXPECT_EQ(found.largest, 1.0);
    }
}

TEST(RobustWindow, KeepsConstantsPeaksAndBackgrounds) {
    expect_window(window_of(floats(std::vector<float>(1000, 7.0F))), 6.5, 7.5);

    std::vector<std::uint8_t> two(900, 0);
    two.insert(two.end(), 100, 255);
    expect_window(window_of(line_of(VoxelType::uint8, two)), 0.0, 255.0);

    std::vector<std::int16_t> real_background(5000, 0);
    for (int i = 0; i < 4000; ++i) {
        real_background.push_back(std::int16_t(1000 + i % 300));
    }
    real_background.push_back(4095);
    const RobustWindow background = window_of(line_of(VoxelType::int16, real_background));
    expect_window(background, 0.0, 1299.0);
    EXPECT_TRUE(background.fills.empty());

    std::vector<std::uint16_t> few(99950, 0);
    for (int i = 1; i <= 50; ++i) {
        few.push_back(std::uint16_t(i));
    }
    expect_window(window_of(line_of(VoxelType::uint16, few)), 0.0, 50.0);
}

TEST(RobustWindow, OutliersAreWhatAGapSetsApart) {
    VolumeGrid grid = even_floats({});
    auto* const samples = reinterpret_cast<float*>(grid.voxels.data());
    samples[100] = 1e6F;
    samples[200] = 2e6F;
    samples[300] = -40.0F;
    const RobustWindow found = window_of(grid);
    EXPECT_EQ(found.smallest, -40.0);
    EXPECT_EQ(found.largest, 2e6);
    EXPECT_EQ(found.core[0], -1.0);
    EXPECT_EQ(found.core[1], 1.0);
    EXPECT_TRUE(found.fills.empty());
    finish_grid(grid, Fills::left_out);
    EXPECT_TRUE(grid.has_outliers());
    EXPECT_TRUE(grid.absent.empty()) << "outliers are shown, they only decide nothing";
}

TEST(RobustWindow, NothingFiniteIsNothing) {
    VolumeGrid grid = floats(std::vector<float>(100, std::numeric_limits<float>::quiet_NaN()));
    EXPECT_EQ(finish_grid(grid), 100U);
    EXPECT_EQ(grid.present_count(), 0U);
    EXPECT_TRUE(std::isfinite(grid.value(3, 0, 0)));
    VolumeGrid empty;
    EXPECT_EQ(finish_grid(empty), 0U);
}

TEST(RobustWindow, AbsentSamplesAreMarkedAndHoldTheLowerEndOfTheWindow) {
    VolumeGrid grid = even_floats({1e20F, std::numeric_limits<float>::infinity()});
    EXPECT_EQ(finish_grid(grid, Fills::left_out), 500U);
    EXPECT_EQ(grid.present_count(), 5000U);
    EXPECT_FALSE(grid.is_absent(4999));
    EXPECT_TRUE(grid.is_absent(5000));
    EXPECT_TRUE(grid.is_absent(5999));
    EXPECT_EQ(grid.value(5000, 0, 0), grid.suggested_window[0]);
    const Histogram counted = histogram(grid, 10, {-1.0, 1.0});
    for (const std::uint64_t count : counted.counts) {
        EXPECT_NEAR(double(count), 500.0, 1.0);
    }
}

TEST(RobustWindow, NothingIsLeftOutOfWhatCodeMakes) {
    for (const std::string& name : builtin_volume_names()) {
        VolumeGrid grid = *builtin_volume(name);
        EXPECT_FALSE(grid.has_outliers()) << name;
        EXPECT_TRUE(grid.absent.empty()) << name;
        finish_grid(grid, Fills::left_out);
        EXPECT_TRUE(grid.fills.empty()) << name;
    }
}

TEST(SampleRanks, AreThoseOfSortedSamples) {
    std::vector<float> samples;
    std::uint32_t state = 7;
    for (int n = 0; n < 20000; ++n) {
        state = state * 1664525U + 1013904223U;
        const double unit = double(state >> 8) / 16777216.0;
        // Both signs, many magnitudes, and values that repeat.
        samples.push_back(n % 5 == 0 ? float(n % 7 - 3) : float((unit - 0.5) * std::pow(10.0, n % 30 - 15)));
    }
    const VolumeGrid grid = floats(samples);
    SampleRanks ranks(grid);
    std::sort(samples.begin(), samples.end());
    ASSERT_EQ(ranks.count(), samples.size());
    for (const std::uint64_t rank : {1U, 2U, 20U, 777U, 9999U, 10000U, 10001U, 19980U, 19999U, 20000U}) {
        EXPECT_EQ(ranks.at_rank(rank), double(samples[rank - 1])) << rank;
    }
    EXPECT_EQ(ranks.smallest()->value, double(samples.front()));
    EXPECT_EQ(ranks.largest()->value, double(samples.back()));
    const auto next = std::upper_bound(samples.begin(), samples.end(), 0.0F);
    EXPECT_EQ(ranks.next_above(0.0)->value, double(*next));
    EXPECT_EQ(ranks.next_below(double(*next))->value, 0.0);
    EXPECT_EQ(ranks.above(3.0).size(),
              std::size_t(samples.end() - std::upper_bound(samples.begin(), samples.end(), 3.0F)));
    const std::uint64_t threes = std::uint64_t(std::count(samples.begin(), samples.end(), 3.0F));
    ranks.leave_out(3.0);
    EXPECT_EQ(ranks.count(), samples.size() - threes);
    samples.erase(std::remove(samples.begin(), samples.end(), 3.0F), samples.end());
    EXPECT_EQ(ranks.at_rank(15000), double(samples[14999]));
    EXPECT_FALSE(ranks.next_above(double(samples.back())));
}

}  // namespace
}  // namespace bruma::scene
