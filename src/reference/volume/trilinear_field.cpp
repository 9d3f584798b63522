#include "reference/volume/trilinear_field.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace bruma::reference {
namespace {

/// Offsets, in samples, of the planes i and i + 1 of a cell along one axis, clamped to the grid.
std::array<std::size_t, 2> plane_offsets(int cell, int size, std::size_t stride) {
    return {std::size_t(std::clamp(cell, 0, size - 1)) * stride,
            std::size_t(std::clamp(cell + 1, 0, size - 1)) * stride};
}

template <class Sample>
const Sample* samples_of(const scene::VolumeGrid& grid) {
    return reinterpret_cast<const Sample*>(grid.voxels.data());
}

template <class Sample>
std::array<double, 8> read_corners(const scene::VolumeGrid& grid, glm::ivec3 cell) {
    const Sample* samples = samples_of<Sample>(grid);
    const auto x = plane_offsets(cell.x, grid.size.x, 1);
    const auto y = plane_offsets(cell.y, grid.size.y, std::size_t(grid.size.x));
    const auto z = plane_offsets(cell.z, grid.size.z, std::size_t(grid.size.x) * grid.size.y);
    std::array<double, 8> corners;
    for (std::size_t n = 0; n < 8; ++n) {
        corners[n] = double(samples[x[n & 1] + y[(n >> 1) & 1] + z[n >> 2]]);
    }
    return corners;
}

template <class Sample>
std::array<glm::dvec3, 8> read_gradients(const scene::VolumeGrid& grid, glm::ivec3 cell) {
    const Sample* samples = samples_of<Sample>(grid);
    const std::array<std::size_t, 3> stride{1, std::size_t(grid.size.x), std::size_t(grid.size.x) * grid.size.y};
    std::array<glm::dvec3, 8> gradients;
    for (int n = 0; n < 8; ++n) {
        const glm::ivec3 at = glm::clamp(cell + glm::ivec3(n & 1, (n >> 1) & 1, n >> 2), glm::ivec3(0), grid.size - 1);
        const std::size_t center = at.x * stride[0] + at.y * stride[1] + at.z * stride[2];
        glm::dvec3 gradient(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t step = stride[std::size_t(axis)];
            const bool has_lower = at[axis] > 0 && !grid.is_absent(center - step);
            const bool has_upper = at[axis] + 1 < grid.size[axis] && !grid.is_absent(center + step);
            if (has_lower || has_upper) {
                const double upper = double(samples[has_upper ? center + step : center]);
                const double lower = double(samples[has_lower ? center - step : center]);
                gradient[axis] = has_lower && has_upper ? 0.5 * (upper - lower) : upper - lower;
            }
        }
        gradients[std::size_t(n)] = gradient;
    }
    return gradients;
}

}  // namespace

TrilinearField::TrilinearField(std::shared_ptr<const scene::VolumeGrid> grid) : grid_(std::move(grid)) {
    scene::visit_voxels(*grid_, [this]<class Sample>(std::span<const Sample>) {
        read_corners_ = read_corners<Sample>;
        read_gradients_ = read_gradients<Sample>;
    });
}

bool TrilinearField::is_hole(glm::ivec3 cell) const {
    if (grid_->absent.empty()) {
        return false;
    }
    const auto x = plane_offsets(cell.x, grid_->size.x, 1);
    const auto y = plane_offsets(cell.y, grid_->size.y, std::size_t(grid_->size.x));
    const auto z = plane_offsets(cell.z, grid_->size.z, std::size_t(grid_->size.x) * grid_->size.y);
    for (std::size_t n = 0; n < 8; ++n) {
        if (grid_->is_absent(x[n & 1] + y[(n >> 1) & 1] + z[n >> 2])) {
            return true;
        }
    }
    return false;
}

BlockRanges block_ranges(const scene::VolumeGrid& grid) {
    constexpr int edge = BlockRanges::edge;
    BlockRanges blocks;
    blocks.size = (grid.size + 1 + edge - 1) / edge;  // n + 1 cells along an axis of n samples
    blocks.ranges.resize(std::size_t(blocks.size.x) * blocks.size.y * blocks.size.z);
    blocks.has_holes.resize(blocks.ranges.size());
    scene::visit_voxels(grid, [&](auto samples) {
        tbb::parallel_for(0, blocks.size.y * blocks.size.z, [&](int row) {
            for (int bx = 0; bx < blocks.size.x; ++bx) {
                const glm::ivec3 block(bx, row % blocks.size.y, row / blocks.size.y);
                const glm::ivec3 first = glm::max(block * edge - 1, glm::ivec3(0));
                const glm::ivec3 last = glm::min(block * edge - 1 + edge, grid.size - 1);
                float low = std::numeric_limits<float>::infinity();
                float high = -low;
                bool holes = false;
                for (int z = first.z; z <= last.z; ++z) {
                    for (int y = first.y; y <= last.y; ++y) {
                        const std::size_t line = (std::size_t(z) * grid.size.y + y) * grid.size.x;
                        for (int x = first.x; x <= last.x; ++x) {
                            if (grid.is_absent(line + x)) {
                                holes = true;
                                continue;
                            }
                            const auto value = float(samples[line + x]);
                            low = std::min(low, value);
                            high = std::max(high, value);
                        }
                    }
                }
                blocks.ranges[std::size_t(row) * blocks.size.x + bx] = {low, high};
                blocks.has_holes[std::size_t(row) * blocks.size.x + bx] = holes ? 1 : 0;
            }
        });
    });
    return blocks;
}

}  // namespace bruma::reference
