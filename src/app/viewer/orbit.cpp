#include "app/viewer/orbit.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace bruma::app {
namespace {

/// Nearest angle to a pole, radians.
constexpr double pole_margin = 1e-3;

/// Orthonormal axes of which `up` is the pole and azimuth 0 looks from the front.
struct PolarFrame {
    glm::dvec3 right, up, front;
};
PolarFrame polar_frame(const scene::Camera& camera) {
    const double length = glm::length(camera.up_world);
    const glm::dvec3 up = length > 0.0 ? camera.up_world / length : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 rough =
        std::abs(up.z) > 0.9 ? glm::dvec3(0.0, up.z > 0.0 ? -1.0 : 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 front = glm::normalize(rough - up * glm::dot(rough, up));
    return {glm::cross(up, front), up, front};
}

double distance_of(const scene::Camera& camera) {
    return glm::length(camera.eye_world - camera.target_world);
}

scene::Camera placed(scene::Camera camera, double azimuth, double elevation, double distance) {
    const PolarFrame frame = polar_frame(camera);
    const double limit = 0.5 * glm::pi<double>() - pole_margin;
    const double e = std::clamp(elevation, -limit, limit);
    const glm::dvec3 back =
        std::cos(e) * (std::sin(azimuth) * frame.right + std::cos(azimuth) * frame.front) + std::sin(e) * frame.up;
    camera.eye_world = camera.target_world + distance * back;
    camera.near_distance = 1e-3 * distance;
    return camera;
}

}  // namespace

bool shows(const scene::Camera& camera, const scene::Bounds& bounds, double aspect) {
    const scene::CameraFrame axes = scene::camera_frame(camera);
    const double slope = std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p(corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                           corner & 4 ? bounds.high.z : bounds.low.z);
        const glm::dvec3 way = p - camera.eye_world;
        const double depth = -glm::dot(way, axes.back_world);
        const double half =
            camera.projection == scene::Projection::perspective ? depth * slope : 0.5 * camera.view_height;
        const bool inside = depth > camera.near_distance && std::abs(glm::dot(way, axes.up_world)) <= half &&
                            std::abs(glm::dot(way, axes.right_world)) <= half * aspect;
        if (!inside) {
            return false;
        }
    }
    return true;
}

scene::Camera orbited(scene::Camera camera, double azimuth, double elevation) {
    const PolarFrame frame = polar_frame(camera);
    const double distance = distance_of(camera);
    if (!(distance > 0.0)) {
        return camera;
    }
    const glm::dvec3 back = (camera.eye_world - camera.target_world) / distance;
    const double height = std::clamp(glm::dot(back, frame.up), -1.0, 1.0);
    // At a pole the azimuth is told by the camera's own up, which the picture shows.
    const scene::CameraFrame axes = scene::camera_frame(camera);
    const glm::dvec3 along = std::abs(height) > 1.0 - 1e-12 ? -std::copysign(1.0, height) * axes.up_world : back;
    const double now = std::atan2(glm::dot(along, frame.right), glm::dot(along, frame.front));
    return placed(camera, now - azimuth, std::asin(height) + elevation, distance);
}

scene::Camera panned(scene::Camera camera, glm::dvec2 pixels, double height) {
    const scene::CameraFrame axes = scene::camera_frame(camera);
    const double view_height =
        camera.projection == scene::Projection::orthographic
            ? camera.view_height
            : 2.0 * distance_of(camera) * std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    const double metres_per_pixel = view_height / std::max(1.0, height);
    const glm::dvec3 shift = metres_per_pixel * (pixels.y * axes.up_world - pixels.x * axes.right_world);
    camera.eye_world += shift;
    camera.target_world += shift;
    return camera;
}

scene::Camera zoomed(scene::Camera camera, double factor) {
    const double distance = distance_of(camera) * factor;
    if (!(distance > 1e-9) || !(distance < 1e9)) {
        return camera;
    }
    camera.eye_world = camera.target_world + factor * (camera.eye_world - camera.target_world);
    camera.view_height *= factor;
    camera.near_distance = 1e-3 * distance;
    return camera;
}

scene::Camera seen_from_side(scene::Camera camera, Side side) {
    constexpr double quarter = 0.5 * glm::pi<double>();
    const double distance = distance_of(camera);
    switch (side) {
        case Side::front:
            return placed(camera, 0.0, 0.0, distance);
        case Side::back:
            return placed(camera, 2.0 * quarter, 0.0, distance);
        case Side::left:
            return placed(camera, -quarter, 0.0, distance);
        case Side::right:
            return placed(camera, quarter, 0.0, distance);
        case Side::top:
            return placed(camera, 0.0, quarter, distance);
        default:
            return placed(camera, 0.0, -quarter, distance);
    }
}

scene::Camera with_other_projection(scene::Camera camera) {
    const double height_per_distance = 2.0 * std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    if (camera.projection == scene::Projection::perspective) {
        camera.projection = scene::Projection::orthographic;
        camera.view_height = distance_of(camera) * height_per_distance;
        return camera;
    }
    const double distance = camera.view_height / height_per_distance;
    const scene::CameraFrame axes = scene::camera_frame(camera);
    camera.projection = scene::Projection::perspective;
    camera.eye_world = camera.target_world + distance * axes.back_world;
    camera.near_distance = 1e-3 * distance;
    return camera;
}

}  // namespace bruma::app
