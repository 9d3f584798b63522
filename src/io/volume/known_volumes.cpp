#include "io/volume/known_volumes.h"

#include <algorithm>
#include <cctype>

#include "base/installation.h"
#include "io/input_file.h"
#include "io/json/json_fields.h"
#include "io/json/json_text.h"

namespace bruma::io {
namespace {

/// How many letters and digits of `name` the file name begins with, up to the end of a word; 0 when it does not begin
/// with the name.
std::size_t letters_in_common(const std::string& file, const std::string& name) {
    const auto letter = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; };
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    std::size_t at = 0;
    std::size_t count = 0;
    for (const char c : name) {
        if (!letter(c)) {
            continue;
        }
        while (at < file.size() && !letter(file[at])) {
            ++at;
        }
        if (at == file.size() || !same(file[at], c)) {
            return 0;
        }
        ++at;
        ++count;
    }
    return at < file.size() && letter(file[at]) ? 0 : count;
}

std::size_t best_match(const std::string& file, const KnownVolume& volume) {
    std::size_t best = letters_in_common(file, volume.name);
    for (const std::string& name : volume.also) {
        best = std::max(best, letters_in_common(file, name));
    }
    return best;
}

std::int64_t bytes_of(const KnownVolume& volume) {
    return std::int64_t(volume.size.x) * volume.size.y * volume.size.z *
           std::int64_t(scene::bytes_per_voxel(volume.type));
}

KnownVolume read_entry(const json& entry, const std::string& where) {
    require_object(entry, where);
    require_known_keys(entry, where,
                       {"name", "also", "size", "type", "spacing_mm", "from", "rotation", "upright_from"});
    KnownVolume known;
    read_value(entry.at("name"), Field{}, where + " name", known.name);
    const std::string own = where + " " + known.name;
    for (const json& name : entry.value("also", json::array())) {
        read_value(name, Field{}, own + ".also", known.also.emplace_back());
    }
    read_value(entry.at("size"), Field{.min = 1}, own + ".size", known.size);
    read_value(entry.at("type"), Field{}, own + ".type", known.type);
    read_value(entry.at("spacing_mm"), Field{.min = 0.0}, own + ".spacing_mm", known.spacing_m);
    known.spacing_m /= 1e3;
    if (const auto rotation = entry.find("rotation"); rotation != entry.end()) {
        read_value(*rotation, Field{}, own + ".rotation", known.rotation_deg);
    }
    read_value(entry.at("from"), Field{}, own + ".from", known.from);
    return known;
}

}  // namespace

std::vector<KnownVolume> known_volumes() {
    const std::filesystem::path list = installed_folder("assets") / "known_volumes.json";
    const json document = parse_json(read_text_file(list, 1 << 20), list.string());
    check_version(document, "bruma_known_volumes", 1, list.string());
    std::vector<KnownVolume> known;
    for (const json& entry : document.at("volumes")) {
        known.push_back(read_entry(entry, list.string() + ":"));
    }
    return known;
}

std::optional<KnownVolume> known_volume(const std::filesystem::path& path, const std::optional<glm::ivec3>& size,
                                        const std::optional<scene::VoxelType>& type, std::int64_t bytes) {
    const std::string file = path.stem().string();
    std::optional<KnownVolume> found;
    std::size_t most = 0;
    for (const KnownVolume& known : known_volumes()) {
        const std::size_t common = best_match(file, known);
        const bool fits = size ? *size == known.size : bytes == bytes_of(known) && (!type || *type == known.type);
        if (common > most && fits) {
            most = common;
            found = known;
        }
    }
    return found;
}

}  // namespace bruma::io
