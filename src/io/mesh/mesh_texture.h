#pragma once
#include <filesystem>
#include <memory>

#include "scene/mesh/mesh_data.h"

namespace bruma::io {

/// Largest width and height of a texture: what every OpenGL 4.5 machine takes.
constexpr int most_texture_texels = 16384;

/// Reads a picture of eight or sixteen bits (grey, palette or colour; see raster_picture.h) as a texture. Throws
/// InputError for what cannot be read, for floating-point light and for what is larger than the limit.
std::shared_ptr<const scene::MeshTexture> load_texture(const std::filesystem::path& path);

}  // namespace bruma::io
