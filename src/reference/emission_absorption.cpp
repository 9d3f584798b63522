#include "reference/emission_absorption.h"

#include <fmt/core.h>
#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/error.h"
#include "reference/collocation.h"
#include "reference/piece_walk.h"

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

const scene::Scene& checked(const scene::Scene& scene) {
    scene::check(scene);
    if (!scene.camera) {
        throw InputError("camera: the scene has none, and a reference needs to know where it is seen from; set one");
    }
    return scene;
}

}  // namespace

EmissionAbsorption::EmissionAbsorption(const scene::Scene& scene, const ReferenceOptions& options) : options_(options) {
    for (const std::string& name : scene::shown_volumes(checked(scene))) {
        volumes_.emplace_back(scene, name);
    }
}

RayResult EmissionAbsorption::trace(const scene::Ray& ray) const {
    std::vector<PieceWalk> walks;
    walks.reserve(volumes_.size());
    double first = std::numeric_limits<double>::infinity();
    double last = -first;
    for (const PreparedVolume& volume : volumes_) {
        walks.emplace_back(volume, ray, options_.leap);
        if (!walks.back().finished()) {
            first = std::min(first, walks.back().t_in());
            last = std::max(last, walks.back().t_out());
        }
    }
    RayIntegral integral(options_.tolerance, last - first);
    std::vector<const PieceWalk*> present;
    const Mixture mixture(present, ray);
    double t = first;
    while (!integral.stopped()) {
        // From t to the next place where a piece of any volume begins or ends.
        double next = std::numeric_limits<double>::infinity();
        present.clear();
        for (PieceWalk& walk : walks) {
            while (!walk.finished() && walk.piece().t1 <= t) {
                walk.advance();
            }
            if (walk.finished()) {
                continue;
            }
            if (walk.piece().t0 <= t) {
                present.push_back(&walk);
                next = std::min(next, walk.piece().t1);
            } else {
                next = std::min(next, walk.piece().t0);
            }
        }
        if (!std::isfinite(next)) {
            break;
        }
        if (!present.empty()) {
            integral.add(mixture, t, next);
        }
        t = next;
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
    if (width < 1 || height < 1) {
        throw InputError(fmt::format("reference: a picture of {} x {} pixels holds nothing; both must be at least 1",
                                     width, height));
    }
    const EmissionAbsorption media(scene, options);
    const scene::Camera& camera = **scene.camera;
    ReferenceImage result;
    result.image = Image(width, height);
    result.error.resize(result.image.pixel_count());
    std::vector<std::uint64_t> evaluations(result.image.pixel_count());
    std::mutex progress_mutex;
    std::size_t done = 0;
    tbb::parallel_for(tbb::blocked_range2d<int>(0, height, 16, 0, width, 16), [&](const auto& tile) {
        for (int y = tile.rows().begin(); y != tile.rows().end(); ++y) {
            const double f = (y + 0.5) / height;
            const glm::dvec3 background = glm::mix(scene.background->top, scene.background->bottom, f);
            const double brightest = std::max({background.x, background.y, background.z});
            for (int x = tile.cols().begin(); x != tile.cols().end(); ++x) {
                const RayResult ray = media.trace(scene::camera_ray(camera, x + 0.5, y + 0.5, width, height));
                const glm::dvec3 radiance = ray.radiance + ray.transmittance * background;
                float* pixel = result.image.pixel(x, y);
                for (int channel = 0; channel < 3; ++channel) {
                    pixel[channel] = float(radiance[channel]);
                }
                pixel[3] = float(1.0 - ray.transmittance);
                const std::size_t n = std::size_t(y) * width + x;
                const double to_float = 0x1p-24 * std::max({radiance.x, radiance.y, radiance.z});
                result.error[n] = float(ray.error * (1.0 + brightest) + to_float);
                evaluations[n] = ray.evaluations;
            }
        }
        if (options.progress) {
            const std::lock_guard lock(progress_mutex);
            done += std::size_t(tile.rows().size()) * tile.cols().size();
            options.progress(double(done) / double(result.image.pixel_count()));
        }
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
