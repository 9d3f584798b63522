#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// What may stand before the samples of a file of unknown layout.
struct HeaderGuess {
    std::int64_t offset = 0;         ///< bytes
    std::optional<glm::ivec3> size;  ///< when three numbers in it give the length of the rest
    double penalty = 0.0;            ///< how unusual it is, in the unit of RawProposal::score
};

/// Headers worth trying for samples of `width` bytes: none, the usual lengths, what a usual cube leaves over, and those
/// that hold the size as three 16-bit or 32-bit numbers. With an offset or a size in `hints`, the one that they leave.
/// All of them leave a whole number of samples, at least one.
std::vector<HeaderGuess> guess_headers(std::span<const std::byte> bytes, const scene::VolumeSource& hints,
                                       std::int64_t width);

}  // namespace bruma::io
