#include "render/view_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::render {

double skipped_distance(const scene::Camera& camera, const scene::Bounds& shown) {
    if (camera.projection != scene::Projection::orthographic) {
        return 0.0;
    }
    const glm::dvec3 back = scene::camera_frame(camera).back_world;
    const double distance = glm::dot(camera.eye_world - 0.5 * (shown.low + shown.high), back);
    return distance < 16.0 * glm::length(shown.high - shown.low) ? 0.0 : distance;
}

scene::Camera started_nearer(const scene::Camera& camera, double skipped) {
    if (skipped == 0.0) {
        return camera;
    }
    const glm::dvec3 back = scene::camera_frame(camera).back_world;
    scene::Camera nearer = camera;
    nearer.eye_world -= skipped * back;
    nearer.target_world = nearer.eye_world - back;
    nearer.near_distance -= skipped;
    return nearer;
}

glm::dvec2 half_view(const scene::Camera& camera, glm::ivec2 pixels, double unit_world) {
    const double half_height = camera.projection == scene::Projection::orthographic
                                   ? 0.5 * camera.view_height / unit_world
                                   : std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    return {half_height * pixels.x / pixels.y, half_height};
}

std::vector<std::string> order_lights(const scene::Scene& scene) {
    std::vector<std::string> lights;
    for (const bool points : {false, true}) {
        for (const auto& [name, light] : scene.lights) {
            if (scene::shines(*light) && scene::has_position(*light) == points) {
                lights.push_back(name);
            }
        }
    }
    return lights;
}

void count_lights(gl::Defines& defines, const std::vector<scene::Light>& lights) {
    const auto points =
        std::count_if(lights.begin(), lights.end(), [](const auto& light) { return scene::has_position(light); });
    defines["POINT_LIGHTS"] = std::to_string(points);
    defines["DIRECTIONAL_LIGHTS"] = std::to_string(std::ptrdiff_t(lights.size()) - points);
}

void set_lights(gl::Program& program, const std::vector<scene::Light>& lights, const scene::Camera& camera,
                double unit_world) {
    const glm::dvec3 back = scene::camera_frame(camera).back_world;
    for (std::size_t n = 0; n < lights.size(); ++n) {
        const scene::Light& light = lights[n];
        // A Lambert surface under irradiance E has radiance E / pi.
        glm::dvec3 radiance = light.color * light.intensity / std::numbers::pi;
        glm::dvec3 toward = light.kind == scene::LightKind::headlight ? back : light.direction_world;
        glm::vec3 axis(0.0F);
        glm::vec2 cone(-1.0F, 1.0F);  // a point light: full everywhere
        if (scene::has_position(light)) {
            radiance /= unit_world * unit_world;
            toward = (light.position_world - camera.eye_world) / unit_world;
            // Shaders square distances: from where floats would end, a light stands nearer and shines as much less.
            constexpr double farthest = 1e18;
            if (const double nearer = farthest / std::max(farthest, glm::length(toward)); nearer < 1.0) {
                toward = std::isfinite(glm::length(toward)) ? toward * nearer : glm::dvec3(farthest, 0.0, 0.0);
                radiance *= nearer * nearer;
            }
            if (light.kind == scene::LightKind::spot) {
                const double outer = std::cos(glm::radians(light.spot_angle_deg));
                const double inner = std::cos(glm::radians(light.spot_angle_deg * (1.0 - light.spot_softness)));
                axis = glm::normalize(light.direction_world);
                cone = {outer, 1.0 / std::max(inner - outer, 1e-6)};
            }
        } else {
            toward = glm::normalize(toward);
        }
        program.set_at("light_uniforms", int(n), ".irradiance", glm::vec3(radiance));
        program.set_at("light_uniforms", int(n), ".toward", glm::vec3(toward));
        program.set_at("light_uniforms", int(n), ".axis", axis);
        program.set_at("light_uniforms", int(n), ".cone", cone);
    }
}

}  // namespace bruma::render
