#pragma once
#include <vector>

#include "scene/scene.h"

namespace bruma::reference {

/// Local shading of a volume by the gradient of its data: Lambert's law and a highlight (Phong, CACM 1975; Blinn,
/// SIGGRAPH 1977), faded out where the gradient is too small to be a normal. The law in
/// numbers stands at scene::VolumeOptics.
class GradientShading {
  public:
    /// `smallest_voxel_edge` in metres of the world, `shading_range` (scene/volume/volume.h) in data units; both make
    /// the gradient a pure number.
    GradientShading(const scene::Scene& scene, const scene::VolumeOptics& optics, double smallest_voxel_edge,
                    double shading_range);

    /// Radiance of matter of this colour per unit of extinction, without its own emission. The gradient is in data
    /// units per metre of the world; the ray direction, of unit length, leads away from the eye. Total.
    glm::dvec3 lit(glm::dvec3 color, glm::dvec3 gradient_world, glm::dvec3 position_world,
                   glm::dvec3 ray_direction_world) const;

    /// Where the data have a surface: how much of one in [0, 1], and its unit normal, to the eye if two-sided.
    struct Surface {
        double share = 0.0;
        glm::dvec3 normal_world{0.0};
    };
    Surface surface_at(glm::dvec3 gradient_world, glm::dvec3 ray_direction_world) const;

    /// Light reflected to the eye by a surface: a factor of its colour, and what is added in the light's own colour.
    struct Reflected {
        glm::dvec3 diffuse{0.0}, highlight{0.0};
    };
    Reflected reflect(const Surface& surface, const scene::Incident& incident, glm::dvec3 ray_direction_world) const;

    /// Appends numbers whose change of sign along a ray marks a bend or a jump of `lit`: the normal turning over
    /// against the eye or a light, and both ends of the soft stretch of gradients. Always the same count, in the same
    /// order.
    void append_bends(glm::dvec3 gradient_world, glm::dvec3 position_world, glm::dvec3 ray_direction_world,
                      std::vector<double>& bends) const;

    /// Whether the shading changes little between three neighbouring gradients on a ray. Where the gradient passes near
    /// 0 the normal swings round within a sliver of a cell, which quadrature would miss without noticing.
    bool is_resolved(glm::dvec3 begin, glm::dvec3 middle, glm::dvec3 end) const;

  private:
    double highlight(glm::dvec3 normal, glm::dvec3 to_light, glm::dvec3 to_eye) const;

    scene::VolumeOptics optics_;
    double share_per_gradient_;  ///< share of the shading range per voxel, for a gradient of 1 data unit per metre
    double largest_turn_;        ///< of the gradient, relative to its length, that counts as resolved
    std::vector<scene::Light> lights_;  ///< those that shine
    glm::dvec3 camera_back_world_;
};

}  // namespace bruma::reference
