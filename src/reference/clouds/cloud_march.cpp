#include "reference/clouds/cloud_march.h"

#include <algorithm>
#include <cmath>

#include "reference/clouds/cloud_phase.h"

namespace bruma::reference {
namespace {

/// Sum of density times length times the weight of each layer, over the six samples of a layer's cone.
template <class WeightOf>
double along_cone(std::span<const CloudMedium> media, const CloudMedium& own, const glm::dvec3& from,
                  const glm::dvec3& to_sun, const WeightOf& weight_of) {
    const auto leave = own.geometry.intervals(from, to_sun);
    const double exit = leave.count > 0 ? leave.parts[0].end : 0.0;
    const scene::CloudLayer& layer = own.geometry.layer();
    double sum = 0.0;
    for (const ConeSample& sample : cone_samples(own.optics, layer.top_m - layer.bottom_m, exit)) {
        const glm::dvec3 at = from + sample.distance_m * to_sun + sample.offset_world;
        for (const CloudMedium& medium : media) {
            sum += weight_of(medium) * medium.density(medium.geometry.pattern_point(at)) * sample.length_m;
        }
    }
    return sum;
}

/// The same along a straight ray to its end, by midpoints in each stretch of the same layers.
template <class WeightOf>
double along_line(std::span<const CloudMedium> media, const glm::dvec3& from, const glm::dvec3& direction, int samples,
                  const WeightOf& weight_of) {
    double sum = 0.0;
    for (const CloudStretch& stretch : stretches(media, from, direction)) {
        const double step = (stretch.end_m - stretch.begin_m) / samples;
        for (int n = 0; n < samples; ++n) {
            const glm::dvec3 at = from + (stretch.begin_m + (n + 0.5) * step) * direction;
            for (const CloudMedium* medium : stretch.media) {
                sum += weight_of(*medium) * medium->density(medium->geometry.pattern_point(at)) * step;
            }
        }
    }
    return sum;
}

/// Source radiance of one layer at one point, per scattering coefficient.
class PointLight {
  public:
    PointLight(std::span<const CloudMedium> media, const CloudLight& light, const glm::dvec3& view, int samples,
               SunPath path)
        : media_(media), light_(light), mu_(glm::dot(view, light.to_sun_world)), samples_(samples), path_(path) {}

    glm::dvec3 source(const CloudMedium& medium, const glm::dvec3& at) const {
        const double altitude = medium.geometry.altitude_m(at);
        const bool planet_hides_sun = std::isfinite(medium.geometry.ground_distance(at, light_.to_sun_world));
        const glm::dvec3 sun = planet_hides_sun ? glm::dvec3(0.0) : light_.sun_irradiance(altitude);
        if (medium.optics.lighting == scene::CloudLighting::artistic) {
            const auto absorption = [](const CloudMedium& other) {
                return other.optics.absorption / other.optics.reference_length_m;
            };
            const double x = towards_sun(medium, at, absorption);
            const scene::CloudLayer& layer = medium.geometry.layer();
            const double height = std::clamp((altitude - layer.bottom_m) / (layer.top_m - layer.bottom_m), 0.0, 1.0);
            return artistic_scatter(mu_, x, medium.optics) * sun +
                   medium.optics.ambient * glm::mix(light_.sky_bottom, light_.sky_top, height);
        }
        const auto extinction = [](const CloudMedium& other) { return other.optics.extinction_per_m; };
        if (medium.optics.multiple_scattering == scene::MultipleScattering::diffusion) {
            return medium.optics.albedo * diffused(medium, at, sun, towards_sun(medium, at, extinction));
        }
        glm::dvec3 source(0.0);
        if (sun != glm::dvec3(0.0)) {
            source += scattering_octaves(mu_, towards_sun(medium, at, extinction), medium.optics) * sun;
        }
        const bool dark = light_.sky_scalar_irradiance == glm::dvec3(0.0) && light_.ground_albedo == glm::dvec3(0.0);
        if (medium.optics.ambient > 0.0 && !dark) {
            const glm::dvec3 up = medium.geometry.up_world(at);
            source +=
                medium.optics.ambient * ambient_source(light_, up, along_line(media_, at, up, samples_, extinction),
                                                       along_line(media_, at, -up, samples_, extinction));
        }
        return medium.optics.albedo * source;
    }

