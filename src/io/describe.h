#pragma once
#include <string>

#include "scene/volume.h"

namespace bruma::io {

/// What a file holds, for `bruma info`: several lines of text. A volume: size, type, spacing, extent, range, mean, a
/// histogram, and who said each part of the layout; when nobody did, the likeliest layouts; a mesh: see mesh_text.h; a
/// scene: its nodes and lights. Throws InputError for what cannot be read at all.
std::string describe_file(const std::string& argument, const scene::VolumeSource& hints);

}  // namespace bruma::io
