#include "scene/builtin.h"

#include <fmt/core.h>

#include <array>

#include "base/error.h"
#include "base/nearest_name.h"
#include "scene/builtin_volumes.h"

namespace bruma::scene {
namespace {

struct BuiltinVolume {
    const char* name;
    std::shared_ptr<const VolumeGrid> (*make)();
};

constexpr std::array builtin_volumes{
    BuiltinVolume{"engine", make_engine},
    BuiltinVolume{"bucky", make_bucky},
    BuiltinVolume{"hydrogen", make_hydrogen},
    BuiltinVolume{"knot", make_knot},
    BuiltinVolume{"blobs", make_blobs},
    BuiltinVolume{"marschner-lobb", make_marschner_lobb},
    BuiltinVolume{"marschner-lobb-256", make_marschner_lobb_256},
    BuiltinVolume{"sphere", make_sphere},
    BuiltinVolume{"cube", make_cube},
};

}  // namespace

std::vector<std::string> builtin_volume_names() {
    std::vector<std::string> names;
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

}  // namespace bruma::scene
