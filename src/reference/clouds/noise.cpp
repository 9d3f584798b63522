#include "reference/clouds/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/integer_hash.h"

namespace bruma::reference {
namespace {

constexpr std::array<std::array<int, 3>, 16> gradients{{{1, 1, 0},
                                                        {-1, 1, 0},
                                                        {1, -1, 0},
                                                        {-1, -1, 0},
                                                        {1, 0, 1},
                                                        {-1, 0, 1},
                                                        {1, 0, -1},
                                                        {-1, 0, -1},
                                                        {0, 1, 1},
                                                        {0, -1, 1},
                                                        {0, 1, -1},
                                                        {0, -1, -1},
                                                        {1, 1, 0},
                                                        {-1, 1, 0},
                                                        {0, -1, 1},
                                                        {0, -1, -1}}};

template <class Real>
Real fade(Real t) {
    return t * t * t * (t * (t * Real(6) - Real(15)) + Real(10));
}

template <class Real>
Real between(Real a, Real b, Real q) {
    return a + q * (b - a);
}

template <class Real>
Real saturate(Real v) {
    return std::min(Real(1), std::max(Real(0), v));
}

/// Where a point lies on a lattice: the cell, and the offset in it in [0,1)^3.
template <class Real>
struct LatticePlace {
    glm::ivec3 cell;
    Vec3<Real> offset;
    LatticePlace(const Vec3<Real>& p, int cells) {
        const Vec3<Real> at = p * Real(cells);
        const Vec3<Real> low = glm::floor(at);
        cell = glm::ivec3(low);
        offset = at - low;
    }
};

/// Centre of a texel in the tile; exact when the size is a power of two.
template <class Real>
Vec3<Real> texel_centre(const glm::ivec3& texel, int size) {
    return (Vec3<Real>(texel) + Real(0.5)) * (Real(1) / Real(size));
}

}  // namespace

template <class Real>
Real perlin(const Vec3<Real>& p, int cells, std::uint32_t stream) {
    const LatticePlace<Real> place(p, cells);
    const Vec3<Real>& t = place.offset;
    Real corner[2][2][2];
    for (int dz = 0; dz < 2; ++dz) {
        for (int dy = 0; dy < 2; ++dy) {
            for (int dx = 0; dx < 2; ++dx) {
                const auto hash = cell_hash(place.cell.x + dx, place.cell.y + dy, place.cell.z + dz, cells, stream);
                const auto& gradient = gradients[hash[0] >> 28U];
                corner[dz][dy][dx] = Real(gradient[0]) * (t.x - Real(dx)) + Real(gradient[1]) * (t.y - Real(dy)) +
                                     Real(gradient[2]) * (t.z - Real(dz));
            }
        }
    }
    const Vec3<Real> q(fade(t.x), fade(t.y), fade(t.z));
    Real plane[2];
    for (int dz = 0; dz < 2; ++dz) {
        plane[dz] = between(between(corner[dz][0][0], corner[dz][0][1], q.x),
                            between(corner[dz][1][0], corner[dz][1][1], q.x), q.y);
    }
    return between(plane[0], plane[1], q.z);
}

template <class Real>
Real perlin_octaves(const Vec3<Real>& p, int cells, int octaves, std::uint32_t stream) {
    Real sum = 0;
    Real amplitudes = 0;
    for (int octave = 0; octave < octaves; ++octave) {
        const Real amplitude = Real(1) / Real(1 << octave);
        sum += amplitude * perlin(p, cells << octave, stream + std::uint32_t(octave));
        amplitudes += amplitude;
    }
    return saturate(Real(0.5) + Real(0.5) * sum / amplitudes);
}

template <class Real>
Real worley(const Vec3<Real>& p, int cells, std::uint32_t stream) {
    const LatticePlace<Real> place(p, cells);
    const Vec3<Real>& t = place.offset;
    // Per axis and neighbour -1, 0, 1: the index to hash, and the square of the least distance to any point in there.
    std::uint32_t index[3][3];
    Real least[3][3];
    for (int axis = 0; axis < 3; ++axis) {
        for (int d = -1; d <= 1; ++d) {
            index[axis][d + 1] = wrapped_cell(place.cell[axis] + d, cells);
        }
        least[axis][0] = t[axis] * t[axis];
        least[axis][1] = 0;
        least[axis][2] = (Real(1) - t[axis]) * (Real(1) - t[axis]);
    }
    // A point outside the 27 cells is at least one cell away, where the noise is 0: the search is exact. Offsets are
    // relative to the cell, so that floats lose nothing far from the origin of the tile. The cell itself comes first,
    // so that most of its neighbours need no hash.
    Real nearest = 1;
    constexpr int order[3] = {0, -1, 1};
    for (const int dz : order) {
        for (const int dy : order) {
            for (const int dx : order) {
                if (least[0][dx + 1] + least[1][dy + 1] + least[2][dz + 1] > nearest) {
                    continue;
                }
                const auto hash = pcg3d(index[0][dx + 1], index[1][dy + 1], index[2][dz + 1] + (stream << 16U));
                const Vec3<Real> feature(Real(unit_interval(hash[0])), Real(unit_interval(hash[1])),
                                         Real(unit_interval(hash[2])));
                const Vec3<Real> apart = Vec3<Real>(glm::ivec3(dx, dy, dz)) + feature - t;
                nearest = std::min(nearest, glm::dot(apart, apart));
            }
        }
    }
    return Real(1) - std::sqrt(nearest);
}

template <class Real>
Real worley_octaves3(const Vec3<Real>& p, int cells, std::uint32_t stream) {
    return Real(0.625) * worley(p, cells, stream) + Real(0.25) * worley(p, 2 * cells, stream + 1) +
           Real(0.125) * worley(p, 4 * cells, stream + 2);
}

template <class Real>
Real worley_octaves2(const Vec3<Real>& p, int cells, std::uint32_t stream) {
    return Real(0.75) * worley(p, cells, stream) + Real(0.25) * worley(p, 2 * cells, stream + 1);
}

template <class Real>
Vec4<Real> shape_texel(const glm::ivec3& texel, int size) {
    const Vec3<Real> p = texel_centre<Real>(texel, size);
    const Real lower = worley_octaves3(p, 8, 16);
    return {lower + perlin_octaves(p, 8, 3, 0) * (Real(1) - lower), worley_octaves3(p, 8, 32),
            worley_octaves3(p, 16, 48), worley_octaves2(p, 32, 64)};
}

template <class Real>
Vec3<Real> detail_texel(const glm::ivec3& texel, int size) {
    const Vec3<Real> p = texel_centre<Real>(texel, size);
    return {worley_octaves3(p, 2, 80), worley_octaves3(p, 4, 96), worley_octaves2(p, 8, 112)};
}

template float perlin(const Vec3<float>&, int, std::uint32_t);
template double perlin(const Vec3<double>&, int, std::uint32_t);
template float perlin_octaves(const Vec3<float>&, int, int, std::uint32_t);
template double perlin_octaves(const Vec3<double>&, int, int, std::uint32_t);
template float worley(const Vec3<float>&, int, std::uint32_t);
template double worley(const Vec3<double>&, int, std::uint32_t);
template float worley_octaves3(const Vec3<float>&, int, std::uint32_t);
template double worley_octaves3(const Vec3<double>&, int, std::uint32_t);
template float worley_octaves2(const Vec3<float>&, int, std::uint32_t);
template double worley_octaves2(const Vec3<double>&, int, std::uint32_t);
template Vec4<float> shape_texel(const glm::ivec3&, int);
template Vec4<double> shape_texel(const glm::ivec3&, int);
template Vec3<float> detail_texel(const glm::ivec3&, int);
template Vec3<double> detail_texel(const glm::ivec3&, int);

}  // namespace bruma::reference
