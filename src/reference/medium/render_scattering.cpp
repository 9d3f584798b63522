#include "reference/medium/render_scattering.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "reference/medium/path_tracer.h"
#include "reference/medium/single_scattering.h"
#include "reference/pixel_loop.h"

namespace bruma::reference {
namespace {

/// Of what is seen without being scattered, in a Monte Carlo picture: below all noise.
constexpr double unscattered_tolerance = 1e-6;

/// Mean and its variance, one sample at a time, without cancellation (Welford, Technometrics 4, 1962).
class RunningMean {
  public:
    void add(glm::dvec3 value) {
        ++count_;
        const glm::dvec3 before = value - mean_;
        mean_ += before / double(count_);
        squares_ += before * (value - mean_);
    }
    glm::dvec3 mean() const { return mean_; }
    glm::dvec3 standard_error() const { return glm::sqrt(squares_ / (double(count_) * double(count_ - 1))); }

  private:
    int count_ = 0;
    glm::dvec3 mean_{0.0}, squares_{0.0};
};

struct PixelCounts {
    std::uint64_t evaluations = 0, cut_off = 0;
};

/// Beside a lamp radiance may leave the range of a float; infinity would poison whatever the picture meets next.
float to_float(double radiance) {
    return float(std::min(radiance, double(std::numeric_limits<float>::max())));
}

void write(ScatteringImage& result, const Pixel& pixel, const RayResult& ray, glm::dvec3 scattered, glm::dvec3 error) {
    const glm::dvec3 radiance = ray.radiance + scattered + ray.transmittance * pixel.background;
    float* rgba = result.image.pixel(pixel.x, pixel.y);
    for (int channel = 0; channel < 3; ++channel) {
        rgba[channel] = to_float(radiance[channel]);
        result.error[pixel.index][channel] = to_float(error[channel]);
    }
    rgba[3] = float(1.0 - ray.transmittance);
}

void summarise(ScatteringImage& result, const std::vector<PixelCounts>& counts, int samples) {
    double squares = 0.0;
    std::uint64_t cut_off = 0;
    for (std::size_t n = 0; n < counts.size(); ++n) {
        const glm::dvec3 error(result.error[n]);
        result.largest_error = std::max({result.largest_error, error.x, error.y, error.z});
        squares += glm::dot(error, error) / 3.0;
        result.evaluations += counts[n].evaluations;
        cut_off += counts[n].cut_off;
    }
    result.rms_error = std::sqrt(squares / double(counts.size()));
    result.cut_off_share = double(cut_off) / (double(samples) * double(counts.size()));
}

}  // namespace

ScatteringImage render_scattering(const scene::Scene& scene, int width, int height, const ScatteringOptions& options) {
    const bool multiple = options.paths == LightPaths::multiple;
    if (multiple && (options.samples < 2 || options.max_bounces < 1)) {
        throw InputError(fmt::format(
            "reference: {} samples of {} bounces show neither light nor error; ask for at least 2 samples and 1 bounce",
            options.samples, options.max_bounces));
    }
    const ScatteringScene media(scene);
    const SingleScattering rays(media, multiple ? unscattered_tolerance : options.tolerance, options.leap);
    ScatteringImage result;
    result.image = Image(std::max(width, 0), std::max(height, 0));
    result.error.resize(result.image.pixel_count());
    std::vector<PixelCounts> counts(result.image.pixel_count());
    if (!multiple) {
        for_each_pixel(scene, width, height, options.progress, [&](const Pixel& pixel) {
            const RayResult ray = rays.trace(pixel.ray);
            // The error holds for the transmittance, too; 2^-24 rounds to float.
            write(result, pixel, ray, glm::dvec3(0.0), ray.error * (1.0 + pixel.background) + 0x1p-24 * ray.radiance);
            counts[pixel.index].evaluations = ray.evaluations;
        });
    } else {
        const PathTracer paths(media, options.max_bounces);
        for_each_pixel(scene, width, height, options.progress, [&](const Pixel& pixel) {
            RunningMean mean;
            for (int n = 0; n < options.samples; ++n) {
                RandomStream random(options.seed, std::uint32_t(pixel.index), std::uint64_t(n));
                const PathTracer::Sample sample = paths.sample(pixel.ray, random);
                mean.add(sample.radiance);
                counts[pixel.index].evaluations += sample.collisions;
                counts[pixel.index].cut_off += sample.cut_off ? 1 : 0;
            }
            write(result, pixel, rays.trace_unscattered(pixel.ray), mean.mean(), mean.standard_error());
        });
    }
    summarise(result, counts, options.samples);
    return result;
}

}  // namespace bruma::reference
