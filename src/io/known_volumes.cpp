#include "io/known_volumes.h"

#include <algorithm>
#include <cctype>

#include "base/installation.h"
#include "io/input_file.h"
#include "io/json_fields.h"
#include "io/json_text.h"

namespace bruma::io {
namespace {

bool begins_with(const std::string& text, const std::string& start) {
    return text.size() >= start.size() && std::equal(start.begin(), start.end(), text.begin(), [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
           });
}

}  // namespace

std::optional<KnownVolume> known_volume(const std::filesystem::path& path, glm::ivec3 size) {
    const std::filesystem::path list = installed_folder("assets") / "known_volumes.json";
    const json document = parse_json(read_text_file(list, 1 << 20), list.string());
    check_version(document, "bruma_known_volumes", 1, list.string());
    for (const json& entry : document.at("volumes")) {
        KnownVolume known;
        glm::ivec3 its_size(0);
        read_value(entry.at("name"), Field{}, "name", known.name);
        read_value(entry.at("size"), Field{}, known.name + ".size", its_size);
        if (its_size == size && begins_with(path.filename().string(), known.name)) {
            read_value(entry.at("spacing_mm"), Field{}, known.name + ".spacing_mm", known.spacing_m);
            read_value(entry.at("rotation"), Field{}, known.name + ".rotation", known.rotation_deg);
            known.spacing_m /= 1e3;
            return known;
        }
    }
    return std::nullopt;
}

}  // namespace bruma::io
