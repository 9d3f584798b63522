#include "scene/volume/volume_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>

#include "scene/volume/robust_window.h"

namespace bruma::scene {

double VolumeGrid::value(int i, int j, int k) const {
    const std::size_t x = std::clamp(i, 0, size.x - 1);
    const std::size_t y = std::clamp(j, 0, size.y - 1);
    const std::size_t z = std::clamp(k, 0, size.z - 1);
    const std::size_t index = (z * size.y + y) * size.x + x;
    return visit_voxels(*this, [index](auto samples) { return double(samples[index]); });
}

std::uint64_t VolumeGrid::present_count() const {
    return voxel_count() - std::uint64_t(std::count_if(absent.begin(), absent.end(), [](auto a) { return a != 0; }));
}

namespace {

void set_range_of_bytes(VolumeGrid& grid) {
    using Range = std::array<int, 2>;
    const Range range = visit_voxels(grid, [](auto samples) {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, samples.size(), 1 << 16), Range{INT_MAX, INT_MIN},
            [&](const auto& part, Range so_far) {
                for (std::size_t n = part.begin(); n != part.end(); ++n) {
                    so_far = {std::min(so_far[0], int(samples[n])), std::max(so_far[1], int(samples[n]))};
                }
                return so_far;
            },
            [](const Range& a, const Range& b) {
                return Range{std::min(a[0], b[0]), std::max(a[1], b[1])};
            });
    });
    grid.smallest = range[0];
    grid.largest = range[1];
    grid.core = grid.suggested_window = {grid.smallest, grid.largest};
}

/// Marks what is absent and lets the lower end of the window stand in for it.
void take_out(VolumeGrid& grid) {
    grid.absent.assign(grid.voxel_count(), 0);
    visit_voxels(grid, [&]<class Sample>(std::span<const Sample>) {
        auto* const samples = reinterpret_cast<Sample*>(grid.voxels.data());
        const auto stand_in = Sample(grid.suggested_window[0]);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grid.voxel_count(), 1 << 16), [&](const auto& part) {
            for (std::size_t n = part.begin(); n != part.end(); ++n) {
                const auto value = double(samples[n]);
                const bool fill = std::any_of(grid.fills.begin(), grid.fills.end(),
                                              [value](const FillValue& known) { return known.value == value; });
                if (fill || !std::isfinite(value)) {
                    grid.absent[n] = 1;
                    samples[n] = stand_in;
                }
            }
        });
    });
}

}  // namespace

std::size_t finish_grid(VolumeGrid& grid, Fills fills) {
    if (bytes_per_voxel(grid.type) == 1) {
        set_range_of_bytes(grid);
        return 0;
    }
    SampleRanks ranks(grid);
    const RobustWindow robust = robust_window(ranks, fills);
    grid.smallest = robust.smallest;
    grid.largest = robust.largest;
    grid.core = robust.core;
    grid.suggested_window = robust.window;
    grid.fills = robust.fills;
    grid.nonfinite = ranks.nonfinite();
    if (!grid.fills.empty() || grid.nonfinite > 0) {
        take_out(grid);
    }
    return grid.nonfinite;
}

std::shared_ptr<const VolumeGrid> make_grid(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                            std::span<const float> samples) {
    auto grid = std::make_shared<VolumeGrid>();
    grid->name = std::move(name);
    grid->size = size;
    grid->spacing = spacing;
    grid->type = VoxelType::float32;
    grid->voxels.resize(samples.size_bytes());
    std::memcpy(grid->voxels.data(), samples.data(), samples.size_bytes());
    finish_grid(*grid);
    return grid;
}

std::shared_ptr<const VolumeGrid> make_grid_uint8(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                                  std::span<const float> samples) {
    auto grid = std::make_shared<VolumeGrid>();
    grid->name = std::move(name);
    grid->size = size;
    grid->spacing = spacing;
    grid->type = VoxelType::uint8;
    grid->voxels.resize(samples.size());
    for (std::size_t n = 0; n < samples.size(); ++n) {
        grid->voxels[n] = std::byte(std::lround(255.0F * std::clamp(samples[n], 0.0F, 1.0F)));
    }
    finish_grid(*grid);
    return grid;
}

Histogram histogram(const VolumeGrid& grid, int bins, std::array<double, 2> range) {
    Histogram result{range[0], range[1], std::vector<std::uint64_t>(std::size_t(bins), 0)};
    const double width = range[1] - range[0];
    const double bins_per_value = width > 0.0 ? bins / width : 0.0;
    using Counts = std::vector<std::uint64_t>;
    result.counts = visit_voxels(grid, [&](auto samples) {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, samples.size(), 1 << 18), Counts(std::size_t(bins), 0),
            [&](const auto& part, Counts counts) {
                for (std::size_t n = part.begin(); n != part.end(); ++n) {
                    if (grid.is_absent(n)) {
                        continue;
                    }
                    const double bin = (double(samples[n]) - range[0]) * bins_per_value;
                    ++counts[std::size_t(std::clamp(bin, 0.0, bins - 1.0))];
                }
                return counts;
            },
            [](Counts a, const Counts& b) {
                for (std::size_t n = 0; n < a.size(); ++n) {
                    a[n] += b[n];
                }
                return a;
            });
    });
    return result;
}

}  // namespace bruma::scene
