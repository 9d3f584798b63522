#include "scene/builtin/builtin.h"

#include <fmt/core.h>

#include <array>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/builtin/builtin_transfer_functions.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

struct BuiltinVolume {
    const char* name;
    glm::ivec3 size;
    std::shared_ptr<const VolumeGrid> (*make)();
    TransferFunction (*transfer_function)();
};

const std::array builtin_volumes{
    BuiltinVolume{"engine", {160, 112, 96}, make_engine, engine_transfer_function},
    BuiltinVolume{"bucky", glm::ivec3(64), make_bucky, bucky_transfer_function},
    BuiltinVolume{"hydrogen", glm::ivec3(128), make_hydrogen, hydrogen_transfer_function},
    BuiltinVolume{"knot", glm::ivec3(128), make_knot, knot_transfer_function},
    BuiltinVolume{"blobs", glm::ivec3(256), make_blobs, blobs_transfer_function},
    BuiltinVolume{"marschner-lobb", glm::ivec3(41), make_marschner_lobb, marschner_lobb_transfer_function},
    BuiltinVolume{"marschner-lobb-256", glm::ivec3(256), make_marschner_lobb_256, marschner_lobb_256_transfer_function},
    BuiltinVolume{"sphere", glm::ivec3(64), make_sphere, sphere_transfer_function},
    BuiltinVolume{"cube", glm::ivec3(32), make_cube, cube_transfer_function},
};

}  // namespace

std::vector<std::string> builtin_volume_names() {
    std::vector<std::string> names;
    names.reserve(builtin_volumes.size());
    for (const BuiltinVolume& builtin : builtin_volumes) {
        names.emplace_back(builtin.name);
    }
    return names;
}

std::shared_ptr<const VolumeGrid> builtin_volume(const std::string& name) {
    for (const BuiltinVolume& builtin : builtin_volumes) {
        if (name == builtin.name) {
            return builtin.make();
        }
    }
    throw InputError(
        fmt::format("builtin:{}: there is no such volume{}", name, suggestion(name, builtin_volume_names())));
}

TransferFunction suggested_transfer_function(const VolumeGrid& grid) {
    for (const BuiltinVolume& builtin : builtin_volumes) {
        // A file may bear the name of a builtin volume without being one.
        if (grid.name == builtin.name && grid.size == builtin.size) {
            return builtin.transfer_function();
        }
    }
    return transfer_function_of_histogram(grid);
}

}  // namespace bruma::scene
