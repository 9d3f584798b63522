#pragma once
#include <array>
#include "gl/texture.h"
#include "scene/volume_grid.h"

namespace bruma::render {

/// A grid on the GPU: texels in [0,1] stand for data values by one affine map.
struct VolumeTexture {
    gl::Texture texture;
    double value_of_zero = 0.0, value_of_one = 1.0;  ///< data values of texels 0 and 1
};

/// The map from texels to u, in which `window` is [0, 1]: u = x * texel + y. Finite also for a window that is tiny
/// beside the data: a step then, which it stays, at its place.
glm::dvec2 u_from_voxel(const VolumeTexture& voxels, std::array<double, 2> window);

/// Uploads a grid. 8-bit data take 16-bit texels where the driver filters 8-bit texels with 8-bit arithmetic, which
/// would lose the values in between. Throws InputError when an edge is longer than the driver allows.
VolumeTexture make_volume_texture(const scene::VolumeGrid& grid);

/// Gradients of a grid on the GPU, central differences per voxel along each axis and one-sided ones on the border, so
/// that filtering them linearly gives central differences of the filtered data exactly.
struct GradientTexture {
    gl::Texture texture;
    double texel_of_zero = 0.0;         ///< texel that stands for no difference
    double difference_per_texel = 1.0;  ///< difference per voxel, in data values, of a texel of 1 above it
};
GradientTexture make_gradient_texture(const scene::VolumeGrid& grid);

/// Whether sampling between two neighbouring 8-bit texel values gives values in between; measured, once per context.
bool filters_8bit_texels_precisely();

}  // namespace bruma::render
