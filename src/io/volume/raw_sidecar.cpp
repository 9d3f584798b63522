#include "io/volume/raw_sidecar.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <mutex>
#include <set>

#include "base/error.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "io/input_file.h"
#include "io/json/json_fields.h"
#include "io/json/json_text.h"
#include "io/volume/raw_name.h"

namespace bruma::io {
namespace {

const std::vector<std::string>& known_keys() {
    static const std::vector<std::string> keys{"size", "type", "spacing_mm", "spacing", "rotation", "endian", "offset"};
    return keys;
}

/// Says once that a file beside a volume is not used: the volume's layout is asked for by several callers.
void say_once(const std::filesystem::path& path, const std::string& why) {
    static std::mutex mutex;
    static std::set<std::string> said;
    std::string sentence = fmt::format("{}: passed over, {}; what is read beside a volume is an object with some of {}",
                                       path.string(), why, fmt::join(known_keys(), ", "));
    const std::lock_guard lock(mutex);
    if (said.insert(sentence).second) {
        log_note("{}", sentence);
    }
}

Sidecar read_sidecar_json(const std::filesystem::path& path, const json& object) {
    const std::string where = path.string() + ":";
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

/// An object's keys by whose they are.
struct SidecarKeys {
    std::vector<std::string> known, misspelled, foreign;
};

/// Whether a key looks like one of ours with a slip: a quarter of its letters at most, so that 'EchoTime' is no 'type'.
bool is_misspelled(const std::string& key) {
    return std::any_of(known_keys().begin(), known_keys().end(),
                       [&](const std::string& known) { return edit_distance(key, known) <= known.size() / 4; });
}

SidecarKeys sorted_keys(const json& object) {
    SidecarKeys keys;
    for (const auto& [key, value] : object.items()) {
        if (std::find(known_keys().begin(), known_keys().end(), key) != known_keys().end()) {
            keys.known.push_back(key);
        } else {
            (is_misspelled(key) ? keys.misspelled : keys.foreign).push_back(key);
        }
    }
    return keys;
}

std::string some_of(const std::vector<std::string>& keys) {
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t n = 0; n < std::min(most, keys.size()); ++n) {
        // Through join_path, which keeps control characters out of messages.
        text += fmt::format("{}'{}'", n == 0 ? "" : ", ", join_path("", keys[n].substr(0, 40)));
    }
    return keys.size() > most ? fmt::format("{} and {} more", text, keys.size() - most) : text;
}

/// Many programs leave a .json beside their data. A file is ours when at least half of its keys are, or nearly are:
/// what is wrong in it is an error then, and keys that are nobody's are named. From another program's file only what
/// reads right is taken.
std::optional<Sidecar> read_sidecar_or_foreign(const std::filesystem::path& path, const json& object) {
    const SidecarKeys keys = sorted_keys(object);
    const bool is_ours = keys.foreign.size() <= keys.known.size() + keys.misspelled.size();
    if (is_ours && !keys.misspelled.empty()) {
        require_known_keys({{keys.misspelled.front(), nullptr}}, path.string() + ":", known_keys());
    }
    json ours = json::object();
    for (const std::string& key : keys.known) {
        ours[key] = object[key];
    }
    if (is_ours && keys.foreign.empty()) {
        return read_sidecar_json(path, ours);
    }
    const std::string unknown =
        fmt::format("its {} {} unknown", some_of(keys.foreign), keys.foreign.size() == 1 ? "is" : "are");
    if (ours.empty()) {
        say_once(path, unknown);
        return std::nullopt;
    }
    try {
        Sidecar sidecar = read_sidecar_json(path, ours);
        say_once(path, unknown + ", but for " + some_of(keys.known));
        return sidecar;
    } catch (const InputError&) {
        if (is_ours) {
            throw;
        }
        say_once(path, unknown);
        return std::nullopt;
    }
}

/// Whether a text that is no JSON was meant as a sidecar: it holds one of our keys in quotes.
bool mentions_our_keys(const std::string& text) {
    return std::any_of(known_keys().begin(), known_keys().end(), [&](const std::string& key) {
        return text.find(fmt::format("\"{}\"", key)) != std::string::npos;
    });
}

/// The document in a file, if it is JSON or was meant to be ours.
std::optional<json> document_in(const std::filesystem::path& path) {
    std::string text;
    try {
        text = read_text_file(path, 1 << 20);
    } catch (const InputError&) {
        say_once(path, "it is empty, longer than 1 MiB or not to be read");
        return std::nullopt;
    }
    try {
        return parse_json(text, path.string());
    } catch (const InputError&) {
        if (mentions_our_keys(text)) {
            throw;
        }
        say_once(path, "it is no JSON");
        return std::nullopt;
    }
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
        const std::optional<json> document = document_in(path);
        if (!document) {
            continue;
        }
        if (!document->is_object()) {
            say_once(path, "it holds no object {...}");
            continue;
        }
        // Scenes, curves and lists of this program stand beside volumes by right.
        if (document->contains("bruma_scene") || document->contains("bruma_transfer_function")) {
            continue;
        }
        if (auto sidecar = read_sidecar_or_foreign(path, *document)) {
            return sidecar;
        }
    }
    return std::nullopt;
}

}  // namespace bruma::io
