#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "render/volume/macrocells.h"

namespace bruma::render {

/// Least and most extinction that a sample inside each macrocell can have, in the unit of the table it is looked up in;
/// x runs fastest. Free paths are drawn against the most (Woodcock et al. 1965), transmittance is the least's times a
/// product over samples of the rest (Novak et al. 2014, "Residual ratio tracking").
struct ExtinctionBounds {
    glm::ivec3 cells{0};
    std::vector<glm::vec2> least_most;
};

/// `extinction` is a table over u in [0, 1] with equal steps, looked up linearly; `u_of_value` gives u = x * value + y.
ExtinctionBounds bound_extinction(const CellRanges& ranges, const std::vector<float>& extinction,
                                  glm::dvec2 u_of_value);

}  // namespace bruma::render
