#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// A guess at how the samples of a headerless file lie.
struct RawProposal {
    glm::ivec3 size{0};
    scene::VoxelType type = scene::VoxelType::uint8;
    scene::Endian endian = scene::Endian::little;
    std::int64_t offset = 0;  ///< bytes before the first sample
    double score = 0.0;       ///< smaller is likelier; only good for comparing within one file
    std::string reason;       ///< one line for people
};

/// The `most` likeliest layouts, best first, that fit the file's length exactly and agree with `hints`: sizes from all
/// divisors of the length behind each plausible header (raw_headers.h), ranked by how smooth they make the data along
/// all three axes (layout_search.h), by the width of a sample that the bytes show, and by how usual they are. Reads a
/// few megabytes of a file of any length. Throws InputError when the file cannot be read; no proposal is an answer too.
std::vector<RawProposal> propose_layouts(const std::filesystem::path& path, const scene::VolumeSource& hints, int most);

/// A proposal as options of the command line: "--dims 256x256x128 --type uint16 --endian big".
std::string as_options(const RawProposal& proposal);

}  // namespace bruma::io
