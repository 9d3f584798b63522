#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace bruma::io {

/// Changes one value of a scene's document (see scene_json.h), as `--set PATH=VALUE` does:
///
///     nodes.bonsai.lighting=gradient               words need no quotes
///     camera.eye=[0, 0.1, 0.5]                     any JSON
///     nodes.bonsai.transfer_function.opacity.1.0=0.3   parts of arrays by index, from 0
///     volume.density_scale=2, mesh.material=cream, light.intensity=1    a kind's name addresses all nodes, or lights,
///     of that kind
///
/// The value is not judged here: read the document with `from_json` afterwards. Throws InputError for a setting without
/// '=' or '.', and for a part of the path that does not exist, with the nearest one that does.
void apply_setting(nlohmann::json& scene_document, std::string_view path_equals_value);

/// The scene with those of the settings applied that tell where samples and triangles come from, or how files are
/// placed (placement.*): they hold before anything is read. One that does not fit is passed over: it may be meant for
/// what another file adds, and is judged with all the others when everything is there.
scene::Scene with_sources_set(const scene::Scene& scene, std::span<const std::string> settings,
                              const std::vector<std::filesystem::path>& preset_folders);

/// The same for what is to become the node `name` of a scene that is read already.
template <class Content>
Content with_source_set(Content content, const std::string& name, std::span<const std::string> settings,
                        const std::vector<std::filesystem::path>& preset_folders) {
    scene::Scene alone;
    alone.nodes[name].content = std::move(content);
    return std::get<Content>(with_sources_set(alone, settings, preset_folders).nodes.at(name).content);
}

}  // namespace bruma::io
