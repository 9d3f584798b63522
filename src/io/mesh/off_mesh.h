#pragma once
#include <filesystem>

#include "io/progress.h"
#include "scene/mesh/mesh_parts.h"

namespace bruma::io {

/// Reads a text file in Object File Format: the word OFF (or COFF, NOFF and other prefixes whose extra numbers are
/// passed over; it may be missing), the numbers of vertices, faces and edges, then a vertex a line and a face a line:
/// its number of corners and their indices from 0. Comments (#), blank lines and CRLF are tolerated. Throws InputError
/// with the line of the first fault; what `progress` throws passes through.
scene::LoadedMesh load_off_mesh(const std::filesystem::path& path, const scene::MeshSource& source,
                                const Progress& progress = {});

}  // namespace bruma::io
