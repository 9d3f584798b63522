#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

/// Tileable noise of clouds, over p in [0,1)^3. `cells` is the number of lattice cells along an edge of the tile;
/// `stream` chooses one of many lattices. Real is double, or float to see what single precision loses.
namespace bruma::reference {

template <class Real>
using Vec3 = glm::vec<3, Real, glm::defaultp>;
template <class Real>
using Vec4 = glm::vec<4, Real, glm::defaultp>;

/// Gradient noise (Perlin, "Improving Noise", 2002) in about [-1.04, 1.04].
template <class Real>
Real perlin(const Vec3<Real>& p, int cells, std::uint32_t stream);

/// Octaves with twice the cells and half the amplitude each, on streams of their own, mapped to [0,1].
template <class Real>
Real perlin_octaves(const Vec3<Real>& p, int cells, int octaves, std::uint32_t stream);

/// One minus the distance to the nearest feature point in cells, at least 0 (Worley 1996, inverted).
template <class Real>
Real worley(const Vec3<Real>& p, int cells, std::uint32_t stream);

/// Three octaves weighted 0.625, 0.25, 0.125, and two weighted 0.75, 0.25, on consecutive streams.
template <class Real>
Real worley_octaves3(const Vec3<Real>& p, int cells, std::uint32_t stream);
template <class Real>
Real worley_octaves2(const Vec3<Real>& p, int cells, std::uint32_t stream);

/// Texel of the shape texture: Perlin noise lifted by Worley noise ("Perlin-Worley", Schneider 2015) in R, Worley noise
/// at rising frequencies in G, B, A. Sampled at texel centres, size^3 texels; size is a power of two.
template <class Real>
Vec4<Real> shape_texel(const glm::ivec3& texel, int size = 128);
/// Texel of the detail texture: Worley noise at rising frequencies.
template <class Real>
Vec3<Real> detail_texel(const glm::ivec3& texel, int size = 32);

/// A cube of texels that repeats in all directions, x fastest.
struct NoiseTexture {
    int size = 0;      ///< texels along an edge
    int channels = 0;  ///< 1 to 4
    std::vector<float> texels;

    const float* texel(int i, int j, int k) const {
        return &texels[std::size_t(channels) * ((std::size_t(k) * size + j) * size + i)];
    }
    /// Trilinear between texel centres, p in tiles; channels that are not there are 0.
    glm::dvec4 sample(const glm::dvec3& p) const;
};

NoiseTexture make_shape_noise(int size = 128);
NoiseTexture make_detail_noise(int size = 32);
/// The texels as 8-bit textures hold them: rounded to the nearest of 256 values.
NoiseTexture rounded_to_8_bits(NoiseTexture texture);

/// Low-frequency base of a cloud from the four shape channels, in [0,1]: remap(r, F - 1, 1, 0, 1) with F the Worley
/// octaves 0.625 g + 0.25 b + 0.125 a.
double base_shape(const glm::dvec4& shape);
/// Octaves of the three detail channels.
double detail_octaves(const glm::dvec3& detail);

/// One channel instead of four or three. The detail is the same field; the base is another one, since it is no linear
/// function of the channels and filtering comes after packing.
NoiseTexture packed_shape(const NoiseTexture& shape);
NoiseTexture packed_detail(const NoiseTexture& detail);

}  // namespace bruma::reference
