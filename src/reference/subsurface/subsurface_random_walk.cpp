#include "reference/subsurface/subsurface_random_walk.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/subsurface/fresnel.h"
#include "reference/subsurface/subsurface_sampling.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;

constexpr std::uint32_t endless = 10'000'000;
constexpr double roulette_below = 0.1;

/// Cosine of a Henyey-Greenstein scattering angle for uniform u.
double scattering_cosine(double g, double u) {
    if (std::abs(g) < 1e-6) {
        return 1.0 - 2.0 * u;
    }
    const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
    return std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
}

/// d turned by an angle of this cosine, in azimuth `turns`.
glm::dvec3 turned(glm::dvec3 d, double cosine, double turns) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    // An orthonormal frame without a branch that loses digits (Duff et al. 2017).
    const double sign = std::copysign(1.0, d.z);
    const double a = -1.0 / (sign + d.z);
    const double b = d.x * d.y * a;
    const glm::dvec3 u(1.0 + sign * d.x * d.x * a, sign * b, -sign * d.x);
    const glm::dvec3 v(b, sign + d.y * d.y * a, -d.y);
    const double angle = 2.0 * pi * turns;
    return glm::normalize(cosine * d + sine * (std::cos(angle) * u + std::sin(angle) * v));
}

/// Sums of samples and of their squares, block by block so that threads cannot change the order of additions.
class BlockSums {
  public:
    BlockSums(std::uint64_t paths, int bins) : paths_(paths), bins_(std::size_t(bins)) {}

    /// path(index, add) calls add(bin, sample) at most once.
    template <class Path>
    std::vector<Estimate> run(const Path& path) const {
        constexpr std::uint64_t block = 1024;
        const std::size_t blocks = std::size_t((paths_ + block - 1) / block);
        std::vector<double> sums(blocks * bins_ * 2);
        tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
            double* own = &sums[b * bins_ * 2];
            for (std::uint64_t n = b * block; n < std::min(paths_, (b + 1) * block); ++n) {
                path(n, [&](std::size_t bin, double sample) {
                    own[2 * bin] += sample;
                    own[2 * bin + 1] += sample * sample;
                });
            }
        });
        std::vector<Estimate> result(bins_);
        const double count = double(paths_);
        for (std::size_t bin = 0; bin < bins_; ++bin) {
            double sum = 0.0;
            double squares = 0.0;
            for (std::size_t b = 0; b < blocks; ++b) {
                sum += sums[(b * bins_ + bin) * 2];
                squares += sums[(b * bins_ + bin) * 2 + 1];
            }
            const double mean = sum / count;
            result[bin] = {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / (count - 1.0))};
        }
        return result;
    }

  private:
    std::uint64_t paths_;
    std::size_t bins_;
};

std::size_t bin_of(double cosine, int bins) {
    return std::size_t(std::clamp(int(0.5 * (cosine + 1.0) * bins), 0, bins - 1));
}

}  // namespace

std::optional<BoundaryHit> HalfSpaceBody::first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const {
    if (d.z <= 0.0) {
        return std::nullopt;
    }
    const double t = std::max(0.0, -p.z / d.z);
    if (t >= limit) {
        return std::nullopt;
    }
    return BoundaryHit{t, {p.x + t * d.x, p.y + t * d.y, 0.0}, {0.0, 0.0, 1.0}};
}

std::optional<BoundaryHit> SphereBody::first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const {
    const double along = glm::dot(p, d);
    const double depth = radius_ * radius_ - glm::dot(p, p);
    const double t = std::sqrt(std::max(0.0, along * along + depth)) - along;
    if (t >= limit) {
        return std::nullopt;
    }
    const glm::dvec3 normal = glm::normalize(p + t * d);
    return BoundaryHit{t, radius_ * normal, normal};
}

std::optional<BoundaryHit> MeshBody::first_boundary(glm::dvec3 p, glm::dvec3 d, double limit) const {
    const auto hit = mesh_.first_hit(p, d, limit);
    if (!hit || glm::dot(d, hit->geometric_normal) <= 0.0) {
        return std::nullopt;  // a face seen from outside: the walker slipped out, and `has_lost` will say so
    }
    return BoundaryHit{hit->t, hit->position, hit->geometric_normal};
}

bool MeshBody::has_lost(glm::dvec3 p) const {
    const glm::dvec3 from_centre = p - mesh_.bounding_centre();
    return glm::dot(from_centre, from_centre) > 1.001 * mesh_.bounding_radius() * mesh_.bounding_radius();
}

