#include "scene/mesh/mesh_up.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {
namespace {

/// Area of the triangles that lie flat at one end of the mesh along an axis and face outwards there, as a share of the
/// box around the mesh seen along that axis.
double flat_share(const TriangleMesh& mesh, int axis, bool at_high_end) {
    const glm::dvec3 sides = mesh.high - mesh.low;
    const double outline = sides[(axis + 1) % 3] * sides[(axis + 2) % 3];
    const double end = at_high_end ? mesh.high[axis] : mesh.low[axis];
    const double room = 0.01 * sides[axis];
    double area = 0.0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        if (std::max({std::abs(a[axis] - end), std::abs(b[axis] - end), std::abs(c[axis] - end)}) <= room) {
            const double seen = 0.5 * glm::cross(b - a, c - a)[axis];
            area += std::max(0.0, at_high_end ? seen : -seen);
        }
    }
    return outline > 0.0 ? area / outline : 0.0;
}

}  // namespace

bool is_z_plainly_up(const TriangleMesh& mesh) {
    const glm::dvec3 sides = mesh.high - mesh.low;
    if (sides.z < 0.15 * std::max(sides.x, sides.y)) {
        return false;
    }
    const double base = flat_share(mesh, 2, false);
    return base >= 0.3 && flat_share(mesh, 2, true) <= 0.5 * base && flat_share(mesh, 1, false) <= 0.1;
}

}  // namespace bruma::scene
