#pragma once
#include <array>

#include "gl/texture.h"
#include "scene/volume/volume.h"

namespace bruma::render {

/// A grid on the GPU: texels stand for data values by one affine map, those in [0,1] for all but outliers.
struct VolumeTexture {
    gl::Texture texture;
    double value_of_zero = 0.0, value_of_one = 1.0;  ///< data values of texels 0 and 1
    /// Some samples are absent: their texels lie so far below all others that whatever is interpolated with one of them
    /// does too, and is told by that (shaders/volume/absent.glsl).
    bool holes = false;
};

/// The map from texels to u, in which `window` is [0, 1]: u = x * texel + y. Finite also for a window that is tiny
/// beside the data: a step then, which it stays, at its place.
glm::dvec2 u_from_voxel(const VolumeTexture& voxels, std::array<double, 2> window);

/// Uploads a grid. 8-bit data take 16-bit texels where the driver filters 8-bit texels with 8-bit arithmetic, which
/// would lose the values in between; 16-bit data with absent samples take floats.
/// An edge that the driver does not allow makes it throw MachineError.
VolumeTexture make_volume_texture(const scene::VolumeGrid& grid);

/// How gradients are kept. Differences of bytes are exact either way; others are shares of the data's range in 16 bits,
/// or half floats where shading asks for differences that are small beside it.
enum class GradientStorage { share_of_range, floating };
GradientStorage gradient_storage(const scene::Volume& volume);

/// Gradients of a grid on the GPU, central differences per voxel along each axis and one-sided ones on the border and
/// beside absent samples, so that filtering them linearly gives central differences of the filtered data exactly.
struct GradientTexture {
    gl::Texture texture;
    double texel_of_zero = 0.0;         ///< texel that stands for no difference
    double difference_per_texel = 1.0;  ///< difference per voxel, in data values, of a texel of 1 above it
};
GLenum gradient_format(const scene::VolumeGrid& grid, GradientStorage storage);
GradientTexture make_gradient_texture(const scene::VolumeGrid& grid, GradientStorage storage);

/// Of the texture that holds a grid's samples; `byte_format`, GL_R8 or GL_R16, where they have 8 bits.
GLenum voxel_format(const scene::VolumeGrid& grid, GLenum byte_format);

/// Whether sampling between two neighbouring 8-bit texel values gives values in between; measured, once per context.
bool filters_8bit_texels_precisely();

}  // namespace bruma::render
