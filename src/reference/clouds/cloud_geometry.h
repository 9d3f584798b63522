#pragma once
#include <glm/glm.hpp>

#include "reference/clouds/cloud_intervals.h"
#include "scene/camera.h"
#include "scene/clouds/cloud_layer.h"

namespace bruma::reference {

/// Where a layer lies in the world, for rays and points of it. World: metres, y up, ground at y = 0; a planet has its
/// centre below `anchor_world`, the place of the camera, so that the world looks flat from there.
class CloudGeometry {
  public:
    CloudGeometry(const scene::CloudLayer& layer, const glm::dvec3& anchor_world, double planet_radius_m)
        : layer_(layer), anchor_(anchor_world.x, 0.0, anchor_world.z), planet_radius_m_(planet_radius_m) {}

    /// Parts of a ray (unit direction) inside the layer and in front of the ground.
    Intervals<double> intervals(const glm::dvec3& origin_world, const glm::dvec3& direction_world) const;
    /// Distance to the ground ahead, or infinity.
    double ground_distance(const glm::dvec3& origin_world, const glm::dvec3& direction_world) const;
    double altitude_m(const glm::dvec3& point_world) const;
    glm::dvec3 up_world(const glm::dvec3& point_world) const;
    /// (x, altitude, z): where the pattern of the clouds is looked up. In a shell it follows the curvature.
    glm::dvec3 pattern_point(const glm::dvec3& point_world) const {
        return {point_world.x, altitude_m(point_world), point_world.z};
    }
    const scene::CloudLayer& layer() const { return layer_; }

  private:
    bool is_shell() const { return layer_.bounds == scene::CloudBounds::shell; }
    scene::CloudLayer layer_;
    glm::dvec3 anchor_;
    double planet_radius_m_;
};

}  // namespace bruma::reference
