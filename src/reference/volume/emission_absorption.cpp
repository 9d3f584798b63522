#include "reference/volume/emission_absorption.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "reference/collocation.h"
#include "reference/pixel_loop.h"
#include "reference/volume/mixture_walk.h"

namespace bruma::reference {
namespace {

/// On top of the accumulated differences, which on smooth pieces are some 60 times the error of what is kept.
constexpr double safety = 2.0;
/// Rounding of sums and exponentials along a ray, relative to 1 + radiance.
constexpr double rounding = 1e-13;

/// All volumes that are present on one part of a ray.
class Mixture {
  public:
    Mixture(const std::vector<const PieceWalk*>& present, const scene::Ray& ray) : present_(present), ray_(ray) {}

    MediumPoint operator()(double t) const {
        MediumPoint sum;
        for (const PieceWalk* walk : present_) {
            const PreparedVolume& volume = walk->volume();
            const OpticalPoint optics = volume.curves.at(*walk->piece().stretch, walk->u_at(t));
            glm::dvec3 source = optics.color;
            if (volume.shading) {
                source = volume.shading->lit(optics.color, walk->gradient_world_at(t),
                                             ray_.origin_world + t * ray_.direction_world, ray_.direction_world);
            }
            sum.extinction += optics.extinction;
            sum.extinction_times_source += optics.extinction * (source + optics.color * optics.emission);
        }
        return sum;
    }

  private:
    const std::vector<const PieceWalk*>& present_;
    const scene::Ray& ray_;
};

}  // namespace

EmissionAbsorption::EmissionAbsorption(const scene::Scene& scene, const ReferenceOptions& options)
    : options_(options), volumes_(prepare_volumes(scene)) {
    for (const PreparedVolume& volume : volumes_) {
        if (volume.scatters) {
            const auto words = scene::enum_words<scene::VolumeLighting>();
            throw InputError(fmt::format(
                "nodes.{}.lighting: the emission-absorption reference knows none and gradient, not {}; choose one of "
                "them",
                volume.name(), words[std::size_t(volume.lighting)]));
        }
    }
}

RayResult EmissionAbsorption::trace(const scene::Ray& ray) const {
    MixtureWalk walk(volumes_, ray, options_.leap);
    RayIntegral integral(options_.tolerance, walk.length());
    const Mixture mixture(walk.present(), ray);
    while (!integral.stopped() && walk.next()) {
        integral.add(mixture, walk.t0(), walk.t1());
    }
    const glm::dvec3 radiance = integral.radiance();
    const double largest = std::max({radiance.x, radiance.y, radiance.z});
    const double difference = std::max(integral.radiance_difference(), integral.transmittance_difference());
    return {radiance, integral.transmittance(), safety * difference + rounding * (1.0 + largest),
            integral.evaluations()};
}

RayResult trace(const scene::Scene& scene, const scene::Ray& ray, const ReferenceOptions& options) {
    return EmissionAbsorption(scene, options).trace(ray);
}

ReferenceImage render_emission_absorption(const scene::Scene& scene, int width, int height,
                                          const ReferenceOptions& options) {
    const EmissionAbsorption media(scene, options);
    ReferenceImage result;
    result.image = Image(std::max(width, 0), std::max(height, 0));
    result.error.resize(result.image.pixel_count());
    std::vector<std::uint64_t> evaluations(result.image.pixel_count());
    for_each_pixel(scene, width, height, options.progress, [&](const Pixel& pixel) {
        const RayResult ray = media.trace(pixel.ray);
        const glm::dvec3 radiance = ray.radiance + ray.transmittance * pixel.background;
        float* rgba = result.image.pixel(pixel.x, pixel.y);
        for (int channel = 0; channel < 3; ++channel) {
            rgba[channel] = float(radiance[channel]);
        }
        rgba[3] = float(1.0 - ray.transmittance);
        const double brightest = std::max({pixel.background.x, pixel.background.y, pixel.background.z});
        const double to_float = 0x1p-24 * std::max({radiance.x, radiance.y, radiance.z});
        result.error[pixel.index] = float(ray.error * (1.0 + brightest) + to_float);
        evaluations[pixel.index] = ray.evaluations;
    });
    double sum_of_squares = 0.0;
    for (std::size_t n = 0; n < result.error.size(); ++n) {
        const double error = result.error[n];
        result.largest_error = std::max(result.largest_error, error);
        sum_of_squares += error * error;
        result.evaluations += evaluations[n];
    }
    result.rms_error = std::sqrt(sum_of_squares / double(result.error.size()));
    return result;
}

}  // namespace bruma::reference
