#include "scene/camera.h"

#include <cmath>

namespace bruma::scene {

CameraFrame camera_frame(const Camera& camera) {
    glm::dvec3 back = camera.eye_world - camera.target_world;
    const double distance = glm::length(back);
    back = distance > 0.0 ? back / distance : glm::dvec3(0.0, 0.0, 1.0);
    glm::dvec3 right = glm::cross(camera.up_world, back);
    if (glm::dot(right, right) < 1e-24 * std::max(1e-300, glm::dot(camera.up_world, camera.up_world))) {
        // Looking along 'up': any axis not parallel to the view will do, and the same one every time.
        right = glm::cross(std::abs(back.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0), back);
    }
    right = glm::normalize(right);
    return {right, glm::cross(back, right), back};
}

Ray camera_ray(const Camera& camera, double x, double y, int width, int height) {
    const CameraFrame frame = camera_frame(camera);
    const double ndc_x = 2.0 * x / width - 1.0;
    const double ndc_y = 1.0 - 2.0 * y / height;
    const double aspect = double(width) / height;
    if (camera.projection == Projection::orthographic) {
        const double half_height = 0.5 * camera.view_height;
        const glm::dvec3 origin = camera.eye_world + frame.right_world * (ndc_x * aspect * half_height) +
                                  frame.up_world * (ndc_y * half_height);
        return {origin, -frame.back_world, camera.near_distance};
    }
    const double half_tangent = std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    const glm::dvec3 toward = -frame.back_world + frame.right_world * (ndc_x * aspect * half_tangent) +
                              frame.up_world * (ndc_y * half_tangent);
    const double length = glm::length(toward);
    // The view axis has length 1 in `toward`, so 1/cos of the angle to it is just `length`.
    return {camera.eye_world, toward / length, camera.near_distance * length};
}

}  // namespace bruma::scene
