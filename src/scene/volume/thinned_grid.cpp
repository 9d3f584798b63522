#include "scene/volume/thinned_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace bruma::scene {
namespace {

/// Samples [first, behind) of the data that sample n of `coarse` stands for.
struct Stretch {
    int first, behind;
};
Stretch stretch_of(int n, int coarse, int fine) {
    const auto border = [&](int at) { return int(std::int64_t(at) * fine / coarse); };
    return {border(n), border(n + 1)};
}

template <class Sample>
void thin(const VolumeGrid& grid, std::span<const Sample> samples, VolumeGrid& out) {
    auto* const means = reinterpret_cast<Sample*>(out.voxels.data());
    tbb::parallel_for(0, out.size.z, [&](int k) {
        const Stretch z = stretch_of(k, out.size.z, grid.size.z);
        for (int j = 0; j < out.size.y; ++j) {
            const Stretch y = stretch_of(j, out.size.y, grid.size.y);
            for (int i = 0; i < out.size.x; ++i) {
                const Stretch x = stretch_of(i, out.size.x, grid.size.x);
                double sum = 0.0;
                int present = 0, all = 0;
                for (int c = z.first; c < z.behind; ++c) {
                    for (int b = y.first; b < y.behind; ++b) {
                        const std::size_t line = (std::size_t(c) * grid.size.y + b) * grid.size.x;
                        for (int a = x.first; a < x.behind; ++a, ++all) {
                            if (!grid.is_absent(line + a)) {
                                sum += double(samples[line + a]);
                                ++present;
                            }
                        }
                    }
                }
                const std::size_t at = (std::size_t(k) * out.size.y + j) * out.size.x + i;
                if (2 * present < all || present == 0) {
                    out.absent[at] = 1;
                    means[at] = Sample(grid.suggested_window[0]);
                } else {
                    const double mean = sum / present;
                    means[at] = Sample(grid.type == VoxelType::float32 ? mean : std::round(mean));
                }
            }
        }
    });
}

}  // namespace

glm::ivec3 thinned_size(glm::ivec3 size, glm::ivec3 factors) {
    return (size + factors - 1) / factors;
}

std::shared_ptr<const VolumeGrid> thinned(const VolumeGrid& grid, glm::ivec3 factors) {
    auto out = std::make_shared<VolumeGrid>();
    out->name = grid.name;
    out->size = thinned_size(grid.size, factors);
    out->type = grid.type;
    out->spacing = grid.extent() / glm::dvec3(out->size);
    out->smallest = grid.smallest;
    out->largest = grid.largest;
    out->core = grid.core;
    out->suggested_window = grid.suggested_window;
    out->fills = grid.fills;
    out->nonfinite = grid.nonfinite;
    out->voxels.resize(out->voxel_count() * bytes_per_voxel(out->type));
    out->absent.resize(grid.absent.empty() ? 0 : out->voxel_count());
    visit_voxels(grid, [&](auto samples) { thin(grid, samples, *out); });
    return out;
}

}  // namespace bruma::scene
