#include "render/volume/volume_texture.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"

namespace bruma::render {
namespace {

/// Calls `fill(z, slice)` for batches of slices and uploads them: a batch is a few megabytes, never the whole volume.
template <class Texel, class Fill>
void upload_in_batches(gl::Texture& texture, glm::ivec3 size, gl::PixelFormat format, std::size_t texels_per_voxel,
                       const Fill& fill) {
    const std::size_t slice = std::size_t(size.x) * size.y * texels_per_voxel;
    const int batch = int(std::clamp<std::size_t>((std::size_t(8) << 20) / (slice * sizeof(Texel)), 1, size.z));
    std::vector<Texel> texels(slice * batch);
    for (int first = 0; first < size.z; first += batch) {
        const int count = std::min(batch, size.z - first);
        tbb::parallel_for(0, count, [&](int n) { fill(first + n, texels.data() + slice * n); });
        texture.upload_slices(first, count, format, texels.data());
    }
}

void check_edges(const scene::VolumeGrid& grid) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &most);
    if (std::max({grid.size.x, grid.size.y, grid.size.z}) > most) {
        throw MachineError(
            fmt::format("{}: {} x {} x {} samples, but this driver takes at most {} along an edge; "
                        "cut or thin out the volume",
                        grid.name, grid.size.x, grid.size.y, grid.size.z, most));
    }
}

/// Texels of absent samples and the furthest of others: interpolation with a weight of 1e-20 and more tells them apart.
constexpr float texel_of_absent = -1e36F;
constexpr double furthest_texel = 1e7;

void upload_floats(const scene::VolumeGrid& grid, VolumeTexture& result) {
    result.texture = gl::Texture::make_3d(grid.name + ": voxels", GL_R32F, grid.size);
    result.holes = !grid.absent.empty();
    // A constant of 1e30 takes the 1 up that was added to it.
    const double width = result.value_of_one > result.value_of_zero ? result.value_of_one - result.value_of_zero : 1.0;
    const std::size_t slice = std::size_t(grid.size.x) * grid.size.y;
    scene::visit_voxels(grid, [&](auto samples) {
        upload_in_batches<float>(result.texture, grid.size, {GL_RED, GL_FLOAT}, 1, [&](int z, float* out) {
            for (std::size_t n = 0; n < slice; ++n) {
                const std::size_t at = slice * z + n;
                const double texel = (double(samples[at]) - result.value_of_zero) / width;
                out[n] =
                    grid.is_absent(at) ? texel_of_absent : float(std::clamp(texel, -furthest_texel, furthest_texel));
            }
        });
    });
}

}  // namespace

glm::dvec2 u_from_voxel(const VolumeTexture& voxels, std::array<double, 2> window) {
    constexpr double where_floats_end = 1e30;
    const glm::dvec2 map = glm::dvec2(voxels.value_of_one - voxels.value_of_zero, voxels.value_of_zero - window[0]) /
                           (window[1] - window[0]);
    return map * std::min(1.0, where_floats_end / std::max({1e-300, std::abs(map.x), std::abs(map.y)}));
}

bool filters_8bit_texels_precisely() {
    // A gathered half-way texel between 0 and 1/255, drawn into a float pixel by blitting cannot filter floats, so the
    // question is put to the sampler by a compute shader of three lines.
    static const char* const source = R"(#version 450 core
layout(local_size_x = 1) in;
layout(binding = 0) uniform sampler3D two_texels;
layout(std430, binding = 0) buffer Answer { float between; };
void main() { between = textureLod(two_texels, vec3(0.5, 0.5, 0.5), 0.0).x * 255.0; })";
    gl::Texture texture = gl::Texture::make_3d("8-bit filter probe", GL_R8, {2, 1, 1});
    const std::uint8_t texels[2] = {0, 1};
    texture.upload({GL_RED, GL_UNSIGNED_BYTE}, texels);
    const GLuint program = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &source);
    GLuint buffer = 0;
    glCreateBuffers(1, &buffer);
    float answer = 0.0F;
    glNamedBufferStorage(buffer, sizeof answer, &answer, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffer);
    texture.bind(0);
    glUseProgram(program);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffer, 0, sizeof answer, &answer);
    glUseProgram(0);
    glDeleteBuffers(1, &buffer);
    glDeleteProgram(program);
    return std::abs(answer - 0.5F) < 0.1F;
}

