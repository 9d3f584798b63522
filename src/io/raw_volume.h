#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "io/progress.h"
#include "io/raw_layout.h"
#include "scene/volume.h"

namespace bruma::io {

struct LoadedVolume {
    std::shared_ptr<const scene::VolumeGrid> grid;
    RawLayout layout;
    std::size_t replaced_nonfinite = 0;  ///< NaN and infinite samples that became the smallest finite value
    std::vector<std::string> remarks;    ///< sentences a user should see; none of them stops anything
};

/// Loads a headerless volume. `hints` go before what a sidecar or the file name say (see raw_layout.h). Throws
/// InputError for files that are missing, too long or short, of unknown layout, larger than the free memory, or that
/// hold ASCII triangles; what `progress` throws passes through.
LoadedVolume load_raw_volume(const std::filesystem::path& path, const scene::VolumeSource& hints,
                             const Progress& progress = {});

/// Bytes that can be had without swapping, by the kernel's own estimate; the largest number when it does not tell.
std::uint64_t available_memory();

}  // namespace bruma::io
