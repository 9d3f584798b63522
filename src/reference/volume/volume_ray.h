#pragma once
#include <limits>

#include "reference/volume/prepared_volume.h"
#include "scene/camera.h"

namespace bruma::reference {

/// A ray as one volume sees it: where it is inside, and which planes of samples it meets. Each plane's distance is
/// computed afresh, so that nothing drifts.
struct VolumeRay {
    struct Plane {
        double t = std::numeric_limits<double>::infinity();
        int axis = 0;
    };

    /// The part of the ray from its near plane to `t_far`, both in metres.
    VolumeRay(const PreparedVolume& volume, const scene::Ray& ray, double t_far);

    bool misses() const { return !(t_out > t_in); }
    glm::dvec3 voxel_at(double t) const { return origin_voxel + t * direction_voxel; }
    /// The cell entered at t (on a plane, the one ahead), at most one beyond the outermost cells.
    glm::ivec3 cell_at(double t) const;
    /// The first of the three planes ahead.
    Plane nearest_plane(glm::ivec3 plane_ahead) const;
    /// The planes that the ray leaves a box of cells by: those of its first cell or those behind its last one.
    glm::ivec3 planes_ahead(glm::ivec3 first_cell, int edge) const;

    const PreparedVolume* volume;
    glm::dvec3 origin_texture, direction_texture;  ///< the direction per metre of the world, so that t stays a distance
    glm::dvec3 origin_voxel, direction_voxel;      ///< sample (i, j, k) at (i, j, k)
    double t_in = 0.0, t_out = 0.0;                ///< distances in the world between which the ray is in the clip box
};

}  // namespace bruma::reference
