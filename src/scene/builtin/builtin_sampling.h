#pragma once
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>

#include "scene/volume/volume_grid.h"

/// How a density that is known at every point becomes a grid. Private to the builtin volumes.
namespace bruma::scene {

/// Centre of sample i of n when the n samples share the interval [-1, 1] evenly.
inline double centre_in_unit(int i, int n) {
    return (i + 0.5) / n * 2.0 - 1.0;
}

/// Centre of sample i of n, counted in samples from the middle of the grid.
inline double centre_in_samples(int i, int n) {
    return i + 0.5 - 0.5 * n;
}

/// [0, 1] to 0..255, rounded to the nearest.
inline std::uint8_t byte_of_share(double share) {
    return std::uint8_t(std::floor(std::clamp(share, 0.0, 1.0) * 255.0 + 0.5));
}

/// A grid without samples yet; `finish_builtin` completes it.
inline std::shared_ptr<VolumeGrid> empty_builtin(std::string name, glm::ivec3 size, VoxelType type, double spacing) {
    auto grid = std::make_shared<VolumeGrid>();
    grid->name = std::move(name);
    grid->size = size;
    grid->type = type;
    grid->spacing = glm::dvec3(spacing);
    grid->voxels.resize(grid->voxel_count() * bytes_per_voxel(type));
    return grid;
}

/// Fills a grid slice by slice on all cores from `density(i, j, k)`, a double that depends on the indices alone, so
/// that the samples do not depend on the number of cores. uint8 grids take densities in [0, 1].
template <class Density>
std::shared_ptr<const VolumeGrid> sample_builtin(std::string name, glm::ivec3 size, VoxelType type, double spacing,
                                                 const Density& density) {
    const auto grid = empty_builtin(std::move(name), size, type, spacing);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(grid->voxels.data());
    auto* const floats = reinterpret_cast<float*>(grid->voxels.data());
    tbb::parallel_for(0, size.z, [&](int k) {
        std::size_t at = std::size_t(k) * size.y * size.x;
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i, ++at) {
                if (type == VoxelType::uint8) {
                    bytes[at] = byte_of_share(density(i, j, k));
                } else {
                    floats[at] = float(density(i, j, k));
                }
            }
        }
    });
    finish_grid(*grid);
    return grid;
}

}  // namespace bruma::scene
