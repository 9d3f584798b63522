#include "io/scene/transfer_function_file.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "base/nearest_name.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/json/json_fields.h"
#include "io/json/json_text.h"

namespace bruma::io {
namespace {

constexpr const char* preset_key = "bruma_transfer_function";
constexpr std::int64_t preset_version = 1;
constexpr std::int64_t most_preset_bytes = 16 << 20;

}  // namespace

json transfer_function_json(const scene::TransferFunction& transfer_function) {
    json object = json::object();
    write_fields(transfer_function, object);
    return object;
}

scene::TransferFunction read_transfer_function(const json& from, const std::string& where) {
    auto transfer_function = read_fields<scene::TransferFunction>(from, where);
    if (transfer_function.domain[0] == transfer_function.domain[1]) {
        throw InputError(fmt::format("{}: both ends are {}; give it some width", join_path(where, "domain"),
                                     transfer_function.domain[0]));
    }
    scene::normalise(transfer_function);
    return transfer_function;
}

scene::TransferFunction load_transfer_function(const std::filesystem::path& path) {
    json document = parse_json(read_text_file(path, most_preset_bytes), path.string());
    const std::string where = path.string() + ":";
    require_object(document, where);
    check_version(document, preset_key, preset_version, path.string());
    document.erase(preset_key);
    return read_transfer_function(document, where);
}

void save_transfer_function(const scene::TransferFunction& transfer_function, const std::filesystem::path& path) {
    json document = transfer_function_json(transfer_function);
    document[preset_key] = preset_version;
    write_file_atomically(path, json_text(document));
}

std::vector<Preset> list_presets(const std::filesystem::path& folder) {
    std::vector<Preset> presets;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->path().extension() == ".json") {
            presets.push_back({at->path().stem().string(), at->path()});
        }
    }
    std::sort(presets.begin(), presets.end(), [](const Preset& a, const Preset& b) { return a.name < b.name; });
    return presets;
}

std::filesystem::path find_preset(const std::string& name, const std::vector<std::filesystem::path>& folders,
                                  const std::string& where) {
    std::vector<std::string> known;
    for (const std::filesystem::path& folder : folders) {
        for (const std::string& candidate : {name, name + ".json"}) {
            std::error_code ignored;
            if (std::filesystem::is_regular_file(folder / candidate, ignored)) {
                return folder / candidate;
            }
        }
        for (const Preset& preset : list_presets(folder)) {
            known.push_back(preset.name);
        }
    }
    throw InputError(fmt::format("{}: there is no preset '{}'{}", where, name, suggestion(name, known)));
}

}  // namespace bruma::io