GLenum voxel_format(const scene::VolumeGrid& grid, GLenum byte_format) {
    if (scene::bytes_per_voxel(grid.type) == 1) {
        return byte_format;
    }
    return grid.type == scene::VoxelType::float32 || !grid.absent.empty() ? GL_R32F : GL_R16;
}

VolumeTexture make_volume_texture(const scene::VolumeGrid& grid) {
    using scene::VoxelType;
    check_edges(grid);
    VolumeTexture result;
    const std::size_t slice = std::size_t(grid.size.x) * grid.size.y;
    const auto make = [&](GLenum format) { return gl::Texture::make_3d(grid.name + ": voxels", format, grid.size); };
    switch (grid.type) {
        case VoxelType::uint8:
        case VoxelType::int8: {
            const int low = grid.type == VoxelType::int8 ? -128 : 0;
            result.value_of_zero = low;
            result.value_of_one = low + 255;
            const auto* bytes = reinterpret_cast<const std::uint8_t*>(grid.voxels.data());
            const std::uint8_t flip = grid.type == VoxelType::int8 ? 0x80 : 0x00;  // two's complement to offset binary
            if (filters_8bit_texels_precisely()) {
                result.texture = make(GL_R8);
                upload_in_batches<std::uint8_t>(result.texture, grid.size, {GL_RED, GL_UNSIGNED_BYTE}, 1,
                                                [&](int z, std::uint8_t* out) {
                                                    for (std::size_t n = 0; n < slice; ++n) {
                                                        out[n] = std::uint8_t(bytes[slice * z + n] ^ flip);
                                                    }
                                                });
            } else {
                result.texture = make(GL_R16);
                upload_in_batches<std::uint16_t>(result.texture, grid.size, {GL_RED, GL_UNSIGNED_SHORT}, 1,
                                                 [&](int z, std::uint16_t* out) {
                                                     for (std::size_t n = 0; n < slice; ++n) {
                                                         out[n] = std::uint16_t((bytes[slice * z + n] ^ flip) * 257);
                                                     }
                                                 });
            }
            break;
        }
        case VoxelType::uint16:
        case VoxelType::int16: {
            const int low = grid.type == VoxelType::int16 ? -32768 : 0;
            result.value_of_zero = low;
            result.value_of_one = low + 65535;
            if (!grid.absent.empty()) {
                upload_floats(grid, result);
                break;
            }
            const auto* words = reinterpret_cast<const std::uint16_t*>(grid.voxels.data());
            const std::uint16_t flip = grid.type == VoxelType::int16 ? 0x8000 : 0x0000;
            result.texture = make(GL_R16);
            upload_in_batches<std::uint16_t>(result.texture, grid.size, {GL_RED, GL_UNSIGNED_SHORT}, 1,
                                             [&](int z, std::uint16_t* out) {
                                                 for (std::size_t n = 0; n < slice; ++n) {
                                                     out[n] = std::uint16_t(words[slice * z + n] ^ flip);
                                                 }
                                             });
            break;
        }
        case VoxelType::float32: {
            // Mapped to [0,1] in double, so that neither 1e30 nor a large offset costs digits in the shader.
            // Outliers lie beyond.
            const double width = grid.core[1] > grid.core[0] ? grid.core[1] - grid.core[0] : 1.0;
            result.value_of_zero = grid.core[0];
            result.value_of_one = grid.core[0] + width;
            upload_floats(grid, result);
            break;
        }
    }
    return result;
}

