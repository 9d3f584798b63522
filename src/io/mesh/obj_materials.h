#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scene/mesh/mesh_data.h"

namespace bruma::io {

/// The materials that the libraries (.mtl) of an OBJ file describe.
struct ObjMaterials {
    std::vector<scene::MeshMaterial> materials;
    std::map<std::string, std::uint32_t> index_of;  ///< by name, without blanks around it
    std::vector<std::string> remarks;               ///< what is missing or broken and was done without

    /// Index of the material that a `usemtl` line names, with or without a comment behind it; null: none.
    const std::uint32_t* find(const std::string& name) const;
};

/// Reads the libraries that `mtllib` lines of `obj_file` name, with their diffuse textures. File names may be several
/// in a line, and may hold blanks, with or without a backslash before each; they are looked for beside the OBJ file and
/// what it links to, textures beside their library first (see named_file.h).
/// Nothing in here stops the mesh from being shown: what cannot be read is a remark.
ObjMaterials read_obj_materials(const std::filesystem::path& obj_file, const std::vector<std::string>& libraries);

}  // namespace bruma::io
