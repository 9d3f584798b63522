#include "render/map_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::render {
namespace {

constexpr double spare_texels = 2.0;

/// Widens the view by `spare_texels` on each side and says how large a texel
/// then is.
void spare(MapCamera& camera, int size) {
    // No narrower than a millionth of how deep the body is; across a perspective view lengths are tangents.
    const double unit = camera.perspective ? std::max(camera.near_depth + camera.depth, 1e-30) : 1.0;
    const glm::dvec2 extent = glm::max(camera.high - camera.low, glm::dvec2(1e-6 * (camera.depth + 1e-30) / unit));
    const glm::dvec2 margin = extent * (spare_texels / std::max(1.0, size - 2.0 * spare_texels));
    const glm::dvec2 middle = 0.5 * (camera.low + camera.high);
    camera.low = middle - 0.5 * extent - margin;
    camera.high = middle + 0.5 * extent + margin;
    camera.texel = (camera.high - camera.low) / double(size);
}

}  // namespace

glm::dmat4 MapCamera::clip_from_body() const {
    const glm::dvec2 scale = 2.0 / (high - low);
    const glm::dvec2 middle = 0.5 * (low + high);
    glm::dmat4 view(1.0);
    for (int k = 0; k < 3; ++k) {
        view[k] = glm::dvec4(right[k], up[k], back[k], 0.0);
    }
    const glm::dvec3 origin = perspective ? eye : glm::dvec3(0.0);
    view[3] = glm::dvec4(-glm::dot(right, origin), -glm::dot(up, origin), -glm::dot(back, origin), 1.0);
    glm::dmat4 clip(0.0);
    clip[0][0] = scale.x;
    clip[1][1] = scale.y;
    if (perspective) {
        // Coordinates are tangents: x / -z.
        clip[2] = glm::dvec4(scale.x * middle.x, scale.y * middle.y, -(near_depth + depth) / depth, -1.0);
        clip[3][2] = -near_depth * (near_depth + depth) / depth;
    } else {
        clip[2][2] = -1.0 / depth;
        clip[3] = glm::dvec4(-scale.x * middle.x, -scale.y * middle.y, -near_depth / depth, 1.0);
    }
    return clip * view;
}

MapCamera looking_against(glm::dvec3 back) {
    MapCamera camera;
    camera.back = glm::normalize(back);
    const glm::dvec3 beside = std::abs(camera.back.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    camera.right = glm::normalize(glm::cross(beside, camera.back));
    camera.up = glm::cross(camera.back, camera.right);
    return camera;
}

MapCamera parallel_camera(std::span<const glm::dvec3> points, glm::dvec3 back, int size) {
    MapCamera camera = looking_against(back);
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& p : points) {
        const glm::dvec3 q(glm::dot(camera.right, p), glm::dot(camera.up, p), -glm::dot(camera.back, p));
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    camera.low = low;
    camera.high = high;
    const double slack = 1e-3 * glm::length(high - low) + 1e-30;
    camera.near_depth = low.z - slack;
    camera.depth = high.z - low.z + 2.0 * slack;
    spare(camera, size);
    return camera;
}

MapCamera perspective_camera(std::span<const glm::dvec3> points, glm::dvec3 eye, int size) {
    MapCamera camera = looking_against(eye);
    camera.perspective = true;
    camera.eye = eye;
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& p : points) {
        const glm::dvec3 from_eye = p - eye;
        const double depth = -glm::dot(camera.back, from_eye);
        const glm::dvec3 q(glm::dot(camera.right, from_eye) / depth, glm::dot(camera.up, from_eye) / depth, depth);
        low = glm::min(low, q);
        high = glm::max(high, q);
    }
    camera.low = low;
    camera.high = high;
    camera.near_depth = 0.999 * low.z;
    camera.depth = 1.001 * high.z - camera.near_depth;
    spare(camera, size);
    return camera;
}

MapCamera cube_camera(glm::dvec3 eye, int face, double bounding_radius, int size) {
    glm::dvec3 back(0.0);
    back[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
    MapCamera camera = looking_against(back);
    camera.perspective = true;
    camera.eye = eye;
    camera.near_depth = 1e-4 * bounding_radius;
    camera.depth = glm::length(eye) + 1.01 * bounding_radius;
    spare(camera, size);
    return camera;
}

MapFace map_face(const MapCamera& camera, int layer) {
    return {glm::vec4(camera.right, 1.0 / camera.texel.x), glm::vec4(camera.up, 1.0 / camera.texel.y),
            glm::vec4(camera.back, double(layer)),
            glm::vec4(-camera.low / camera.texel, camera.near_depth, camera.depth)};
}

double bounding_radius(std::span<const glm::dvec3> points) {
    double squared = 0.0;
    for (const glm::dvec3& p : points) {
        squared = std::max(squared, glm::dot(p, p));
    }
    return std::max(std::sqrt(squared), 1e-30);
}

}  // namespace bruma::render
