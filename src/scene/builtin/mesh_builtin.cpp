#include "scene/builtin/mesh_builtin.h"

#include <fmt/core.h>

#include <array>

#include "base/error.h"
#include "base/nearest_name.h"

namespace bruma::scene {
namespace {

struct BuiltinMesh {
    const char* name;
    MeshParts (*make)();
};

constexpr std::array builtin_meshes{
    BuiltinMesh{"mesh-sphere", mesh_sphere_parts},
    BuiltinMesh{"mesh-knot", mesh_knot_parts},
    BuiltinMesh{"pot", pot_parts},
    BuiltinMesh{"cornell", cornell_parts},
    BuiltinMesh{"hills", hills_parts},
};

}  // namespace

std::vector<std::string> builtin_mesh_names() {
    std::vector<std::string> names;
    names.reserve(builtin_meshes.size());
    for (const BuiltinMesh& builtin : builtin_meshes) {
        names.emplace_back(builtin.name);
    }
    return names;
}

LoadedMesh builtin_mesh(const std::string& name, const MeshSource& source) {
    for (const BuiltinMesh& builtin : builtin_meshes) {
        if (name == builtin.name) {
            MeshParts parts = builtin.make();
            parts.name = name;
            parts.where = "builtin:" + name;
            LoadedMesh loaded = make_mesh(parts, source, 1.0);
            if (!source.millimetres_per_unit) {
                loaded.unit.from = "made in millimetres";
            }
            return loaded;
        }
    }
    throw InputError(fmt::format("builtin:{}: there is no such mesh{}", name, suggestion(name, builtin_mesh_names())));
}

}  // namespace bruma::scene
