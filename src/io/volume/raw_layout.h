#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// How the samples lie in a headerless file.
struct RawLayout {
    std::filesystem::path file;  ///< that holds the samples; another one than was opened if that was a header alone
    glm::ivec3 size{0};          ///< samples along x, y, z; x runs fastest
    scene::VoxelType type = scene::VoxelType::uint8;
    scene::Endian endian = scene::Endian::little;
    std::int64_t offset = 0;     ///< bytes before the first sample
    glm::dvec3 spacing_m{1e-3};  ///< metres between neighbouring samples

    glm::dvec3 rotation_deg{0.0};  ///< that sets the volume upright, facing +z; see scene::Transform

    /// Who said each part: "options", "header NAME.mhd", "sidecar NAME.json", "file name", "known volume NAME" or
    /// "default".
    std::string size_from, type_from, endian_from, offset_from, spacing_from, rotation_from;
    std::vector<std::string> unused;  ///< fields of a header that place or turn the volume and are passed over

    std::int64_t bytes_needed() const;  ///< header and samples; never overflows after `check_size`
};

/// A layout of which size or type may be missing.
struct RawLayoutParts {
    RawLayout layout;
    bool has_size = false;
    bool has_type = false;

    bool complete() const { return has_size && has_type; }
    /// The parts that somebody said, for `propose_layouts`.
    scene::VolumeSource as_hints() const;
};

/// "256 x 256 x 128 x uint16", for messages.
std::string layout_words(glm::ivec3 size, scene::VoxelType type);

/// Throws InputError for sizes of zero or less and for more than 2^40 samples; `where` opens the sentence.
void check_size(glm::ivec3 size, const std::string& where);

/// What is known of a file's layout from the same places as `find_raw_layout` asks. Throws InputError when size or type
/// are missing and the content is of a format that is known and not read (foreign_format.h).
RawLayoutParts known_layout_parts(const std::filesystem::path& path, const scene::VolumeSource& hints);

/// Those of the hints that hold for one of several files given together: what its own header, sidecar or name says goes
/// before them there. `overruled` gets the options that say something else, as in "--dims".
scene::VolumeSource hints_among_others(const std::filesystem::path& path, const scene::VolumeSource& hints,
                                       std::vector<std::string>& overruled);

/// The layout of a file from `hints`, a sidecar (NAME.raw.json or NAME.json beside it; keys size, type, spacing_mm or
/// spacing, rotation, endian, offset), a MetaImage or NRRD header (the file itself, or one beside it that names it),
/// the file name, and the list of published volumes (known_volumes.h), in this order for each part. Never guesses:
/// without size or type it throws InputError with the likeliest proposals, and so it does when the file's length is not
/// the one the layout needs. Byte order, offset, spacing and rotation have defaults: little, 0, 1 mm, none.
RawLayout find_raw_layout(const std::filesystem::path& path, const scene::VolumeSource& hints);

}  // namespace bruma::io
