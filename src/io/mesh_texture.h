#pragma once
#include <filesystem>
#include <memory>

#include "scene/mesh_data.h"

namespace bruma::io {

/// Largest width and height of a texture: what every OpenGL 4.5 machine takes.
constexpr int most_texture_texels = 16384;

/// Reads a picture of eight bits (grey, palette or colour; .png, .jpg, .bmp, .tga and others) or sixteen (.png) as a
/// texture. Throws InputError for what cannot be read and what is larger than the limit.
std::shared_ptr<const scene::MeshTexture> load_texture(const std::filesystem::path& path);

}  // namespace bruma::io
