#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "io/volume/sample_roughness.h"

namespace bruma::io {

/// A guess at the size of a volume.
struct SizeGuess {
    glm::ivec3 size{0};
    double roughness = 0.0;  ///< mean over the axes that have neighbours
    double score = 0.0;      ///< smaller is likelier
};

/// Sizes of exactly `count` samples, in no order. All divisors of `count` are tried as lengths of a row and of a slice:
/// the true ones make neighbours alike along all three axes and are valleys of the roughness, since a sample half a row
/// or half a slice further on lies in other matter. How usual a size is decides what is left even. Sizes that cannot
/// score below `bound`, or below the best by `of_interest`, are left out, which saves nearly all of the work.
std::vector<SizeGuess> guess_sizes(SampleRoughness& roughness, std::int64_t count, double bound, double of_interest);

/// The same judgement of one size that somebody said.
SizeGuess judge_size(SampleRoughness& roughness, glm::ivec3 size);

}  // namespace bruma::io
