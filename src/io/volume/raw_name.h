#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "scene/volume/volume.h"

namespace bruma::io {

/// Voxel type of a word: the words of scene::VoxelType and their usual short forms (u8, uchar, i16, short, f32, ...).
std::optional<scene::VoxelType> voxel_type_of_word(std::string_view word);

/// What a file name says of its content, as in 'name_256x256x128_uint16_be_1x1x2mm.raw': words between '_', '-' or
/// blanks; size as NXxNYxNZ, a type, 'be' or 'le' after either, spacing with 'mm' or 'um' behind it. Parts the name
/// does not say stay empty; 'byte', 'char', 'short' and 'float' are plain words beside another type. Throws InputError
/// when it says two sizes or types, or a type that is not read.
scene::VolumeSource layout_from_name(const std::filesystem::path& path);

/// The stem of the name without the words that `layout_from_name` understands; never empty and without '.', so that it
/// can be a node's name and a word of a --set path.
std::string make_grid_name(const std::filesystem::path& path);

}  // namespace bruma::io
