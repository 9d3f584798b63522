#include "scene/volume_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace bruma::scene {

double VolumeGrid::value(int i, int j, int k) const {
    const std::size_t x = std::clamp(i, 0, size.x - 1);
    const std::size_t y = std::clamp(j, 0, size.y - 1);
    const std::size_t z = std::clamp(k, 0, size.z - 1);
    const std::size_t index = (z * size.y + y) * size.x + x;
    return visit_voxels(*this, [index](auto samples) { return double(samples[index]); });
}

std::size_t finish_grid(VolumeGrid& grid) {
    struct Range {
        double smallest = std::numeric_limits<double>::infinity();
        double largest = -std::numeric_limits<double>::infinity();
        std::size_t broken = 0;
    };
    const Range range = visit_voxels(grid, [](auto samples) {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, samples.size(), 1 << 16), Range{},
            [&](const auto& part, Range so_far) {
                for (std::size_t n = part.begin(); n != part.end(); ++n) {
                    const double value = double(samples[n]);
                    if (!std::isfinite(value)) {
                        ++so_far.broken;
                        continue;
                    }
                    so_far.smallest = std::min(so_far.smallest, value);
                    so_far.largest = std::max(so_far.largest, value);
                }
                return so_far;
            },
            [](const Range& a, const Range& b) {
                return Range{std::min(a.smallest, b.smallest), std::max(a.largest, b.largest), a.broken + b.broken};
            });
    });
    const bool nothing_finite = range.smallest > range.largest;
    grid.smallest = nothing_finite ? 0.0 : range.smallest;
    grid.largest = nothing_finite ? 0.0 : range.largest;
    if (range.broken > 0) {
        auto* samples = reinterpret_cast<float*>(grid.voxels.data());
        for (std::size_t n = 0; n < grid.voxel_count(); ++n) {
            if (!std::isfinite(samples[n])) {
                samples[n] = float(grid.smallest);
            }
        }
    }
    return range.broken;
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

Histogram histogram(const VolumeGrid& grid, int bins) {
    Histogram result{grid.smallest, grid.largest, std::vector<std::uint64_t>(std::size_t(bins), 0)};
    const double width = grid.largest - grid.smallest;
    const double bins_per_value = width > 0.0 ? bins / width : 0.0;
    using Counts = std::vector<std::uint64_t>;
    result.counts = visit_voxels(grid, [&](auto samples) {
        return tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, samples.size(), 1 << 18), Counts(std::size_t(bins), 0),
            [&](const auto& part, Counts counts) {
                for (std::size_t n = part.begin(); n != part.end(); ++n) {
                    const int bin = int((double(samples[n]) - grid.smallest) * bins_per_value);
                    ++counts[std::size_t(std::clamp(bin, 0, bins - 1))];
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
