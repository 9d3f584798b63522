// Shelf: closed form, by brute force: many samples in each cell that is called empty, and all pairs of cells.
#include "render/volume/macrocells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "reference_scenes.h"

namespace bruma::render {
namespace {

/// Trilinear value at voxel coordinates in [0, size], clamped in the outer half voxel.
double value_at(const scene::VolumeGrid& grid, glm::dvec3 x) {
    const glm::dvec3 p = x - 0.5;
    const glm::dvec3 base = glm::floor(p);
    const glm::dvec3 f = p - base;
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2);
        const double weight = (d.x ? f.x : 1.0 - f.x) * (d.y ? f.y : 1.0 - f.y) * (d.z ? f.z : 1.0 - f.z);
        sum += weight * grid.value(int(base.x) + d.x, int(base.y) + d.y, int(base.z) + d.z);
    }
    return sum;
}

/// Mostly flat data with islands, so that many cells are empty under many transfer functions.
std::shared_ptr<const scene::VolumeGrid> islands(glm::ivec3 size, std::uint32_t seed) {
    return reference::grid_of(size, glm::dvec3(1e-3), [&](glm::ivec3 at) {
        const double island = reference::noise(at / 5, seed);
        return island > 0.6 ? reference::noise(at, seed + 1) : 0.02 * reference::noise(at, seed + 2);
    });
}

scene::TransferFunction random_transfer_function(std::mt19937& generator) {
    std::uniform_real_distribution<double> unit;
    scene::TransferFunction tf;
    tf.opacity.clear();
    const int peaks = 1 + int(generator() % 3);
    for (int n = 0; n < peaks; ++n) {
        const double center = unit(generator);
        const double half_width = std::pow(10.0, -3.0 + 2.0 * unit(generator));
        tf.opacity.insert(tf.opacity.end(),
                          {{center - half_width, 0.0}, {center, unit(generator)}, {center + half_width, 0.0}});
    }
    scene::normalise(tf);
    return tf;
}

/// Extinction as the marcher looks it up: linear between the entries of the table.
double extinction(const TransferTables& tables, double u) {
    const double at = std::clamp(u, 0.0, 1.0) * (depth_entries - 1);
    const int below = std::min(int(at), depth_entries - 2);
    const double f = at - below;
    return (1.0 - f) * tables.depth[std::size_t(below)].y + f * tables.depth[std::size_t(below) + 1].y;
}

glm::ivec3 cell_at(std::size_t index, glm::ivec3 cells) {
    const int n = int(index);
    return {n % cells.x, n / cells.x % cells.y, n / (cells.x * cells.y)};
}

TEST(Macrocells, NoSampleInAnEmptyCellHasExtinction) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> unit;
    std::size_t empty_cells = 0, all_cells = 0;
    for (const glm::ivec3 size : {glm::ivec3(23, 17, 14), glm::ivec3(16), glm::ivec3(5, 1, 33)}) {
        const auto grid = islands(size, std::uint32_t(size.x));
        const CellRanges ranges = make_cell_ranges(*grid);
        ASSERT_EQ(ranges.cells, (size + ranges.edge - 1) / ranges.edge);
        for (int trial = 0; trial < 12; ++trial) {
            const scene::TransferFunction tf = random_transfer_function(generator);
            // Windows narrower and wider than the data, and reversed ones.
            const double low = -0.2 + 0.5 * unit(generator), high = 0.5 + 0.7 * unit(generator);
            const double begin = trial % 4 == 3 ? high : low, width = trial % 4 == 3 ? low - high : high - low;
            const glm::dvec2 u_of_value(1.0 / width, -begin / width);
            const TransferTables tables = make_transfer_tables(tf, {1.0, false, false});
            const Emptiness found = find_emptiness(ranges, tables, u_of_value);
            ASSERT_EQ(found.cells, ranges.cells);
            all_cells += found.distance.size();
            for (std::size_t n = 0; n < found.distance.size(); ++n) {
                if (found.distance[n] == 0) {
                    continue;
                }
                ++empty_cells;
                const glm::dvec3 corner = cell_at(n, found.cells) * ranges.edge;
                for (int sample = 0; sample < 60; ++sample) {
                    // Corners, faces and edges of the cell too: they are where a ring voxel is read.
                    glm::dvec3 inside(unit(generator), unit(generator), unit(generator));
                    if (sample % 3 == 0) {
                        inside = glm::round(inside);
                    }
                    const glm::dvec3 x = glm::min(corner + inside * double(ranges.edge), glm::dvec3(size));
                    const double u = value_at(*grid, x) * u_of_value.x + u_of_value.y;
                    ASSERT_EQ(extinction(tables, u), 0.0) << "cell " << n << ", u " << u << ", trial " << trial;
                }
            }
        }
    }
    RecordProperty("empty share", std::to_string(double(empty_cells) / double(all_cells)));
    EXPECT_GT(empty_cells, all_cells / 10) << "else the test says nothing";
    EXPECT_LT(empty_cells, all_cells);
}

TEST(Macrocells, DistanceIsChebyshevs) {
    std::mt19937 generator(11);
    for (const glm::ivec3 size : {glm::ivec3(60, 44, 52), glm::ivec3(120, 4, 7), glm::ivec3(1, 1, 90)}) {
        for (const double share : {0.002, 0.05}) {
            // One bright voxel here and there.
            const auto grid = reference::grid_of(size, glm::dvec3(1.0), [&](glm::ivec3) {
                return std::uniform_real_distribution<double>()(generator) < share ? 1.0 : 0.0;
            });
            scene::TransferFunction tf;
            tf.opacity = {{0.5, 0.0}, {0.9, 0.5}};
            const CellRanges ranges = make_cell_ranges(*grid);
            const Emptiness found = find_emptiness(ranges, make_transfer_tables(tf, {1.0, false, false}), {1.0, 0.0});
            std::vector<glm::ivec3> occupied;
            for (std::size_t n = 0; n < found.distance.size(); ++n) {
                if (found.distance[n] == 0) {
                    occupied.push_back(cell_at(n, found.cells));
                }
            }
            EXPECT_EQ(found.occupied_share, double(occupied.size()) / double(found.distance.size()));
            for (std::size_t n = 0; n < found.distance.size(); ++n) {
                int nearest = 255;
                for (const glm::ivec3 other : occupied) {
                    const glm::ivec3 d = glm::abs(other - cell_at(n, found.cells));
                    nearest = std::min(nearest, std::max({d.x, d.y, d.z}));
                }
                ASSERT_EQ(int(found.distance[n]), nearest) << "cell " << n;
            }
        }
    }
}

TEST(Macrocells, EverythingEmptyAndEverythingFull) {
    const auto grid = islands(glm::ivec3(20), 3);
    const CellRanges ranges = make_cell_ranges(*grid);
    scene::TransferFunction tf;
    tf.opacity = {{0.0, 0.0}};
    const Emptiness none = find_emptiness(ranges, make_transfer_tables(tf, {}), {1.0, 0.0});
    EXPECT_EQ(none.occupied_share, 0.0);
    EXPECT_EQ(*std::min_element(none.distance.begin(), none.distance.end()), 255);
    tf.opacity = {{0.0, 0.1}};
    const Emptiness all = find_emptiness(ranges, make_transfer_tables(tf, {}), {1.0, 0.0});
    EXPECT_EQ(all.occupied_share, 1.0);
    EXPECT_EQ(*std::max_element(all.distance.begin(), all.distance.end()), 0);
}

}  // namespace
}  // namespace bruma::render
