#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// What a file holds, for `bruma info`: several lines of text. A volume: size, type, spacing, extent, range, mean, a
/// histogram, and who said each part of the layout; when nobody did, the likeliest layouts; a mesh: see mesh_text.h; a
/// scene: its nodes and lights. `settings` (PATH=VALUE) and `preset_folders` are for scenes, as in open.h. Throws
/// InputError for what cannot be read at all, and for settings of what is no scene.
std::string describe_file(const std::string& argument, const scene::VolumeSource& hints,
                          std::span<const std::string> settings = {},
                          const std::vector<std::filesystem::path>& preset_folders = {});

}  // namespace bruma::io
