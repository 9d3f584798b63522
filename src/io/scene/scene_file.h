#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// Reads a .json scene, the samples of its volumes and the triangles of its meshes. Paths in the file are relative to
/// its folder; in the scene they are relative to the working directory, or absolute. Presets named by the scene are
/// looked up beside it, then in `preset_folders`. Those of `settings` (PATH=VALUE, see scene_settings.h) that change a
/// volume's source hold before any samples are read, so that a file that is missing can be replaced; its path is
/// relative to the working directory. Throws InputError; what `progress` throws passes through.
scene::Scene read_scene_file(const std::filesystem::path& path, const Progress& progress = {},
                             const std::vector<std::filesystem::path>& preset_folders = {},
                             std::span<const std::string> settings = {});

/// Writes a scene, all at once or not at all. Paths become relative to the new file where both lie close together.
void save_scene_file(const scene::Scene& scene, const std::filesystem::path& path);

}  // namespace bruma::io
