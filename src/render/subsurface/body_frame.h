#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/light.h"
#include "scene/mesh/mesh_data.h"

namespace bruma::render {

/// Where a translucent body is looked at from within: the mesh in millimetres around its middle, stretched as in the
/// world but not turned. What is computed here stands still while the body or all around it turns and moves, and it
/// cannot swim over the surface.
struct BodyFrame {
    glm::dmat3 body_from_model{1.0};  ///< of differences: mm per metre of the model, symmetric
    glm::dmat3 world_from_body{1.0};  ///< of directions: orthonormal, may mirror
    glm::dvec3 middle_world{0.0};     ///< of the mesh's box, metres
};
BodyFrame body_frame(const glm::dmat4& world_from_model, const scene::TriangleMesh& mesh);

/// A lamp as a body sees it, without its colour.
struct BodyLamp {
    bool has_position = false;
    glm::dvec3 toward{0.0, 0.0, 1.0};  ///< parallel light: unit, to the lamp
    glm::dvec3 position{0.0};          ///< otherwise: mm
    glm::dvec3 axis{0.0};              ///< spot: unit, against the beam; 0 for a point light
    glm::dvec2 cone{-1.0, 1.0};        ///< spot: cosine at the edge, 1 / (cosine where the edge begins to fade - that)
    bool operator==(const BodyLamp&) const = default;
};
/// `camera_back_world`, unit, is where a headlight shines from.
BodyLamp body_lamp(const scene::Light& light, const BodyFrame& frame, glm::dvec3 camera_back_world);

/// Bodies are measured in mm, the world in m.
inline constexpr double mm_per_m = 1000.0;

/// Corners of a mesh in its body frame, mm.
std::vector<glm::dvec3> body_points(const scene::TriangleMesh& mesh, const glm::dmat3& body_from_model);
/// Direction n = 1, 2, ... of a well spread sequence on the sphere: Halton's
/// points, equal areas.
glm::dvec3 halton_direction(unsigned n);
/// Van der Corput's radical inverse.
double radical_inverse(std::uint64_t n, unsigned base);

}  // namespace bruma::render
