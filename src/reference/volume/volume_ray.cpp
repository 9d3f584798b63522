#include "reference/volume/volume_ray.h"

#include <algorithm>
#include <cmath>

namespace bruma::reference {

VolumeRay::VolumeRay(const PreparedVolume& prepared, const scene::Ray& ray, double t_far)
    : volume(&prepared),
      origin_texture(prepared.texture_from_world * glm::dvec4(ray.origin_world, 1.0)),
      direction_texture(glm::dmat3(prepared.texture_from_world) * ray.direction_world),
      origin_voxel(origin_texture * prepared.size() - 0.5),
      direction_voxel(direction_texture * prepared.size()) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const glm::dvec3 size = glm::abs(direction_texture);
    const double parallel = 1e-20 * std::max({size.x, size.y, size.z});
    t_in = -infinity;
    t_out = infinity;
    for (int axis = 0; axis < 3; ++axis) {
        const double low = prepared.clip.low[axis] - origin_texture[axis];
        const double high = prepared.clip.high[axis] - origin_texture[axis];
        if (std::abs(direction_texture[axis]) <= parallel) {
            // A branch of its own: on a face, 0 * infinity would be NaN.
            direction_texture[axis] = 0.0;
            direction_voxel[axis] = 0.0;
            if (low > 0.0 || high < 0.0) {
                t_out = -infinity;
            }
            continue;
        }
        const double t_low = low / direction_texture[axis];
        const double t_high = high / direction_texture[axis];
        t_in = std::max(t_in, std::min(t_low, t_high));
        t_out = std::min(t_out, std::max(t_low, t_high));
    }
    t_in = std::max(t_in, ray.t_near);
    t_out = std::min(t_out, t_far);
}

glm::ivec3 VolumeRay::cell_at(double t) const {
    glm::ivec3 cell;
    for (int axis = 0; axis < 3; ++axis) {
        const double p = origin_voxel[axis] + t * direction_voxel[axis];
        const double index = direction_voxel[axis] < 0.0 ? std::ceil(p) - 1.0 : std::floor(p);
        cell[axis] = int(std::clamp(index, -2.0, double(volume->field.grid().size[axis])));
    }
    return cell;
}

VolumeRay::Plane VolumeRay::nearest_plane(glm::ivec3 plane_ahead) const {
    Plane nearest;
    for (int axis = 0; axis < 3; ++axis) {
        if (direction_voxel[axis] != 0.0) {
            const double t = (double(plane_ahead[axis]) - origin_voxel[axis]) / direction_voxel[axis];
            if (t < nearest.t) {
                nearest = {t, axis};
            }
        }
    }
    return nearest;
}

glm::ivec3 VolumeRay::planes_ahead(glm::ivec3 first_cell, int edge) const {
    glm::ivec3 ahead = first_cell;
    for (int axis = 0; axis < 3; ++axis) {
        ahead[axis] += direction_voxel[axis] > 0.0 ? edge : 0;
    }
    return ahead;
}

}  // namespace bruma::reference
