// Shelf: closed form. Bounds of the extinction hold at every point of the medium, and are reached.
#include "render/volume/majorants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference_scenes.h"
#include "render/volume/scattering_tables.h"

namespace bruma::render {
namespace {

using reference::grid_of;
using reference::noise;
using reference::rich_transfer_function;

/// What a linear lookup gives.
double table_at(const std::vector<float>& table, double u) {
    const double at = std::clamp(u, 0.0, 1.0) * double(table.size() - 1);
    const auto below = std::min(std::size_t(at), table.size() - 2);
    return std::lerp(double(table[below]), double(table[below + 1]), at - double(below));
}

double trilinear(const scene::VolumeGrid& grid, glm::dvec3 at_voxels) {
    const glm::dvec3 p = at_voxels - 0.5;
    const glm::ivec3 low(glm::floor(p));
    const glm::dvec3 f = p - glm::dvec3(low);
    double value = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 d(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(d));
        value += w.x * w.y * w.z * grid.value(low.x + d.x, low.y + d.y, low.z + d.z);
    }
    return value;
}

TEST(Majorants, HoldAtEveryPointAndAreTight) {
    const auto grid = grid_of({19, 9, 13}, glm::dvec3(1.0), [](glm::ivec3 at) { return noise(at); });
    const std::vector<float> extinction = tabulate_extinction(rich_transfer_function(1.0));
    const std::array<double, 2> window{0.2, 0.9};
    const glm::dvec2 u_of_value(1.0 / (window[1] - window[0]), -window[0] / (window[1] - window[0]));
    const CellRanges ranges = make_cell_ranges(*grid);
    const ExtinctionBounds bounds = bound_extinction(ranges, extinction, u_of_value);
    ASSERT_EQ(bounds.cells, glm::ivec3(5, 3, 4));
    double closest = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 200'000; ++n) {
        const glm::dvec3 share(noise({n, 1, 0}), noise({n, 2, 0}), noise({n, 3, 0}));
        const glm::dvec3 at = share * glm::dvec3(grid->size);
        const glm::ivec3 cell = glm::min(glm::ivec3(at) / ranges.edge, bounds.cells - 1);
        const glm::vec2 bound =
            bounds.least_most[(std::size_t(cell.z) * bounds.cells.y + cell.y) * bounds.cells.x + cell.x];
        const double sigma = table_at(extinction, trilinear(*grid, at) * u_of_value.x + u_of_value.y);
        ASSERT_LE(bound.x, sigma) << n;
        ASSERT_GE(bound.y, sigma) << n;
        closest = std::min(closest, bound.y - sigma);
    }
    EXPECT_LT(closest, 0.01) << "a bound that is never near would only cost time";
}

TEST(Majorants, AreTheExtinctionOfHomogeneousMatter) {
    const auto grid = reference::homogeneous({6, 6, 6}, glm::dvec3(1.0));
    const scene::TransferFunction tf = reference::uniform_extinction(3.0);
    const ExtinctionBounds bounds = bound_extinction(make_cell_ranges(*grid), tabulate_extinction(tf), {1.0, -0.5});
    for (const glm::vec2 bound : bounds.least_most) {
        EXPECT_NEAR(bound.x / tf.reference_length, 3.0, 1e-5);
        EXPECT_NEAR(bound.y / tf.reference_length, 3.0, 1e-5);
        EXPECT_LE(bound.x, bound.y);
    }
}

TEST(ScatteringTables, HoldTheCurvesAndCutAlbedoAtOne) {
    scene::TransferFunction tf = rich_transfer_function(1e-3);
    tf.color = {{0.0, {0.5, 1.5, 4.0}}};
    const ScatteringTables tables = make_scattering_tables(tf, {1.0, 0.5, 0.5}, 0.25);
    ASSERT_EQ(tables.optics.size(), std::size_t(scattering_entries));
    for (int n = 0; n < scattering_entries; n += 17) {
        const double u = double(n) / (scattering_entries - 1);
        const glm::vec4 optics = tables.optics[std::size_t(n)];
        EXPECT_NEAR(optics.x, scene::extinction_of_opacity(scene::opacity_at(tf, u), 1.0), 1e-6);
        EXPECT_EQ(glm::vec3(optics.y, optics.z, optics.w), glm::vec3(0.5F, 0.75F, 1.0F));
        EXPECT_NEAR(tables.glow[std::size_t(n)].z, 4.0 * (0.25 + scene::emission_at(tf, u)), 1e-6);
    }
    tf.emission.clear();
    EXPECT_TRUE(make_scattering_tables(tf, glm::dvec3(1.0), 0.0).glow.empty());
}

}  // namespace
}  // namespace bruma::render
