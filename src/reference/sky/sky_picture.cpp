#include "reference/sky/sky_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/pixel_loop.h"
#include "reference/sky/sky_look.h"

namespace bruma::reference {
namespace {

double climb_of(double place) {
    const double root = 2.0 * place - 1.0;
    return root * std::abs(root);
}

}  // namespace

SkyTableOptions fine_sky_tables() {
    return {.transmittance_size = {512, 128},
            .transmittance_steps = 200,
            .multiple_size = {48, 48},
            .multiple_directions = 12,
            .multiple_steps = 40};
}

SkyTableOptions as_asked(SkyTableOptions options, const scene::Sky& sky) {
    options.multiple_scattering = options.multiple_scattering && sky.multiple_scattering;
    return options;
}

SkyPath sky_path(const AtmosphereTables& tables, const glm::dvec3& from, const glm::dvec3& direction,
                 const glm::dvec3& to_sun, int steps) {
    const scene::Atmosphere& air = tables.atmosphere();
    const glm::dvec3 center(0.0, -air.planet_radius_m, 0.0);
    const double top = air.planet_radius_m + air.height_m;
    glm::dvec3 start = from;
    // The textbook form of where a line meets a sphere: doubles hold it.
    if (const glm::dvec3 out = from - center; glm::length(out) > top) {
        const double b = glm::dot(out, direction), root = b * b - glm::dot(out, out) + top * top;
        if (root <= 0.0 || b > 0.0) {
            return {};
        }
        start += (-b - std::sqrt(root)) * direction;
    }
    const glm::dvec3 up = glm::normalize(start - center);
    const double altitude = std::clamp(glm::length(start - center) - air.planet_radius_m, 0.0, air.height_m);
    // A frame with y up there and the ray in the plane of x and y.
    const double climb = std::clamp(glm::dot(direction, up), -1.0, 1.0);
    const glm::dvec3 level = direction - climb * up;
    const glm::dvec3 x =
        glm::length(level) > 1e-9 ? glm::normalize(level) : glm::normalize(glm::cross(up, glm::dvec3(0.3, 0.1, 0.9)));
    const glm::dvec3 local_direction(std::sqrt(1.0 - climb * climb), climb, 0.0);
    const glm::dvec3 local_sun(glm::dot(to_sun, x), glm::dot(to_sun, up), glm::dot(to_sun, glm::cross(x, up)));
    const double length = distance_to_end(air, altitude, climb);
    SkyPath path{tables.air_light(altitude, local_direction, local_sun, length, steps), {}};
    if (climb < horizon_climb(air, altitude)) {
        path.sun_climb_at_ground = glm::dot(glm::normalize(start + length * direction - center), to_sun);
    }
    return path;
}

SkyBackground::SkyBackground(const scene::Scene& scene, SkyTableOptions options)
    : outdoors_(*scene.outdoors),
      eye_world_((*scene.camera)->eye_world),
      to_sun_(scene::to_sun_world(*outdoors_.sun)),
      tables_(*outdoors_.atmosphere, as_asked(options, *outdoors_.sky)),
      model_share_(scene::ground_sky_share(std::max(1.0, eye_world_.y))),
      sky_on_ground_(65) {
    const scene::Sky& sky = *outdoors_.sky;
    const bool has_model = sky.model != scene::SkyModel::atmosphere;
    if (has_model) {
        model_.emplace(sky, to_sun_, SkyView(tables_, 1.0, to_sun_, {64, 64}, 40).planar_irradiance());
    }
    tbb::parallel_for(std::size_t(0), sky_on_ground_.size(), [&](std::size_t n) {
        const double climb = climb_of(double(n) / double(sky_on_ground_.size() - 1));
        const glm::dvec3 to_sun(std::sqrt(std::max(0.0, 1.0 - climb * climb)), climb, 0.0);
        const glm::dvec3 planar = SkyView(tables_, 1.0, to_sun, {32, 64}, 40).planar_irradiance();
        sky_on_ground_[n] = has_model ? GroundSky(sky, to_sun, planar).irradiance().planar : planar;
    });
}

/// The planet goes with the camera, and one metre is the lowest eye.
glm::dvec3 SkyBackground::from_sea_level(const glm::dvec3& point_world) const {
    const glm::dvec3 offset = point_world - eye_world_;
    const double planet = outdoors_.atmosphere->planet_radius_m;
    const glm::dvec3 from(offset.x, std::max(1.0, eye_world_.y) + offset.y, offset.z);
    const glm::dvec3 out = from + glm::dvec3(0.0, planet, 0.0);
    return glm::length(out) >= planet + 1.0 ? from : from + glm::normalize(out) * (planet + 1.0 - glm::length(out));
}

glm::dvec3 SkyBackground::ground_radiance(double sun_climb) const {
    const double root = std::sqrt(std::abs(sun_climb));
    const double at = 0.5 * (1.0 + (sun_climb < 0.0 ? -root : root)) * double(sky_on_ground_.size() - 1);
    const auto low = std::min(std::size_t(at), sky_on_ground_.size() - 2);
    const glm::dvec3 sky = glm::mix(sky_on_ground_[low], sky_on_ground_[low + 1], at - double(low));
    const glm::dvec3 sun = std::max(0.0, sun_climb) * tables_.sun_transmittance(0.0, sun_climb);
    return outdoors_.atmosphere->ground_albedo * std::numbers::inv_pi * (sun + sky);
}

glm::dvec3 SkyBackground::radiance(const scene::Ray& ray, int steps) const {
    const glm::dvec3 irradiance = outdoors_.sun->irradiance;
    const SkyPath path = sky_path(tables_, from_sea_level(ray.origin_world), ray.direction_world, to_sun_, steps);
    const glm::dvec3 ground = path.sun_climb_at_ground ? ground_radiance(*path.sun_climb_at_ground) : glm::dvec3(0.0);
    const glm::dvec3 seen = path.air.radiance + path.air.transmittance * ground;
    if (!model_ || path.sun_climb_at_ground) {
        return irradiance * seen;
    }
    return irradiance * glm::mix(seen, model_->radiance(ray.direction_world), model_share_);
}

bool SkyBackground::near_disc(const scene::Ray& ray, double margin_rad) const {
    const double angle = std::acos(std::clamp(glm::dot(ray.direction_world, to_sun_), -1.0, 1.0));
    const double own = outdoors_.sky->model == scene::SkyModel::look ? look_disc_radius : 0.0;
    return angle < std::max(own, glm::radians(outdoors_.sun->angular_radius_deg)) + margin_rad;
}

glm::dvec3 SkyBackground::disc(const scene::Ray& ray) const {
    const scene::Sun& sun = *outdoors_.sun;
    const double angle =
        std::atan2(glm::length(glm::cross(ray.direction_world, to_sun_)), glm::dot(ray.direction_world, to_sun_));
    const glm::dvec3 bare = sun_disc_radiance(angle, glm::radians(sun.angular_radius_deg), sun.limb_darkening);
    const bool own = outdoors_.sky->model == scene::SkyModel::look;
    if (bare == glm::dvec3(0.0) && !own) {
        return bare;
    }
    const SkyPath path = sky_path(tables_, from_sea_level(ray.origin_world), ray.direction_world, to_sun_, 1000);
    if (path.sun_climb_at_ground) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 behind_air = bare * path.air.transmittance;
    return sun.irradiance * (own ? glm::mix(behind_air, model_->disc(ray.direction_world), model_share_) : behind_air);
}

SkyPictureResult render_sky(const scene::Scene& scene, int width, int height, int steps,
                            const std::function<void(double)>& progress) {
    const SkyBackground sky(scene);
    const scene::Camera& camera = **scene.camera;
    SkyPictureResult result;
    result.image = Image(std::max(width, 0), std::max(height, 0));
    result.error.resize(result.image.pixel_count());
    const double pixel_angle =
        camera.projection == scene::Projection::orthographic ? 0.0 : glm::radians(camera.vertical_angle_deg) / height;
    for_each_pixel(scene, width, height, progress, [&](const Pixel& pixel) {
        glm::dvec3 radiance = sky.radiance(pixel.ray, steps);
        const glm::dvec3 apart = glm::abs(radiance - sky.radiance(pixel.ray, steps / 2));
        if (sky.near_disc(pixel.ray, pixel_angle)) {
            constexpr int edge = 8;
            for (int j = 0; j < edge; ++j) {
                for (int i = 0; i < edge; ++i) {
                    const double x = pixel.x + (i + 0.5) / edge, y = pixel.y + (j + 0.5) / edge;
                    radiance += sky.disc(scene::camera_ray(camera, x, y, width, height)) / double(edge * edge);
                }
            }
        }
        for (int channel = 0; channel < 3; ++channel) {
            result.image.pixel(pixel.x, pixel.y)[channel] = float(radiance[channel]);
        }
        result.error[pixel.index] = float(std::max({apart.x, apart.y, apart.z}));
    });
    double squares = 0.0;
    for (const float error : result.error) {
        result.largest_error = std::max(result.largest_error, double(error));
        squares += double(error) * error;
    }
    result.rms_error = std::sqrt(squares / double(result.error.size()));
    return result;
}

}  // namespace bruma::reference
