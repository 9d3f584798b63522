#include "reference/clouds/cloud_geometry.h"

#include <limits>

namespace bruma::reference {

Intervals<double> CloudGeometry::intervals(const glm::dvec3& origin_world, const glm::dvec3& direction_world) const {
    if (is_shell()) {
        return shell_intervals(planet_radius_m_, altitude_m(origin_world),
                               glm::dot(direction_world, up_world(origin_world)), layer_.bottom_m, layer_.top_m);
    }
    const glm::dvec3 middle(layer_.box_center_m[0], 0.0, layer_.box_center_m[1]);
    const glm::dvec3 half(0.5 * layer_.box_size_m[0], 0.0, 0.5 * layer_.box_size_m[1]);
    return box_intervals(origin_world, direction_world, middle - half + glm::dvec3(0.0, layer_.bottom_m, 0.0),
                         middle + half + glm::dvec3(0.0, layer_.top_m, 0.0));
}

double CloudGeometry::ground_distance(const glm::dvec3& origin_world, const glm::dvec3& direction_world) const {
    constexpr double never = std::numeric_limits<double>::infinity();
    if (is_shell()) {
        const auto ground = sphere_hits(planet_radius_m_, altitude_m(origin_world),
                                        glm::dot(direction_world, up_world(origin_world)), 0.0);
        return ground.hit && ground.near > 0.0 ? ground.near : never;
    }
    return direction_world.y < 0.0 && origin_world.y > 0.0 ? -origin_world.y / direction_world.y : never;
}

double CloudGeometry::altitude_m(const glm::dvec3& point_world) const {
    return is_shell() ? altitude_above(planet_radius_m_, point_world - anchor_) : point_world.y;
}

glm::dvec3 CloudGeometry::up_world(const glm::dvec3& point_world) const {
    return is_shell() ? glm::normalize(point_world - anchor_ + glm::dvec3(0.0, planet_radius_m_, 0.0))
                      : glm::dvec3(0.0, 1.0, 0.0);
}

}  // namespace bruma::reference
