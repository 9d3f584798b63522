#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/mesh_data.h"

namespace bruma::io {

/// The materials that the libraries (.mtl) of an OBJ file describe.
struct ObjMaterials {
    std::vector<scene::MeshMaterial> materials;
    std::map<std::string, std::uint32_t> index_of;  ///< by name, without blanks around it
    std::vector<std::string> remarks;               ///< what is missing or broken and was done without
};

/// Reads the libraries that `mtllib` lines of `obj_file` name, with their diffuse textures. File names may be several
/// in a line, and may hold blanks, with or without a backslash before each; they are looked for beside the OBJ file.
/// Nothing in here stops the mesh from being shown: what cannot be read is a remark.
ObjMaterials read_obj_materials(const std::filesystem::path& obj_file, const std::vector<std::string>& libraries);

}  // namespace bruma::io
