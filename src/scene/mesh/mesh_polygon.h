#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace bruma::scene {

/// Cuts a polygon, convex or not, into triangles that keep its orientation: always corners - 2 of them, as indices
/// of corners, appended to `into`. It is judged in the plane of its vector area (Newell's method). Time grows little
/// faster than the number of corners; polygons that cross themselves get some cut. Returns false, with `into` as it
/// was, for one of very many corners that crosses itself so often that this would take minutes.
bool triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& into);

}  // namespace bruma::scene
