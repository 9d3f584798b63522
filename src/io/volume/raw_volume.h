#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/memory.h"
#include "io/progress.h"
#include "io/volume/raw_layout.h"
#include "scene/volume/volume.h"

namespace bruma::io {

struct LoadedVolume {
    std::shared_ptr<const scene::VolumeGrid> grid;
    RawLayout layout;
    std::vector<std::string> remarks;  ///< sentences a user should see; none of them stops anything
};

/// Loads a headerless volume. `hints` go before what a sidecar or the file name say (see raw_layout.h). Throws
/// InputError for files that are missing, too long or short, of unknown layout, or that hold ASCII triangles,
/// MachineError for those that are larger than the free memory; what `progress` throws passes through.
LoadedVolume load_raw_volume(const std::filesystem::path& path, const scene::VolumeSource& hints,
                             const Progress& progress = {});

}  // namespace bruma::io
