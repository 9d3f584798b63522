#include "reference/clouds/cloud_monte_carlo.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/clouds/cloud_phase.h"
#include "reference/phase_function.h"
#include "reference/random.h"

namespace bruma::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sums over samples, added up in a fixed order.
struct Moments {
    glm::dvec3 sum{0.0}, sum_of_squares{0.0};
    double passed = 0.0, passed_squares = 0.0, orders = 0.0;
};

struct CloudCollision {
    glm::dvec3 at_world;
    const CloudMedium* medium;
};

/// One path with its random numbers.
class Path {
  public:
    Path(std::span<const CloudMedium> media, const CloudLight& light, const MonteCarloOptions& options,
         std::uint32_t sample)
        : media_(media), light_(light), options_(options), random_(0, options.pixel, sample) {}

    Moments trace(const scene::Ray& ray) {
        Moments result;
        result.passed = transmittance(ray.origin_world, ray.direction_world, options_.longest_m);
        glm::dvec3 origin = ray.origin_world, direction = ray.direction_world, weight(1.0), radiance(0.0);
        std::int64_t orders = 0;
        double longest = options_.longest_m;
        AirLight before;
        while (true) {
            const std::optional<CloudCollision> collision = fly(origin, direction, longest);
            if (collision) {
                if (orders == 0 && options_.air) {
                    before = options_.air(glm::distance(ray.origin_world, collision->at_world));
                }
                weight *= collision->medium->optics.albedo;
                radiance += weight * sun_at(*collision, direction);
                if (++orders == options_.most_orders || !survives(weight)) {
                    break;
                }
                origin = collision->at_world;
                direction = scattered(collision->medium->optics, direction);
            } else if (orders == 0 || !bounce(origin, direction, weight, radiance)) {
                break;  // seen through: what is behind is not the clouds' light; or lost in sky or ground
            }
            longest = infinity;
        }
        radiance = before.radiance + before.transmittance * radiance;
        result.sum = radiance;
        result.sum_of_squares = radiance * radiance;
        result.passed_squares = result.passed * result.passed;
        result.orders = double(orders);
        return result;
    }

  private:
    /// Delta tracking: the first real collision, or none.
    std::optional<CloudCollision> fly(const glm::dvec3& origin, const glm::dvec3& direction, double longest) {
        for (const CloudStretch& stretch : stretches(media_, origin, direction, longest)) {
            const double majorant = majorant_of(stretch);
            double t = stretch.begin_m;
            while (majorant > 0.0) {
                t -= std::log1p(-random_.uniform()) / majorant;
                if (t >= stretch.end_m) {
                    break;
                }
                const glm::dvec3 at = origin + t * direction;
                double choice = random_.uniform() * majorant;
                for (const CloudMedium* medium : stretch.media) {
                    choice -= medium->extinction_per_m(at);
                    if (choice < 0.0) {
                        return CloudCollision{at, medium};
                    }
                }
            }
        }
        return std::nullopt;
    }

    /// Ratio tracking: an unbiased estimate of the transmittance.
    double transmittance(const glm::dvec3& origin, const glm::dvec3& direction, double longest = infinity) {
        double passed = 1.0;
        for (const CloudStretch& stretch : stretches(media_, origin, direction, longest)) {
            const double majorant = majorant_of(stretch);
            double t = stretch.begin_m;
            while (majorant > 0.0 && passed > 0.0) {
                t -= std::log1p(-random_.uniform()) / majorant;
                if (t >= stretch.end_m) {
                    break;
                }
                double extinction = 0.0;
                for (const CloudMedium* medium : stretch.media) {
                    extinction += medium->extinction_per_m(origin + t * direction);
                }
                passed *= 1.0 - extinction / majorant;
                // Below a tenth go on with one in two and count it twice: as right, and sooner done.
                if (passed < 0.1 && passed > 0.0) {
                    passed = random_.uniform() < 0.5 ? 2.0 * passed : 0.0;
                }
            }
        }
        return passed;
    }

    static double majorant_of(const CloudStretch& stretch) {
        double sum = 0.0;
        for (const CloudMedium* medium : stretch.media) {
            sum += medium->majorant_per_m();
        }
        return sum;
    }

