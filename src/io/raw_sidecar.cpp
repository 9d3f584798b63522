#include "io/raw_sidecar.h"

#include <fmt/core.h>

#include "base/error.h"
#include "io/input_file.h"
#include "io/json_fields.h"
#include "io/json_text.h"
#include "io/raw_name.h"

namespace bruma::io {
namespace {

Sidecar read_sidecar_json(const std::filesystem::path& path, const json& object) {
    const std::string where = path.string() + ":";
    require_object(object, where);
    require_known_keys(object, where, {"size", "type", "spacing_mm", "spacing", "rotation", "endian", "offset"});
    Sidecar sidecar{path, {}, {}};
    json common = object;
    common.erase("spacing_mm");
    scene::VolumeSource& says = sidecar.says;
    if (const auto type = object.find("type"); type != object.end() && type->is_string()) {
        // Short forms such as 'u8' are welcome here as they are in file names.
        if (const auto known = voxel_type_of_word(type->get_ref<const std::string&>())) {
            common["type"] = json_of(*known);
        }
    }
    read_present_fields(common, where, says);
    if (const auto millimetres = object.find("spacing_mm"); millimetres != object.end()) {
        if (says.spacing) {
            throw InputError(fmt::format("{} spacing and spacing_mm are both given; keep one of them", where));
        }
        glm::dvec3 spacing_mm(0.0);
        read_value(*millimetres, Field{.unit = "mm", .min = 0.0}, join_path(where, "spacing_mm"), spacing_mm);
        says.spacing = spacing_mm / 1e3;
    }
    if (const auto rotation = object.find("rotation"); rotation != object.end()) {
        read_value(*rotation, Field{.unit = "deg"}, join_path(where, "rotation"), sidecar.rotation_deg);
    }
    return sidecar;
}

}  // namespace

std::optional<Sidecar> read_sidecar(const std::filesystem::path& raw_path) {
    std::filesystem::path long_name = raw_path;
    long_name += ".json";
    std::filesystem::path short_name = raw_path;
    short_name.replace_extension(".json");
    std::filesystem::path long_capitals = raw_path;
    long_capitals += ".JSON";
    std::filesystem::path short_capitals = raw_path;
    short_capitals.replace_extension(".JSON");
    for (const std::filesystem::path& path : {long_name, short_name, long_capitals, short_capitals}) {
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) {
            continue;
        }
        const json document = parse_json(read_text_file(path, 1 << 20), path.string());
        if (document.is_object() && document.contains("bruma_scene")) {
            continue;
        }
        return read_sidecar_json(path, document);
    }
    return std::nullopt;
}

}  // namespace bruma::io
