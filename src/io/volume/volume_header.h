#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// What a MetaImage (.mhd, .mha) or NRRD (.nhdr, .nrrd) header says of uncompressed samples beside it or behind it.
struct VolumeHeader {
    std::filesystem::path path;       ///< of the header
    std::filesystem::path data_file;  ///< that holds the samples; the same file where they stand behind the header
    scene::VolumeSource says;         ///< parts that it does not name stay empty
    std::vector<std::string> unused;  ///< fields that place or turn the volume and are passed over
};

/// Whether a file begins as one of these headers does, whatever its name. False for files that cannot be read.
bool is_volume_header(const std::filesystem::path& path);

/// Throws InputError when the header is broken, or when it tells of samples that are not read: compressed ones, texts,
/// vectors, one file for each slice, types other than scene::VoxelType.
VolumeHeader read_volume_header(const std::filesystem::path& path);

/// The header in the same folder that names this file for its samples, if there is one: that of the same name, or the
/// only other one; several that say different things are passed over with a note. Throws as `read_volume_header` does.
std::optional<VolumeHeader> header_beside(const std::filesystem::path& raw_path);

}  // namespace bruma::io
