#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// Opens what stands on a command line as one scene. Each argument is a .json scene (at most one, and first), a .raw
/// volume (or one that `is_raw_volume`), a mesh (.obj, .off, .raw text) or builtin:NAME. Volumes and meshes become
/// nodes named after their files, side by side along x where they would overlap; a scene without lights gets a
/// headlight named 'headlight'. `hints` tell the layout of the headerless volumes (see `hints_for_each`), and
/// `settings` (PATH=VALUE, see scene_settings.h) are applied last, in their order, except that those of a volume's
/// source in a .json scene hold before its samples are read. Throws InputError; what `progress` throws passes through.
scene::Scene open_files(std::span<const std::string> arguments, const scene::VolumeSource& hints,
                        std::span<const std::string> settings, const Progress& progress = {},
                        const std::vector<std::filesystem::path>& preset_folders = {});

/// Whether a file is opened as a volume of plain samples: .raw files, headers of such, and files of any other name
/// whose layout is told, or whose content is of no known format. Throws InputError for what is not read.
bool is_raw_volume(const std::string& argument, const scene::VolumeSource& hints);

/// The hints that hold for each of the files. For the only headerless one they go before all else; of several, each is
/// read as its own header, sidecar or name says, and the hints tell what these leave open. What is overruled is noted;
/// throws InputError for an option that holds for none of them.
std::vector<scene::VolumeSource> hints_for_each(std::span<const std::string> arguments,
                                                const scene::VolumeSource& hints);

/// Adds one more file, as open_files would; of the settings it applies those of a volume's source alone. When it
/// throws, the scene is as it was.
void add_file(scene::Scene& scene, const std::string& argument, const scene::VolumeSource& hints,
              const Progress& progress = {}, const std::vector<std::filesystem::path>& preset_folders = {},
              std::span<const std::string> settings = {});

/// The scene with settings applied; grids and meshes whose source did not change are shared, the others are loaded.
scene::Scene with_settings(const scene::Scene& scene, std::span<const std::string> settings,
                           const Progress& progress = {},
                           const std::vector<std::filesystem::path>& preset_folders = {});

}  // namespace bruma::io
