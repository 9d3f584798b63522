#pragma once
#include <string>

#include "scene/mesh/mesh_parts.h"

namespace bruma::io {

/// What a mesh file holds, for `bruma info`: counts, bounds in the file's unit and in millimetres, where the unit comes
/// from, area and volume, materials, faults, and what was done about them.
std::string mesh_text(const std::string& file, const scene::LoadedMesh& loaded);

}  // namespace bruma::io
