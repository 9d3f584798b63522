#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
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

/// A camera around a body: parallel rays along -back, or rays from `eye`. Coordinates across the view are mm, or
/// tangents.
struct MapCamera {
    glm::dvec3 right{1.0, 0.0, 0.0}, up{0.0, 1.0, 0.0}, back{0.0, 0.0, 1.0};  ///< orthonormal
    bool perspective = false;
    glm::dvec3 eye{0.0};
    glm::dvec2 low{-1.0}, high{1.0};       ///< across the view
    double near_depth = 0.0, depth = 1.0;  ///< -back . (p - eye) of the nearest point, and how much further the last is
    glm::dvec2 texel{1.0};                 ///< across the view
    glm::dmat4 clip_from_body() const;
};

/// Bodies are measured in mm, the world in m.
inline constexpr double mm_per_m = 1000.0;

/// A map camera as shaders read it (std430).
struct MapFace {
    glm::vec4 right;   ///< w: texels to the unit of length along it
    glm::vec4 up;      ///< w: the same
    glm::vec4 toward;  ///< `back`; w: the layer of the texture that holds the map
    glm::vec4 first;   ///< xy: texel of the coordinate 0; z: near_depth; w: depth
};
MapFace map_face(const MapCamera& camera, int layer);

/// Right and up for a direction.
MapCamera looking_against(glm::dvec3 back);
/// Corners of a mesh in its body frame, mm.
std::vector<glm::dvec3> body_points(const scene::TriangleMesh& mesh, const glm::dmat3& body_from_model);
/// Radius of the sphere around the origin that holds all points.
double bounding_radius(std::span<const glm::dvec3> points);

/// Parallel rays against `back`, as close around the points as may be, with a
/// texel or two to spare.
MapCamera parallel_camera(std::span<const glm::dvec3> points, glm::dvec3 back, int size);
/// The same from a point outside the sphere around them, looking at the origin.
MapCamera perspective_camera(std::span<const glm::dvec3> points, glm::dvec3 eye, int size);
/// One of six views around a point: +x, -x, +y, -y, +z, -z.
MapCamera cube_camera(glm::dvec3 eye, int face, double bounding_radius, int size);

/// Direction n = 1, 2, ... of a well spread sequence on the sphere: Halton's
/// points, equal areas.
glm::dvec3 halton_direction(unsigned n);
/// Van der Corput's radical inverse.
double radical_inverse(std::uint64_t n, unsigned base);

}  // namespace bruma::render
