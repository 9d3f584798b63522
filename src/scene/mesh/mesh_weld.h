#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace bruma::scene {

/// For each point the index of the first point with exactly its coordinates; +0 and -0 are one. Linear time.
std::vector<std::uint32_t> first_equal(std::span<const glm::dvec3> points);

}  // namespace bruma::scene
