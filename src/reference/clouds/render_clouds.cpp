#include "reference/clouds/render_clouds.h"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.h"
#include "reference/clouds/light_of_sky.h"
#include "reference/pixel_loop.h"
#include "scene/sky/sky.h"

namespace bruma::reference {
namespace {

void require_clouds_alone(const scene::Scene& scene) {
    for (const auto& names : {scene::shown_volumes(scene), scene::shown_meshes(scene)}) {
        if (!names.empty()) {
            throw InputError(
                fmt::format("nodes.{0}: the reference of clouds knows clouds alone; --set nodes.{0}.visible=false "
                            "leaves it out",
                            names.front()));
        }
    }
    if (!scene.camera) {
        throw InputError("camera: the scene has none; give it one");
    }
}

std::vector<CloudMedium> media_of(const scene::Scene& scene) {
    const glm::dvec3 eye = (*scene.camera)->eye_world;
    const scene::Atmosphere atmosphere = scene.outdoors ? *scene.outdoors->atmosphere : scene::Atmosphere{};
    std::vector<CloudMedium> media;
    for (const std::string& name : scene::shown_clouds(scene)) {
        const auto& clouds = std::get<scene::Clouds>(scene.nodes.at(name).content);
        const CloudField field(*clouds.layer, *clouds.map, normative_cloud_noise(clouds.layer->packing),
                               scene.time->now_s);
        media.push_back(
            medium_of(field, CloudGeometry(*clouds.layer, eye, atmosphere.planet_radius_m), *clouds.optics));
    }
    return media;
}

using AirBefore = std::function<AirLight(double distance_m)>;

struct Shade {
    glm::dvec3 radiance{0.0}, error{0.0};
    double transmittance = 1.0;
    std::uint64_t evaluations = 0;
};

Shade by_march(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
               const CloudImageOptions& options, const AirBefore& air) {
    CloudMarchOptions march = options.march;
    march.air = air;
    const CloudRayResult result =
        options.fixed_step_m ? march_once(media, light, ray, *options.fixed_step_m, options.fixed_sun_samples, march)
                             : march_clouds(media, light, ray, march);
    const double largest = std::max({result.radiance.r, result.radiance.g, result.radiance.b});
    return {result.radiance, glm::dvec3((result.view_error + result.sun_error) * std::max(largest, 1e-9)),
            result.transmittance, result.samples};
}

Shade by_paths(std::span<const CloudMedium> media, const CloudLight& light, const Pixel& pixel,
               const CloudImageOptions& options, const AirBefore& air) {
    const MonteCarloResult result = trace_paths(media, light, pixel.ray,
                                                {.samples = options.samples,
                                                 .pixel = std::uint32_t(pixel.index),
                                                 .longest_m = options.march.longest_m,
                                                 .air = air});
    return {result.radiance, result.standard_error, result.transmittance,
            std::uint64_t(result.mean_orders * options.samples)};
}

}  // namespace

CloudLight cloud_light(const scene::Scene& scene) {
    CloudLight light;
    light.sun_irradiance = [](double) { return glm::dvec3(0.0); };
    for (const auto& [name, lamp] : scene.lights) {
        if (lamp->kind == scene::LightKind::directional && scene::shines(*lamp)) {
            light.to_sun_world = glm::normalize(lamp->direction_world);
            light.sun_irradiance = [irradiance = lamp->color * lamp->intensity](double) { return irradiance; };
            break;
        }
    }
    light.set_uniform_sky(scene.environment->radiance);
    light.ground_albedo = scene::Atmosphere{}.ground_albedo;
    return light;
}

CloudSky::CloudSky(const scene::Scene& scene, const SkyTableOptions& options)
    : tables_(std::make_shared<const AtmosphereTables>(*scene.outdoors->atmosphere,
                                                       as_asked(options, *scene.outdoors->sky))),
      eye_world_((*scene.camera)->eye_world),
      irradiance_(scene.outdoors->sun->irradiance),
      light_(light_of_sky(tables_, *scene.outdoors->sun, 1.0, *scene.outdoors->sky)) {}

std::function<AirLight(double)> CloudSky::air_along(const scene::Ray& ray, double longest_m,
                                                    std::span<const CloudMedium> shading, int samples) const {
    const glm::dvec3 sea_level(eye_world_.x, 0.0, eye_world_.z);
    AirAlongRay::SunShare share;
    if (!shading.empty()) {
        share = [&](const glm::dvec3& at) {
            return std::exp(-optical_depth(shading, sea_level + at, light_.to_sun_world, samples));
        };
    }
    constexpr int steps = 512;
    const AirAlongRay air(*tables_, ray.origin_world - sea_level, ray.direction_world, light_.to_sun_world, longest_m,
                          steps, share);
    return [air, irradiance = irradiance_](double distance_m) {
        const AirLight light = air.before(distance_m);
        return AirLight{irradiance * light.radiance, light.transmittance};
    };
}

ScatteringImage render_clouds(const scene::Scene& scene, int width, int height, const CloudImageOptions& options) {
    scene::check(scene);
    require_clouds_alone(scene);
    const std::vector<CloudMedium> media = media_of(scene);
    std::optional<CloudSky> sky;
    if (scene.outdoors) {
        sky.emplace(scene, options.sky_tables);
    }
    const CloudLight light = sky ? sky->light() : cloud_light(scene);
    ScatteringImage out;
    out.image = Image(width, height);
    out.error.resize(std::size_t(width) * height);
    std::atomic<std::uint64_t> evaluations{0};
    for_each_pixel(scene, width, height, options.progress, [&](const Pixel& pixel) {
        if (!options.wanted.empty() && options.wanted[pixel.index] == 0) {
            return;
        }
        AirBefore air;
        if (sky) {
            air = sky->air_along(
                pixel.ray, options.march.longest_m,
                scene.outdoors->sky->shafts ? std::span<const CloudMedium>(media) : std::span<const CloudMedium>());
        }
        const Shade shade = options.paths == LightPaths::single ? by_march(media, light, pixel.ray, options, air)
                                                                : by_paths(media, light, pixel, options, air);
        const glm::dvec3 seen = shade.radiance + shade.transmittance * pixel.background;
        float* const rgba = out.image.pixel(pixel.x, pixel.y);
        for (int k = 0; k < 3; ++k) {
            rgba[k] = float(seen[k]);
        }
        rgba[3] = float(1.0 - shade.transmittance);
        out.error[pixel.index] = glm::vec3(shade.error);
        evaluations += shade.evaluations;
    });
    double squares = 0.0;
    for (const glm::vec3& error : out.error) {
        for (int k = 0; k < 3; ++k) {
            out.largest_error = std::max(out.largest_error, double(error[k]));
            squares += double(error[k]) * error[k];
        }
    }
    out.rms_error = std::sqrt(squares / (3.0 * double(out.error.size())));
    out.evaluations = evaluations;
    return out;
}

}  // namespace bruma::reference