    glm::dvec3 sun_at(const CloudCollision& collision, const glm::dvec3& direction) {
        const CloudGeometry& geometry = collision.medium->geometry;
        const glm::dvec3 sun = light_.sun_irradiance(geometry.altitude_m(collision.at_world));
        if (sun == glm::dvec3(0.0) || geometry.ground_distance(collision.at_world, light_.to_sun_world) < infinity) {
            return glm::dvec3(0.0);
        }
        const double phase = dual_lobe(glm::dot(direction, light_.to_sun_world), collision.medium->optics);
        return phase * transmittance(collision.at_world, light_.to_sun_world) * sun;
    }

    glm::dvec3 scattered(const scene::CloudOptics& optics, const glm::dvec3& direction) {
        const double g = random_.uniform() < optics.forward_share ? optics.forward_g : optics.backward_g;
        const double u = random_.uniform();
        return sample_henyey_greenstein(direction, g, u, random_.uniform());
    }

    /// A path that left the clouds: ends in the sky, or turns on the ground. Returns whether it goes on.
    bool bounce(glm::dvec3& origin, glm::dvec3& direction, glm::dvec3& weight, glm::dvec3& radiance) {
        const CloudGeometry& geometry = media_.front().geometry;
        const double distance = geometry.ground_distance(origin, direction);
        if (distance == infinity) {
            radiance += weight * light_.sky_radiance(direction);
            return false;
        }
        weight *= light_.ground_albedo;
        if (weight == glm::dvec3(0.0)) {
            return false;
        }
        origin += distance * direction;
        const glm::dvec3 up = geometry.up_world(origin);
        origin += 1e-3 * up;  // a millimetre, so that the ground is not met again
        const double climb = glm::dot(up, light_.to_sun_world);
        if (climb > 0.0) {
            radiance += weight * light_.sun_irradiance(0.0) *
                        (climb * std::numbers::inv_pi * transmittance(origin, light_.to_sun_world));
        }
        // Lambert: a direction uniform on the sphere, added to the normal.
        const double u = random_.uniform();
        const glm::dvec3 lean = up + sample_henyey_greenstein(up, 0.0, u, random_.uniform());
        direction = glm::length(lean) > 1e-9 ? glm::normalize(lean) : up;
        return true;
    }

    bool survives(glm::dvec3& weight) {
        const double most = std::max({weight.r, weight.g, weight.b});
        if (most >= 0.1) {
            return true;
        }
        if (most <= 0.0 || random_.uniform() >= 2.0 * most) {
            return false;
        }
        weight /= 2.0 * most;
        return true;
    }

    std::span<const CloudMedium> media_;
    const CloudLight& light_;
    const MonteCarloOptions& options_;
    RandomStream random_;
};

}  // namespace

MonteCarloResult trace_paths(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                             const MonteCarloOptions& options) {
    constexpr std::uint32_t block = 64;
    std::vector<Moments> blocks((options.samples + block - 1) / block);
    if (!media.empty()) {
        tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t n) {
            const auto first = std::uint32_t(n) * block;
            for (std::uint32_t sample = first; sample < std::min(first + block, options.samples); ++sample) {
                const Moments path = Path(media, light, options, sample).trace(ray);
                blocks[n].sum += path.sum;
                blocks[n].sum_of_squares += path.sum_of_squares;
                blocks[n].passed += path.passed;
                blocks[n].passed_squares += path.passed_squares;
                blocks[n].orders += path.orders;
            }
        });
    }
    Moments all;
    for (const Moments& part : blocks) {
        all.sum += part.sum;
        all.sum_of_squares += part.sum_of_squares;
        all.passed += part.passed;
        all.passed_squares += part.passed_squares;
        all.orders += part.orders;
    }
    const double n = std::max(1.0, double(options.samples));
    const auto error = [n](double mean, double mean_of_squares) {
        return std::sqrt(std::max(0.0, mean_of_squares - mean * mean) / std::max(1.0, n - 1.0));
    };
    MonteCarloResult result;
    if (media.empty()) {
        return result;
    }
    result.radiance = all.sum / n;
    for (int channel = 0; channel < 3; ++channel) {
        result.standard_error[channel] = error(result.radiance[channel], all.sum_of_squares[channel] / n);
    }
    result.transmittance = all.passed / n;
    result.transmittance_error = error(result.transmittance, all.passed_squares / n);
    result.mean_orders = all.orders / n;
    return result;
}

}  // namespace bruma::reference
