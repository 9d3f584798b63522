#include "io/scene/scene_file.h"

#include <fmt/core.h>

#include <functional>

#include "base/error.h"
#include "io/atomic_file.h"
#include "io/input_file.h"
#include "io/json/json_text.h"
#include "io/mesh/mesh_source.h"
#include "io/picture/weather_file.h"
#include "io/scene/scene_json.h"
#include "io/scene/scene_settings.h"
#include "io/volume/grid_source.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t most_scene_bytes = 64 << 20;

void for_each_file(scene::Scene& scene, const std::function<fs::path(const fs::path&)>& change) {
    for (auto& [name, node] : scene.nodes) {
        auto* volume = std::get_if<scene::Volume>(&node.content);
        if (volume != nullptr && !is_builtin(volume->source.file)) {
            volume->source.file = change(volume->source.file).string();
        }
        auto* mesh = std::get_if<scene::Mesh>(&node.content);
        if (mesh != nullptr && !is_builtin(mesh->source.file)) {
            mesh->source.file = change(mesh->source.file).string();
        }
        if (mesh != nullptr && !mesh->source.texture.empty()) {
            mesh->source.texture = change(mesh->source.texture).string();
        }
        if (auto* clouds = std::get_if<scene::Clouds>(&node.content); clouds && !clouds->weather->file.empty()) {
            clouds->weather.edit(
                [&](scene::CloudWeatherSource& source) { source.file = change(source.file).string(); });
        }
    }
}

/// `file` as seen from `folder`; absolute when the way there climbs more than three folders up, because such a pair is
/// hardly moved together.
fs::path seen_from(const fs::path& folder, const fs::path& file) {
    std::error_code error;
    const fs::path absolute = fs::weakly_canonical(file, error);
    const fs::path base = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error) {
        return file;
    }
    const fs::path relative = absolute.lexically_relative(base);
    int climbs = 0;
    for (const fs::path& part : relative) {
        climbs += part == ".." ? 1 : 0;
    }
    return relative.empty() || climbs > 3 ? absolute : relative;
}

}  // namespace

scene::Scene read_scene_file(const fs::path& path, const Progress& progress,
                             const std::vector<fs::path>& preset_folders, std::span<const std::string> settings) {
    const nlohmann::json document = parse_json(read_text_file(path, most_scene_bytes), path.string());
    const fs::path folder = path.parent_path();
    std::vector<fs::path> folders{folder.empty() ? fs::path(".") : folder};
    folders.insert(folders.end(), preset_folders.begin(), preset_folders.end());
    scene::Scene scene = from_json(document, path.string(), folders);
    for_each_file(scene, [&](const fs::path& file) { return (folder / file).lexically_normal(); });
    scene = with_sources_set(scene, settings, folders);
    try {
        load_missing_grids(scene, nullptr, progress);
        load_missing_meshes(scene, nullptr, progress);
        load_missing_weather(scene, nullptr);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
    return scene;
}

void save_scene_file(const scene::Scene& scene, const fs::path& path) {
    scene::Scene moved = scene;
    for_each_file(moved, [&](const fs::path& file) { return seen_from(path.parent_path(), file); });
    write_file_atomically(path, json_text(to_json(moved)));
}

}  // namespace bruma::io
