#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/clouds/noise.h"

namespace bruma::reference {
namespace {

template <class TexelOf>
NoiseTexture made(int size, int channels, const TexelOf& texel_of) {
    NoiseTexture texture{size, channels, std::vector<float>(std::size_t(channels) * size * size * size)};
    tbb::parallel_for(0, size, [&](int k) {
        std::size_t n = std::size_t(k) * size * size * channels;
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const auto value = texel_of(glm::ivec3(i, j, k));
                for (int channel = 0; channel < channels; ++channel) {
                    texture.texels[n++] = float(value[channel]);
                }
            }
        }
    });
    return texture;
}

/// The two texels around a coordinate in tiles, and how far it lies from the first to the second.
struct Neighbours {
    int first, second;
    double share;
    Neighbours(double p, int size) {
        const double at = (p - std::floor(p)) * size - 0.5;
        const double low = std::floor(at);
        share = at - low;
        first = (int(low) + size) % size;
        second = (first + 1) % size;
    }
};

}  // namespace

glm::dvec4 NoiseTexture::sample(const glm::dvec3& p) const {
    const Neighbours x(p.x, size), y(p.y, size), z(p.z, size);
    glm::dvec4 result(0.0);
    const float* at[8] = {texel(x.first, y.first, z.first),   texel(x.second, y.first, z.first),
                          texel(x.first, y.second, z.first),  texel(x.second, y.second, z.first),
                          texel(x.first, y.first, z.second),  texel(x.second, y.first, z.second),
                          texel(x.first, y.second, z.second), texel(x.second, y.second, z.second)};
    for (int channel = 0; channel < channels; ++channel) {
        double along_x[4];
        for (int row = 0; row < 4; ++row) {
            const double low = at[std::size_t(2) * row][channel];
            along_x[row] = low + x.share * (at[std::size_t(2) * row + 1][channel] - low);
        }
        const double front = along_x[0] + y.share * (along_x[1] - along_x[0]);
        const double back = along_x[2] + y.share * (along_x[3] - along_x[2]);
        result[channel] = front + z.share * (back - front);
    }
    return result;
}

NoiseTexture make_shape_noise(int size) {
    return made(size, 4, [size](const glm::ivec3& texel) { return shape_texel<double>(texel, size); });
}

NoiseTexture make_detail_noise(int size) {
    return made(size, 3, [size](const glm::ivec3& texel) { return detail_texel<double>(texel, size); });
}

NoiseTexture rounded_to_8_bits(NoiseTexture texture) {
    for (float& value : texture.texels) {
        value = std::floor(255.0F * value + 0.5F) / 255.0F;
    }
    return texture;
}

double base_shape(const glm::dvec4& shape) {
    const double octaves = 0.625 * shape.g + 0.25 * shape.b + 0.125 * shape.a;
    return (shape.r - (octaves - 1.0)) / (2.0 - octaves);
}

double detail_octaves(const glm::dvec3& detail) {
    return 0.625 * detail.r + 0.25 * detail.g + 0.125 * detail.b;
}

NoiseTexture packed_shape(const NoiseTexture& shape) {
    return made(shape.size, 1, [&](const glm::ivec3& at) {
        const float* texel = shape.texel(at.x, at.y, at.z);
        return glm::dvec1(base_shape({texel[0], texel[1], texel[2], texel[3]}));
    });
}

NoiseTexture packed_detail(const NoiseTexture& detail) {
    return made(detail.size, 1, [&](const glm::ivec3& at) {
        const float* texel = detail.texel(at.x, at.y, at.z);
        return glm::dvec1(detail_octaves({texel[0], texel[1], texel[2]}));
    });
}

}  // namespace bruma::reference
