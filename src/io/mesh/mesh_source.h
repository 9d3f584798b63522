#pragma once
#include <string_view>

#include "io/progress.h"
#include "scene/mesh/mesh_parts.h"
#include "scene/scene.h"

namespace bruma::io {

/// Whether a name ends as mesh files do (.obj, .off), or is a .raw text of triangles, or a mesh made by code. Throws
/// InputError when a .raw file cannot be opened.
bool is_mesh(const std::string& file);

/// The triangles of a source: a file relative to the working directory, or builtin:NAME. Throws InputError; what
/// `progress` throws passes through.
scene::LoadedMesh load_mesh(const scene::MeshSource& source, const Progress& progress);

/// Writes its remarks to the log, and the unit that it got where nobody said one.
void log_remarks(const scene::MeshSource& source, const scene::LoadedMesh& loaded);

/// The triangles alone; remarks go to the log.
std::shared_ptr<const scene::TriangleMesh> load_triangles(const scene::MeshSource& source, const Progress& progress);

/// Fills in every mesh that is missing. Triangles that `known` holds for the same source are shared and not read again.
void load_missing_meshes(scene::Scene& scene, const scene::Scene* known, const Progress& progress);

}  // namespace bruma::io
