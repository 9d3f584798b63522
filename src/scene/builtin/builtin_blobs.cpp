#include <cmath>
#include <vector>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

/// w (1 - |p - centre|^2 / R^2)^2 inside its radius R, in [-1,1]^3.
struct Blob {
    double x, y, z, radius, weight;
};

/// 96 blobs that lie wholly within the ball of radius 0.8, from a 31-bit linear congruential generator.
std::vector<Blob> scattered_blobs() {
    std::uint32_t state = 12345;
    const auto random = [&state] {
        state = (state * 1103515245U + 12345U) & 0x7FFFFFFFU;
        return state / 2147483648.0;
    };
    std::vector<Blob> blobs;
    while (blobs.size() < 96) {
        Blob blob{};
        blob.x = random() * 2.0 - 1.0;
        blob.y = random() * 2.0 - 1.0;
        blob.z = random() * 2.0 - 1.0;
        blob.radius = 0.08 + 0.17 * random();
        blob.weight = 0.4 + 0.6 * random();
        const double room = 0.8 - blob.radius;
        if (blob.x * blob.x + blob.y * blob.y + blob.z * blob.z <= room * room) {
            blobs.push_back(blob);
        }
    }
    return blobs;
}

/// Samples of n over [-1,1] that may lie within `radius` of `position`: [first, last).
struct Range {
    int first, last;
};
Range touched(double position, double radius, int n) {
    return {std::max(0, int((position - radius + 1.0) * n / 2.0) - 1),
            std::min(n, int((position + radius + 1.0) * n / 2.0) + 2)};
}

}  // namespace

std::shared_ptr<const VolumeGrid> make_blobs() {
    constexpr int n = 256;
    const std::vector<Blob> blobs = scattered_blobs();
    const auto grid = empty_builtin("blobs", glm::ivec3(n), VoxelType::uint8, 1e-3);
    auto* const bytes = reinterpret_cast<std::uint8_t*>(grid->voxels.data());
    // Each slice adds the blobs in the same order, so that rounding does not depend on the number of cores.
    tbb::parallel_for(0, n, [&](int k) {
        std::vector<double> slice(std::size_t(n) * n, 0.0);
        for (const Blob& blob : blobs) {
            const Range ks = touched(blob.z, blob.radius, n);
            if (k < ks.first || k >= ks.last) {
                continue;
            }
            const Range js = touched(blob.y, blob.radius, n);
            const Range is = touched(blob.x, blob.radius, n);
            const double dz = centre_in_unit(k, n) - blob.z;
            for (int j = js.first; j < js.last; ++j) {
                const double dy = centre_in_unit(j, n) - blob.y;
                for (int i = is.first; i < is.last; ++i) {
                    const double dx = centre_in_unit(i, n) - blob.x;
                    const double distance2 = dx * dx + dy * dy + dz * dz;
                    const double t = std::max(0.0, 1.0 - distance2 / (blob.radius * blob.radius));
                    slice[std::size_t(j) * n + i] += blob.weight * t * t;
                }
            }
        }
        std::uint8_t* out = bytes + std::size_t(k) * n * n;
        for (const double density : slice) {
            *out++ = byte_of_share(density);
        }
    });
    finish_grid(*grid);
    return grid;
}

}  // namespace bruma::scene
