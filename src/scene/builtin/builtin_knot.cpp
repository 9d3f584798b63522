#include <cmath>
#include <numbers>
#include <vector>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

constexpr int samples = 128;
constexpr double tube_radius = 13.0;  // mm

/// Torus knot (2,3) in mm about the centre of the grid.
glm::dvec3 knot_point(double t) {
    constexpr double scale = 16.0;
    const double ring = 2.0 + std::cos(3.0 * t);
    return scale * glm::dvec3(ring * std::cos(2.0 * t), ring * std::sin(2.0 * t), 1.4 * std::sin(3.0 * t));
}

double squared_distance_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 from_a = p - a;
    const double t = std::clamp(glm::dot(from_a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    const glm::dvec3 d = from_a - t * ab;
    return glm::dot(d, d);
}

/// Half the range in the soft outer tube, all of it in the core.
double tube_profile(double distance) {
    const double t = std::clamp(1.0 - distance / tube_radius, 0.0, 1.0);
    const double soft = t * t * (3.0 - 2.0 * t);
    const double core = distance / 3.4;
    return 0.5 * soft + 0.5 * std::exp(-core * core * core * core);
}

int first_sample(double low_mm) {
    return std::max(0, int(std::floor(low_mm + 0.5 * samples - 0.5)));
}
int past_sample(double high_mm) {
    return std::min(samples, int(std::ceil(high_mm + 0.5 * samples + 0.5)));
}

}  // namespace

std::shared_ptr<const VolumeGrid> make_knot() {
    // Chords of about 0.9 mm lie within 0.02 mm of the curve: far below a voxel.
    constexpr int segments = 600;
    std::vector<glm::dvec3> curve;
    for (int s = 0; s <= segments; ++s) {
        curve.push_back(knot_point(2.0 * std::numbers::pi * s / segments));
    }
    std::vector<double> distance2(std::size_t(samples) * samples * samples, tube_radius * tube_radius);
    tbb::parallel_for(0, samples, [&](int k) {
        const double z = centre_in_samples(k, samples);
        double* const slice = distance2.data() + std::size_t(k) * samples * samples;
        for (int s = 0; s < segments; ++s) {
            const glm::dvec3 low = glm::min(curve[s], curve[s + 1]) - tube_radius;
            const glm::dvec3 high = glm::max(curve[s], curve[s + 1]) + tube_radius;
            if (z < low.z || z > high.z) {
                continue;
            }
            for (int j = first_sample(low.y); j < past_sample(high.y); ++j) {
                for (int i = first_sample(low.x); i < past_sample(high.x); ++i) {
                    const glm::dvec3 p(centre_in_samples(i, samples), centre_in_samples(j, samples), z);
                    double& nearest = slice[std::size_t(j) * samples + i];
                    nearest = std::min(nearest, squared_distance_to_segment(p, curve[s], curve[s + 1]));
                }
            }
        }
    });
    return sample_builtin("knot", glm::ivec3(samples), VoxelType::uint8, 1e-3, [&](int i, int j, int k) {
        return tube_profile(std::sqrt(distance2[(std::size_t(k) * samples + j) * samples + i]));
    });
}

}  // namespace bruma::scene
