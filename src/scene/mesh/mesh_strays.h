#pragma once
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "scene/mesh/mesh_report.h"

namespace bruma::scene {

/// The box around a mesh without vertices that lie so far out that all else is a speck beside them.
struct MeshCore {
    glm::dvec3 low{0.0}, high{0.0};
    std::size_t strays = 0;  ///< more than a thousand times as far out as the others are wide, a fiftieth at most
    glm::dvec3 first_stray{0.0};
};

/// Indices must be valid and the positions they name finite. Meshes of less than a hundred corners have no strays.
/// Linear time.
MeshCore mesh_core(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                   const MeshReport& report);

/// A sentence about the strays of the mesh in file `where`.
std::string stray_words(const MeshCore& core, std::string_view where);

}  // namespace bruma::scene
