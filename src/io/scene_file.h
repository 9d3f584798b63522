#pragma once
#include <filesystem>
#include <vector>

#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// Reads a .json scene, the samples of its volumes and the triangles of its meshes. Paths in the file are relative to
/// its folder; in the scene they are relative to the working directory, or absolute. Presets named by the scene are
/// looked up beside it, then in `preset_folders`. Throws InputError; what `progress` throws passes through.
scene::Scene read_scene_file(const std::filesystem::path& path, const Progress& progress = {},
                             const std::vector<std::filesystem::path>& preset_folders = {});

/// Writes a scene, all at once or not at all. Paths become relative to the new file where both lie close together.
void save_scene_file(const scene::Scene& scene, const std::filesystem::path& path);

}  // namespace bruma::io
