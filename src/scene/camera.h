#pragma once
#include <array>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

enum class Projection { perspective, orthographic };

template <>
inline std::span<const std::string_view> enum_words<Projection>() {
    static constexpr std::array<std::string_view, 2> words{"perspective", "orthographic"};
    return words;
}

/// Where the picture is seen from. World space: right-handed, +y up, metres.
struct Camera {
    Projection projection = Projection::perspective;
    glm::dvec3 eye_world{0.0, 0.0, 1.0};
    glm::dvec3 target_world{0.0, 0.0, 0.0};
    glm::dvec3 up_world{0.0, 1.0, 0.0};
    double vertical_angle_deg = 30.0;  ///< perspective: full angle between the lower and the upper edge
    double view_height = 1.0;          ///< orthographic: metres between the lower and the upper edge
    double near_distance = 1e-4;       ///< metres along the view direction; nothing nearer is seen

    bool operator==(const Camera&) const = default;
};

/// Orthonormal camera axes in world space; `back` points from the target to the eye.
struct CameraFrame {
    glm::dvec3 right_world, up_world, back_world;
};
/// Total: a degenerate camera (eye on target, up along the view) gets some valid frame.
CameraFrame camera_frame(const Camera& camera);

/// A ray in world space with a direction of unit length, so that `t` is a distance in metres.
struct Ray {
    glm::dvec3 origin_world;
    glm::dvec3 direction_world;
    double t_near;  ///< distance at which the near plane is crossed
};
/// The ray through a point of the picture; x in [0, width] grows to the right, y in [0, height] downwards, so that
/// pixel (i, j) of a top-row-first image has its centre at (i + 0.5, j + 0.5).
Ray camera_ray(const Camera& camera, double x, double y, int width, int height);

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Camera>
void visit_fields(Self& camera, Visitor&& visit) {
    visit(Field{.name = "projection", .sentence = "how space is laid onto the picture"}, camera.projection);
    visit(Field{.name = "eye", .unit = "m", .sentence = "where the camera stands, in world space"}, camera.eye_world);
    visit(Field{.name = "target", .unit = "m", .sentence = "the point it looks at and orbits around"},
          camera.target_world);
    visit(Field{.name = "up", .sentence = "the direction that is up in the picture"}, camera.up_world);
    visit(Field{.name = "vertical_angle",
                .unit = "deg",
                .sentence = "perspective: angle between the lower and the upper edge of the picture",
                .min = 0.1,
                .max = 170.0,
                .panel_min = 5.0,
                .panel_max = 120.0},
          camera.vertical_angle_deg);
    visit(Field{.name = "view_height",
                .unit = "m",
                .sentence = "orthographic: length between the lower and the upper edge of the picture",
                .min = 1e-12,
                .max = 1e12,
                .logarithmic = true},
          camera.view_height);
    visit(Field{.name = "near",
                .unit = "m",
                .sentence = "nothing nearer than this along the view direction is seen",
                .min = 0.0,
                .max = 1e12,
                .logarithmic = true},
          camera.near_distance);
}

}  // namespace bruma::scene
