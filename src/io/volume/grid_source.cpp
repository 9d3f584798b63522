#include "io/volume/grid_source.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/log.h"
#include "io/volume/raw_volume.h"
#include "scene/builtin/builtin.h"

namespace bruma::io {
namespace {

std::shared_ptr<const scene::VolumeGrid> known_grid(const scene::Scene* known, const scene::VolumeSource& source) {
    if (known == nullptr) {
        return nullptr;
    }
    for (const auto& [name, node] : known->nodes) {
        const auto* volume = std::get_if<scene::Volume>(&node.content);
        if (volume != nullptr && volume->source == source && *volume->grid) {
            return *volume->grid;
        }
    }
    return nullptr;
}

}  // namespace

std::shared_ptr<const scene::VolumeGrid> load_grid(const scene::VolumeSource& source, const Progress& progress) {
    if (is_builtin(source.file)) {
        return scene::builtin_volume(builtin_name(source.file));
    }
    const LoadedVolume loaded = load_raw_volume(source.file, source, progress);
    for (const std::string& remark : loaded.remarks) {
        log_line(LogLevel::warning, remark);
    }
    return loaded.grid;
}

void load_missing_grids(scene::Scene& scene, const scene::Scene* known, const Progress& progress) {
    for (auto& [name, node] : scene.nodes) {
        auto* volume = std::get_if<scene::Volume>(&node.content);
        if (volume == nullptr || *volume->grid) {
            continue;
        }
        auto grid = known_grid(known, volume->source);
        // Two nodes of one file share its samples.
        grid = grid ? grid : known_grid(&scene, volume->source);
        if (!grid) {
            try {
                grid = load_grid(volume->source, progress);
            } catch (const InputError& error) {
                throw InputError(fmt::format("nodes.{}.source: {}", name, error.what()));
            } catch (const MachineError& error) {
                throw MachineError(fmt::format("nodes.{}.source: {}", name, error.what()));
            }
        }
        volume->grid = std::move(grid);
    }
}

}  // namespace bruma::io
