#pragma once
#include <filesystem>

#include "io/progress.h"
#include "scene/mesh/mesh_parts.h"

namespace bruma::io {

/// Reads a Wavefront OBJ file through tinyobjloader: faces of any number of corners, with positive and negative
/// indices, of all objects and groups, and the materials of its libraries. Lines, points, smoothing groups and what
/// else is not drawn (obj_statements.h) is said in the remarks. What is broken in single faces, materials or textures
/// is repaired or left out, and said in the remarks. Throws InputError when nothing remains to be shown; what
/// `progress` throws passes through.
scene::LoadedMesh load_obj_mesh(const std::filesystem::path& path, const scene::MeshSource& source,
                                const Progress& progress = {});

}  // namespace bruma::io
