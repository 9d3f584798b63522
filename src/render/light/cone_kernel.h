#pragma once
#include <array>
#include <glm/glm.hpp>

namespace bruma::render {

/// Weights of the 3 x 3 cells around the crossing of the previous slice, for light from within a cone about the way to
/// the light, by the phase function over the solid angle of each cell; their sum is 1. Row by row; `cell` holds the
/// cell's edges along u and v and the distance between slices, all in one unit; `shift_cells` is where the ray to the
/// light crosses the previous slice.
std::array<double, 9> cone_kernel(double g, double cone_angle_rad, glm::dvec3 cell, glm::dvec2 shift_cells);

}  // namespace bruma::render