Walk random_walk(const WalkBody& body, const SubsurfaceChannel& channel, glm::dvec3 entry, glm::dvec3 direction,
                 RandomStream& random) {
    const double mean_free_path = 1.0 / (channel.sigma_a + channel.sigma_s);
    const double albedo = channel.sigma_s * mean_free_path;
    glm::dvec3 p = entry;
    glm::dvec3 d = direction;
    Walk walk;
    walk.weight = 1.0;
    for (;;) {
        double flight = -std::log1p(-random.uniform()) * mean_free_path;
        while (const auto hit = body.first_boundary(p, d, flight)) {
            const double cosine = glm::dot(d, hit->normal);
            if (random.uniform() >= fresnel_reflectance(cosine, 1.0 / channel.eta)) {
                walk.fate = WalkFate::escaped;
                walk.position = hit->position;
                walk.normal = hit->normal;
                walk.direction = refract_out(d, hit->normal, channel.eta).value_or(d);
                return walk;
            }
            d = glm::normalize(d - 2.0 * cosine * hit->normal);
            p = hit->position;
            flight -= hit->t;
        }
        p += flight * d;
        if (body.has_lost(p) || ++walk.scatterings >= endless) {
            walk.fate = WalkFate::lost;
            walk.weight = 0.0;
            return walk;
        }
        walk.weight *= albedo;
        if (walk.weight < roulette_below) {
            if (random.uniform() < 0.5) {
                walk.weight = 0.0;
                return walk;
            }
            walk.weight *= 2.0;
        }
        const double cosine = scattering_cosine(channel.g, random.uniform());
        d = turned(d, cosine, random.uniform());
    }
}

Estimate half_space_reflectance(const SubsurfaceChannel& channel, double cos_incidence, std::uint64_t paths,
                                std::uint64_t seed) {
    check(channel);
    const HalfSpaceBody body;
    const glm::dvec3 to_light(std::sqrt(1.0 - cos_incidence * cos_incidence), 0.0, cos_incidence);
    const glm::dvec3 inside = refract_into(to_light, {0.0, 0.0, 1.0}, channel.eta);
    return BlockSums(paths, 1).run([&](std::uint64_t n, const auto& add) {
        RandomStream random(seed, 0, n);
        add(0, random_walk(body, channel, glm::dvec3(0.0), inside, random).weight);
    })[0];
}

std::vector<Estimate> sphere_exitance(const SubsurfaceChannel& channel, double radius, int bins, std::uint64_t paths,
                                      std::uint64_t seed) {
    check(channel);
    const SphereBody body(radius);
    const double disk_over_bin = 0.25 * bins;  // pi R^2 / (4 pi R^2 / bins)
    return BlockSums(paths, bins).run([&](std::uint64_t n, const auto& add) {
        RandomStream random(seed, 0, n);
        const double u = random.uniform();
        const glm::dvec2 across = uniform_disk_point(u, random.uniform());
        const glm::dvec3 normal(across, std::sqrt(1.0 - u));
        const glm::dvec3 inside = refract_into({0.0, 0.0, 1.0}, normal, channel.eta);
        const Walk walk = random_walk(body, channel, radius * normal, inside, random);
        if (walk.fate == WalkFate::escaped) {
            add(bin_of(walk.normal.z, bins),
                fresnel_transmittance(normal.z, channel.eta) * walk.weight * disk_over_bin);
        }
    });
}

std::vector<Estimate> mesh_exitance(const RayMesh& mesh, double radius, const SubsurfaceChannel& channel, int bins,
                                    std::uint64_t paths, std::uint64_t seed) {
    check(channel);
    const MeshBody body(mesh);
    const double bound = 1.001 * mesh.bounding_radius();
    const double disk_over_bin = 0.25 * bins * (bound * bound) / (radius * radius);
    return BlockSums(paths, bins).run([&](std::uint64_t n, const auto& add) {
        RandomStream random(seed, 0, n);
        const double u = random.uniform();
        const glm::dvec2 across = bound * uniform_disk_point(u, random.uniform());
        const auto entry = mesh.first_hit(mesh.bounding_centre() + glm::dvec3(across, 2.0 * bound), {0.0, 0.0, -1.0});
        if (!entry || entry->geometric_normal.z <= 0.0) {
            return;
        }
        const glm::dvec3 inside = refract_into({0.0, 0.0, 1.0}, entry->geometric_normal, channel.eta);
        const Walk walk = random_walk(body, channel, entry->position, inside, random);
        if (walk.fate == WalkFate::escaped) {
            const double cosine = glm::normalize(walk.position - mesh.bounding_centre()).z;
            const double transmittance = fresnel_transmittance(entry->geometric_normal.z, channel.eta);
            add(bin_of(cosine, bins), transmittance * walk.weight * disk_over_bin);
        }
    });
}

}  // namespace bruma::reference