  private:
    glm::dvec3 diffused(const CloudMedium& medium, const glm::dvec3& at, const glm::dvec3& sun,
                        double towards_sun) const {
        const auto extinction = [](const CloudMedium& other) { return other.optics.extinction_per_m; };
        const glm::dvec3 up = medium.geometry.up_world(at);
        const CloudDepths depths{towards_sun, along_line(media_, at, up, samples_, extinction),
                                 along_line(media_, at, -up, samples_, extinction)};
        const double scattered = dual_lobe(mu_, medium.optics) * std::exp(-depths.sun) +
                                 scattered_again(mu_, light_.to_sun_world.y, depths, medium.optics);
        return scattered * sun + medium.optics.ambient * diffused_ambient_source(light_, up, depths, medium.optics);
    }
    template <class WeightOf>
    double towards_sun(const CloudMedium& medium, const glm::dvec3& at, const WeightOf& weight_of) const {
        return path_ == SunPath::cone ? along_cone(media_, medium, at, light_.to_sun_world, weight_of)
                                      : along_line(media_, at, light_.to_sun_world, samples_, weight_of);
    }
    std::span<const CloudMedium> media_;
    const CloudLight& light_;
    double mu_;
    int samples_;
    SunPath path_;
};

/// Of radiance relative to its largest channel, or of transmittance, whichever is larger.
double difference(const CloudRayResult& coarse, const CloudRayResult& fine) {
    const glm::dvec3 apart = glm::abs(coarse.radiance - fine.radiance);
    const double size = std::max({fine.radiance.r, fine.radiance.g, fine.radiance.b, 1e-9});
    return std::max(std::max({apart.r, apart.g, apart.b}) / size, std::abs(coarse.transmittance - fine.transmittance));
}

}  // namespace

double optical_depth(std::span<const CloudMedium> media, const glm::dvec3& from_world,
                     const glm::dvec3& direction_world, int samples) {
    return along_line(media, from_world, direction_world, samples,
                      [](const CloudMedium& medium) { return medium.optics.extinction_per_m; });
}

CloudRayResult march_once(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                          double step_m, int sun_samples, const CloudMarchOptions& options) {
    const PointLight point_light(media, light, ray.direction_world, sun_samples, options.sun_path);
    CloudRayResult result;
    result.step_m = step_m;
    result.sun_samples = sun_samples;
    double hidden = 0.0, hidden_distance = 0.0;
    for (const CloudStretch& stretch : stretches(media, ray.origin_world, ray.direction_world, options.longest_m)) {
        // Equal segments tile the stretch, so that halving the step halves every one of them.
        const double length = stretch.end_m - stretch.begin_m;
        const auto segments = std::uint64_t(std::ceil(length / step_m));
        const double ds = length / double(segments);
        for (std::uint64_t n = 0; n < segments && result.transmittance > options.stop_transmittance; ++n) {
            const double t = stretch.begin_m + (double(n) + 0.5) * ds;
            const glm::dvec3 at = ray.origin_world + t * ray.direction_world;
            ++result.samples;
            double extinction = 0.0;
            glm::dvec3 extinction_times_source(0.0);
            for (const CloudMedium* medium : stretch.media) {
                if (const double own = medium->extinction_per_m(at); own > 0.0) {
                    extinction += own;
                    extinction_times_source += own * point_light.source(*medium, at);
                }
            }
            if (extinction > 0.0) {
                const AirLight air = options.air ? options.air(t) : AirLight{};
                const double passed = result.transmittance * std::exp(-extinction * ds);
                result.radiance += air.transmittance * result.transmittance * extinction_times_source *
                                       segment_weight(extinction, ds) +
                                   air.radiance * (result.transmittance - passed);
                hidden += result.transmittance - passed;
                hidden_distance += t * (result.transmittance - passed);
                result.transmittance = passed;
            }
        }
    }
    result.mean_distance_m = hidden > 1e-6 ? hidden_distance / hidden : 0.0;
    return result;
}

CloudRayResult march_clouds(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                            const CloudMarchOptions& options) {
    double step = options.coarsest_step_m;
    int sun_samples = options.fewest_sun_samples;
    std::uint64_t samples = 0;
    const auto march = [&](double by_step, int by_samples) {
        const CloudRayResult result = march_once(media, light, ray, by_step, by_samples, options);
        samples += result.samples;
        return result;
    };
    CloudRayResult coarse = march(step, sun_samples);
    while (true) {
        CloudRayResult fine = march(0.5 * step, sun_samples);
        const CloudRayResult better_lit = march(step, 2 * sun_samples);
        fine.view_error = difference(coarse, fine);
        fine.sun_error = difference(coarse, better_lit);
        fine.samples = samples;
        const auto enough = [&](double error) { return error <= 0.5 * options.tolerance; };
        const bool finer_view = !enough(fine.view_error) && 0.25 * step >= options.finest_step_m;
        const bool finer_sun = !enough(fine.sun_error) && 4 * sun_samples <= options.most_sun_samples;
        if (!finer_view && !finer_sun) {
            return fine;
        }
        if (finer_view) {
            step *= 0.5;
        }
        if (finer_sun) {
            sun_samples *= 2;
        }
        coarse = finer_view && finer_sun ? march(step, sun_samples) : (finer_view ? fine : better_lit);
    }
}

}  // namespace bruma::reference
