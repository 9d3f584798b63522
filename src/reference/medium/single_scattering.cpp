#include "reference/medium/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "reference/collocation.h"
#include "reference/phase_function.h"
#include "reference/volume/mixture_walk.h"
#include "reference/volume/transmittance.h"

namespace bruma::reference {
namespace {

/// Shares of the tolerance: a shadow ray's error, and what is left of light or view where a ray is given up.
constexpr double shadow_share = 0.1;
constexpr double negligible_share = 1e-6;
/// Of a part of a ray, relative to its own radiance: matters for radiances above 100 only.
constexpr double relative_share = 1e-2;

/// Light that arrives at a point from one light.
struct Arrival {
    scene::Incident incident;
    Transmittance passed;
};

/// The medium along one ray towards the eye.
class LitMixture {
  public:
    LitMixture(const ScatteringScene& scene, const MixtureWalk& walk, const scene::Ray& ray, double tolerance,
               bool leap, bool with_lights)
        : scene_(scene), walk_(walk), ray_(ray), tolerance_(tolerance), leap_(leap), with_lights_(with_lights) {}

    MediumPoint operator()(double t) const {
        const glm::dvec3 position = ray_.origin_world + t * ray_.direction_world;
        bool arrived = false;
        glm::dvec3 source_error(0.0);
        MediumPoint sum;
        for (const PieceWalk* walk : walk_.present()) {
            const PreparedVolume& volume = walk->volume();
            const OpticalPoint optics = volume.curves.at(*walk->piece().stretch, walk->u_at(t));
            if (!(optics.extinction > 0.0)) {
                continue;
            }
            glm::dvec3 source(0.0);
            if (volume.scatters) {
                if (!arrived && with_lights_) {
                    let_arrive(position);
                    arrived = true;
                }
                source = scattered(*walk, t, volume.albedo_of(optics.color), source_error);
            } else {
                source = volume.shading ? volume.shading->lit(optics.color, walk->gradient_world_at(t), position,
                                                              ray_.direction_world)
                                        : optics.color;
            }
            sum.extinction += optics.extinction;
            sum.extinction_times_source += optics.extinction * (source + optics.color * optics.emission);
        }
        largest_source_error_ = std::max({largest_source_error_, source_error.x, source_error.y, source_error.z});
        return sum;
    }

    /// Of the shadow rays, as radiance per unit of opacity.
    double largest_source_error() const { return largest_source_error_; }
    std::uint64_t evaluations() const { return evaluations_; }

  private:
    void let_arrive(glm::dvec3 position) const {
        arrivals_.clear();
        for (const scene::Light& light : scene_.lights) {
            const scene::Incident incident = scene_.incident(light, position);
            if (incident.irradiance == glm::dvec3(0.0)) {
                continue;
            }
            const Transmittance passed =
                transmittance(scene_.volumes, {position, incident.toward_world, 0.0}, incident.distance,
                              shadow_share * tolerance_, negligible_share * tolerance_, leap_);
            evaluations_ += passed.evaluations;
            arrivals_.push_back({incident, passed});
        }
    }

    glm::dvec3 scattered(const PieceWalk& walk, double t, glm::dvec3 albedo, glm::dvec3& error) const {
        const PreparedVolume& volume = walk.volume();
        GradientShading::Surface surface;
        if (volume.shading) {
            surface = volume.shading->surface_at(walk.gradient_world_at(t), ray_.direction_world);
        }
        glm::dvec3 source(0.0);
        for (const Arrival& arrival : arrivals_) {
            // Light travels against the way towards it, and on against the ray.
            const double phase =
                henyey_greenstein(glm::dot(arrival.incident.toward_world, ray_.direction_world), volume.g);
            glm::dvec3 unshadowed = albedo * arrival.incident.irradiance * phase;
            if (surface.share > 0.0) {
                const auto reflected = volume.shading->reflect(surface, arrival.incident, ray_.direction_world);
                unshadowed = glm::mix(unshadowed, albedo * reflected.diffuse + reflected.highlight, surface.share);
            }
            source += unshadowed * arrival.passed.value;
            error += unshadowed * arrival.passed.error;
        }
        return source;
    }

    const ScatteringScene& scene_;
    const MixtureWalk& walk_;
    const scene::Ray& ray_;
    double tolerance_;
    bool leap_, with_lights_;
    mutable std::vector<Arrival> arrivals_;
    mutable double largest_source_error_ = 0.0;
    mutable std::uint64_t evaluations_ = 0;
};

RayResult integrate(const ScatteringScene& scene, const scene::Ray& ray, double tolerance, bool leap,
                    bool with_lights) {
    // On top of the accumulated differences. On smooth pieces they are some 60 times the error of what is kept, but
    // shadows have bends that no knot announces, and where one falls between the nodes they are too small.
    constexpr double safety = 6.0;
    constexpr double rounding = 1e-12;
    MixtureWalk walk(scene.volumes, ray, leap);
    RayIntegral integral(tolerance, walk.length(), relative_share * tolerance,
                         std::max(RayIntegral::smallest_transmittance, negligible_share * tolerance));
    const LitMixture mixture(scene, walk, ray, tolerance, leap, with_lights);
    while (!integral.stopped() && walk.next()) {
        integral.add(mixture, walk.t0(), walk.t1());
    }
    const double difference = std::max(integral.radiance_difference(), integral.transmittance_difference());
    const double of_shadows = mixture.largest_source_error() * (1.0 - integral.transmittance());
    const glm::dvec3 radiance = integral.radiance();
    return {radiance, integral.transmittance(),
            safety * difference + of_shadows + rounding * (1.0 + std::max({radiance.x, radiance.y, radiance.z})),
            integral.evaluations() + mixture.evaluations()};
}

}  // namespace

RayResult SingleScattering::trace(const scene::Ray& ray) const {
    return integrate(scene_, ray, tolerance_, leap_, true);
}

RayResult SingleScattering::trace_unscattered(const scene::Ray& ray) const {
    return integrate(scene_, ray, tolerance_, leap_, false);
}

}  // namespace bruma::reference
