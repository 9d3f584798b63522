#include <array>
#include <cmath>

#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

enum Part : std::uint32_t { white, red, green, light };

/// Adds a parallelogram that faces cross(u, v).
void add_panel(MeshParts& parts, Part part, const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v) {
    const auto first = std::int32_t(parts.positions.size());
    parts.positions.insert(parts.positions.end(), {corner, corner + u, corner + u + v, corner + v});
    const std::array<FaceCorner, 4> face{{{first}, {first + 1}, {first + 2}, {first + 3}}};
    parts.add_face(face, part);
}

/// A block on the floor, turned about the vertical, without its bottom.
void add_block(MeshParts& parts, const glm::dvec2& middle_xz, double width, double height, double turn_deg) {
    const double turn = glm::radians(turn_deg);
    const glm::dvec3 u = width * glm::dvec3(std::cos(turn), 0.0, -std::sin(turn));
    const glm::dvec3 w = width * glm::dvec3(std::sin(turn), 0.0, std::cos(turn));
    const glm::dvec3 up(0.0, height, 0.0);
    const glm::dvec3 corner = glm::dvec3(middle_xz.x, 0.0, middle_xz.y) - 0.5 * (u + w);
    add_panel(parts, white, corner + w, u, up);
    add_panel(parts, white, corner + u + w, -w, up);
    add_panel(parts, white, corner + u, -u, up);
    add_panel(parts, white, corner, w, up);
    add_panel(parts, white, corner + up, w, u);
}

}  // namespace

MeshParts cornell_parts() {
    constexpr double size = 550.0;
    const glm::dvec3 x(size, 0.0, 0.0);
    const glm::dvec3 y(0.0, size, 0.0);
    const glm::dvec3 z(0.0, 0.0, size);
    const glm::dvec3 corner(-0.5 * size, 0.0, -0.5 * size);
    MeshParts parts;
    parts.materials = {{.name = "white", .diffuse = {0.73, 0.73, 0.73}},
                       {.name = "red", .diffuse = {0.65, 0.05, 0.05}},
                       {.name = "green", .diffuse = {0.12, 0.45, 0.15}},
                       {.name = "light", .diffuse = {0.78, 0.78, 0.78}}};
    add_panel(parts, white, corner, z, x);
    add_panel(parts, white, corner + y, x, z);
    add_panel(parts, white, corner, x, y);
    add_panel(parts, red, corner, y, z);
    add_panel(parts, green, corner + x, z, y);
    // A hair below the ceiling, so that neither surface hides the other by chance.
    add_panel(parts, light, {-65.0, size - 0.5, -65.0}, {130.0, 0.0, 0.0}, {0.0, 0.0, 130.0});
    add_block(parts, {90.0, 90.0}, 165.0, 165.0, 17.0);
    add_block(parts, {-95.0, -75.0}, 165.0, 330.0, -18.0);
    return parts;
}

}  // namespace bruma::scene
