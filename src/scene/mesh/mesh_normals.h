#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace bruma::scene {

/// Normals for the corners of triangles; corners of one smooth piece of surface around a vertex share theirs.
struct CornerNormals {
    std::vector<glm::dvec3> normals;           ///< unit length
    std::vector<std::uint32_t> corner_normal;  ///< three per triangle, into `normals`
};

/// Mean normal of the triangles around each vertex, each weighted by its area and by its angle there. Two triangles
/// belong to the same piece when they share an edge at that vertex and bend there by at most `crease_angle_deg`, or are
/// joined by others that do. Every triangle must have an area, and vertices that coincide must have one index.
CornerNormals smooth_normals(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                             double crease_angle_deg);

}  // namespace bruma::scene
