#pragma once
#include <glm/glm.hpp>
#include <span>

namespace bruma::render {

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
/// Radius of the sphere around the origin that holds all points.
double bounding_radius(std::span<const glm::dvec3> points);

/// Parallel rays against `back`, as close around the points as may be, with a
/// texel or two to spare.
MapCamera parallel_camera(std::span<const glm::dvec3> points, glm::dvec3 back, int size);
/// The same from a point outside the sphere around them, looking at the origin.
MapCamera perspective_camera(std::span<const glm::dvec3> points, glm::dvec3 eye, int size);
/// One of six views around a point: +x, -x, +y, -y, +z, -z.
MapCamera cube_camera(glm::dvec3 eye, int face, double bounding_radius, int size);

}  // namespace bruma::render