namespace {

/// Twice the difference per voxel along each axis at sample (x, y, z).
template <class T>
glm::dvec3 doubled_differences(const scene::VolumeGrid& grid, const T* samples, int x, int y, int z) {
    const glm::ivec3 size = grid.size;
    const std::size_t strides[3] = {1, std::size_t(size.x), std::size_t(size.x) * size.y};
    const std::size_t index = (std::size_t(z) * size.y + y) * size.x + x;
    const T* here = samples + index;
    const int at[3] = {x, y, z};
    glm::dvec3 result(0.0);
    for (int k = 0; k < 3; ++k) {
        if (size[k] == 1) {
            continue;
        }
        const bool first = at[k] == 0 || grid.is_absent(index - strides[k]);
        const bool last = at[k] == size[k] - 1 || grid.is_absent(index + strides[k]);
        const double difference =
            double(last ? *here : *(here + strides[k])) - double(first ? *here : *(here - strides[k]));
        result[k] = first || last ? 2.0 * difference : difference;
    }
    return result;
}

/// Half floats hold 11 digits of any gradient from 4e-6 of the unit's 16-fold per voxel on; steeper ones than 65504
/// units keep their direction.
void upload_half_floats(const scene::VolumeGrid& grid, GradientTexture& result) {
    constexpr double largest_half = 65504.0;
    const double core = grid.core[1] - grid.core[0];
    const double range = grid.largest - grid.smallest;
    const double unit = std::min(range / 32768.0, core / 16.0);
    result.difference_per_texel = unit > 0.0 ? unit : 1.0;
    scene::visit_voxels(grid, [&](auto samples) {
        upload_in_batches<float>(result.texture, grid.size, {GL_RGBA, GL_FLOAT}, 4, [&](int z, float* out) {
            for (int y = 0; y < grid.size.y; ++y) {
                for (int x = 0; x < grid.size.x; ++x) {
                    glm::dvec3 d =
                        doubled_differences(grid, samples.data(), x, y, z) * (0.5 / result.difference_per_texel);
                    const double most = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
                    d *= most > largest_half ? largest_half / most : 1.0;
                    for (int k = 0; k < 3; ++k) {
                        *out++ = float(d[k]);
                    }
                    *out++ = 0.0F;
                }
            }
        });
    });
}

}  // namespace

GradientStorage gradient_storage(const scene::Volume& volume) {
    constexpr double well_resolved = 16.0;  // ranges of shading in the data's: a gradient then has 11 bits of 15
    const scene::VolumeGrid& grid = **volume.grid;
    const bool fine =
        !grid.has_outliers() && well_resolved * scene::shading_range(volume) >= grid.largest - grid.smallest;
    return fine || scene::bytes_per_voxel(grid.type) == 1 ? GradientStorage::share_of_range : GradientStorage::floating;
}

GLenum gradient_format(const scene::VolumeGrid& grid, GradientStorage storage) {
    if (scene::bytes_per_voxel(grid.type) == 1) {
        return GL_RGB10_A2;
    }
    return storage == GradientStorage::floating ? GL_RGBA16F : GL_RGBA16_SNORM;
}

GradientTexture make_gradient_texture(const scene::VolumeGrid& grid, GradientStorage storage) {
    check_edges(grid);
    GradientTexture result;
    const std::string label = grid.name + ": gradients";
    if (scene::bytes_per_voxel(grid.type) == 1) {
        // Doubled differences of bytes are whole numbers in [-510, 510]: ten bits hold them without loss.
        result.texture = gl::Texture::make_3d(label, gradient_format(grid, storage), grid.size);
        result.texel_of_zero = 511.0 / 1023.0;
        result.difference_per_texel = 1023.0 / 2.0;
        scene::visit_voxels(grid, [&](auto samples) {
            upload_in_batches<std::uint32_t>(
                result.texture, grid.size, {GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV}, 1,
                [&](int z, std::uint32_t* out) {
                    for (int y = 0; y < grid.size.y; ++y) {
                        for (int x = 0; x < grid.size.x; ++x) {
                            const glm::ivec3 d(doubled_differences(grid, samples.data(), x, y, z) + 511.0);
                            *out++ = std::uint32_t(d.x) | std::uint32_t(d.y) << 10 | std::uint32_t(d.z) << 20;
                        }
                    }
                });
        });
        return result;
    }
    result.texture = gl::Texture::make_3d(label, gradient_format(grid, storage), grid.size);
    if (storage == GradientStorage::floating) {
        upload_half_floats(grid, result);
        return result;
    }
    const double range = grid.largest > grid.smallest ? grid.largest - grid.smallest : 1.0;
    result.difference_per_texel = range;
    scene::visit_voxels(grid, [&](auto samples) {
        upload_in_batches<std::int16_t>(
            result.texture, grid.size, {GL_RGBA, GL_SHORT}, 4, [&](int z, std::int16_t* out) {
                for (int y = 0; y < grid.size.y; ++y) {
                    for (int x = 0; x < grid.size.x; ++x) {
                        const glm::dvec3 share = doubled_differences(grid, samples.data(), x, y, z) * (0.5 / range);
                        for (int k = 0; k < 3; ++k) {
                            *out++ = std::int16_t(std::lround(32767.0 * std::clamp(share[k], -1.0, 1.0)));
                        }
                        *out++ = 0;
                    }
                }
            });
    });
    return result;
}

}  // namespace bruma::render
