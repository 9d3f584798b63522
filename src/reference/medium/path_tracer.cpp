#include "reference/medium/path_tracer.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"
#include "reference/phase_function.h"

namespace bruma::reference {
namespace {

/// Weight below which Russian roulette decides.
constexpr double little = 0.05;
/// Collisions with nothing in one block of a volume beyond which a picture would take hours.
constexpr double most_null_collisions = 1e6;

}  // namespace

PathTracer::PathTracer(const ScatteringScene& scene, int max_bounces) : scene_(scene), max_bounces_(max_bounces) {
    for (const PreparedVolume& volume : scene.volumes) {
        if (volume.largest_null_depth() > most_null_collisions) {
            throw InputError(fmt::format(
                "nodes.{}: its extinction varies by {:.2g} optical depths within 8 voxels, and multiple scattering "
                "takes at most {:.0e}; lower density_scale, raise transfer_function.reference_length, or ask for "
                "single scattering",
                volume.name(), volume.largest_null_depth(), most_null_collisions));
        }
    }
}

template <class AtCollision>
Escape PathTracer::walk(scene::Ray ray, RandomStream& random, AtCollision&& at_collision) const {
    Escape path;
    path.weight = glm::dvec3(1.0);
    for (;;) {
        const std::optional<Collision> collision = next_collision(scene_.volumes, ray, random);
        path.way_world = ray.direction_world;
        if (!collision) {
            path.escaped = true;
            return path;
        }
        const glm::dvec3 position = ray.origin_world + collision->t * ray.direction_world;
        const bool last = path.bounces == max_bounces_;
        const glm::dvec3 albedo = !last && collision->volume->scatters
                                      ? collision->volume->albedo_of(collision->optics.color)
                                      : glm::dvec3(0.0);
        at_collision(path, albedo, *collision, position);
        path.cut_off = last && collision->volume->scatters;
        path.weight *= albedo;
        const double weight = std::max({path.weight.x, path.weight.y, path.weight.z});
        if (weight < little) {
            if (random.uniform() * little >= weight) {
                path.weight = glm::dvec3(0.0);
                return path;
            }
            path.weight *= little / weight;
        }
        ++path.bounces;
        const double u = random.uniform();
        const double v = random.uniform();
        ray = {position, sample_henyey_greenstein(ray.direction_world, collision->volume->g, u, v), 0.0};
    }
}

glm::dvec3 PathTracer::light_from_lights(const Collision& collision, glm::dvec3 position, glm::dvec3 way,
                                         RandomStream& random) const {
    glm::dvec3 sum(0.0);
    for (const scene::Light& light : scene_.lights) {
        const scene::Incident incident = scene_.incident(light, position);
        if (incident.irradiance == glm::dvec3(0.0)) {
            continue;
        }
        // The path is walked from the eye: light comes against the way towards it, and leaves against `way`.
        const double phase = henyey_greenstein(glm::dot(incident.toward_world, way), collision.volume->g);
        const double passed =
            tracked_transmittance(scene_.volumes, {position, incident.toward_world, 0.0}, incident.distance, random);
        sum += incident.irradiance * (phase * passed);
    }
    return sum;
}

PathTracer::Sample PathTracer::sample(const scene::Ray& ray, RandomStream& random) const {
    Sample result;
    const Escape escape =
        walk(ray, random, [&](const Escape& path, glm::dvec3 albedo, const Collision& collision, glm::dvec3 position) {
            ++result.collisions;
            if (path.bounces > 0) {
                result.radiance += path.weight * collision.optics.color * collision.optics.emission;
            }
            const glm::dvec3 scattered = path.weight * albedo;
            if (scattered != glm::dvec3(0.0)) {
                result.radiance += scattered * light_from_lights(collision, position, path.way_world, random);
            }
        });
    if (escape.escaped && escape.bounces > 0) {
        result.radiance += escape.weight * scene_.environment;
    }
    result.cut_off = escape.cut_off;
    return result;
}

Escape PathTracer::follow(const scene::Ray& ray, RandomStream& random) const {
    return walk(ray, random, [](const Escape&, glm::dvec3, const Collision&, glm::dvec3) {});
}

}  // namespace bruma::reference
