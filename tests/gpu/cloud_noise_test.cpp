// Shelf: independent reference. Noise textures made by the GPU against their definition in double precision.
#include "reference/clouds/noise.h"

#include <cmath>
#include <numeric>

#include "drawing.h"
#include "gl/texture.h"

namespace bruma::render {
namespace {

class CloudNoise : public Drawing {
  protected:
    /// All texels of a cube, four floats each, first channel first.
    std::vector<float> made(int size, bool detail, GLenum format, const char* glsl_format) {
        gl::Texture texture = gl::Texture::make_3d("cloud noise under test", format, glm::ivec3(size));
        gl::Program& program = shaders().get("clouds/cloud_noise.comp", {{"TEXEL_FORMAT", glsl_format}});
        program.use();
        program.set("detail", detail ? 1 : 0);
        glBindImageTexture(0, texture.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, format);
        const auto groups = GLuint(size + 7) / 8;
        glDispatchCompute(groups, groups, GLuint(size));
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        std::vector<float> texels(std::size_t(4) * size * size * size);
        texture.download({GL_RGBA, GL_FLOAT}, texels.size() * sizeof(float), texels.data());
        return texels;
    }
};

struct Comparison {
    double largest = 0.0;  ///< difference
    int codes_apart = 0;   ///< 8-bit codes that differ
    int largest_code = 0;  ///< by so many steps
};

/// Of all texels, or of those in every `stride`-th slice.
Comparison compare(const std::vector<float>& found, int size, bool detail, int stride) {
    Comparison result;
    for (int k = 0; k < size; k += stride) {
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                const glm::ivec3 at(i, j, k);
                const glm::dvec4 exact = detail ? glm::dvec4(reference::detail_texel<double>(at, size), 1.0)
                                                : reference::shape_texel<double>(at, size);
                const float* texel = &found[4 * ((std::size_t(k) * size + j) * size + i)];
                for (int channel = 0; channel < 4; ++channel) {
                    result.largest = std::max(result.largest, std::abs(texel[channel] - exact[channel]));
                    const int apart = std::abs(int(std::lround(255.0F * texel[channel])) -
                                               int(std::floor(255.0 * exact[channel] + 0.5)));
                    result.codes_apart += apart > 0 ? 1 : 0;
                    result.largest_code = std::max(result.largest_code, apart);
                }
            }
        }
    }
    return result;
}

TEST_F(CloudNoise, FloatTexelsAreTheDefinition) {
    // Single precision loses 1.4e-7; square roots may be off by three units in the last place on some GPUs.
    const Comparison shape = compare(made(64, false, GL_RGBA32F, "rgba32f"), 64, false, 8);
    EXPECT_LE(shape.largest, 5e-7);
    const Comparison detail = compare(made(32, true, GL_RGBA32F, "rgba32f"), 32, true, 2);
    EXPECT_LE(detail.largest, 5e-7);
    report("largest difference of shape texels", shape.largest);
    report("largest difference of detail texels", detail.largest);
}

TEST_F(CloudNoise, ByteTexelsAreAtMostOneCodeAway) {
    // The shape texture as it is used, every 32nd slice of it.
    const Comparison shape = compare(made(128, false, GL_RGBA8, "rgba8"), 128, false, 32);
    EXPECT_LE(shape.largest_code, 1);
    // Rounding to nearest, not down: of 262144 codes some three lie at a half and may go either way.
    EXPECT_LE(shape.codes_apart, 40);
    const Comparison detail = compare(made(32, true, GL_RGBA8, "rgba8"), 32, true, 2);
    EXPECT_LE(detail.largest_code, 1);
    report("8-bit codes of shape texels that differ, of 262144", shape.codes_apart);
}

}  // namespace
}  // namespace bruma::render
