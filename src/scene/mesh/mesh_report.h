#pragma once
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace bruma::scene {

/// What a set of triangles is like as a surface. Lengths are in the unit of the positions. Vertices at exactly the same
/// place count as one, unless it says otherwise.
struct MeshReport {
    std::size_t vertices = 0;  ///< as listed
    std::size_t unused_vertices = 0;
    std::size_t triangles = 0;
    glm::dvec3 low{0.0}, high{0.0};         ///< box around all vertices used
    std::size_t degenerate_triangles = 0;   ///< without area; they count in nothing below
    std::size_t duplicate_triangles = 0;    ///< with the three corners of an earlier one, in any order
    std::size_t open_edges = 0;             ///< with a triangle on one side only
    std::size_t open_edges_as_indexed = 0;  ///< the same if vertices at the same place are told apart
    std::size_t open_borders = 0;           ///< connected sets of open edges
    std::size_t non_manifold_edges = 0;     ///< with more than two triangles
    std::size_t misoriented_edges = 0;      ///< whose two triangles disagree on which side is out
    std::size_t components = 0;             ///< connected by shared vertices
    std::size_t inverted_components = 0;    ///< closed, with negative volume: inside out, or the wall of a hollow
    double area = 0.0;
    double volume = 0.0;  ///< signed: positive when triangles run counter-clockwise seen from outside

    /// Every edge has one triangle on either side.
    bool closed() const { return components > 0 && open_edges + non_manifold_edges + misoriented_edges == 0; }
    bool inside_out() const { return closed() && volume < 0.0; }
};

/// Examines triangles; indices must be valid and the positions they name finite. n log n in the number of triangles.
MeshReport mesh_report(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles);

/// The faults of a mesh in words, one each; none for a closed surface of decent triangles.
std::vector<std::string> fault_words(const MeshReport& report);

}  // namespace bruma::scene
