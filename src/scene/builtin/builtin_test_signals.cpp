#include <cmath>
#include <numbers>
#include <vector>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

constexpr double alpha = 0.25;
constexpr double frequency = 6.0;

/// The part of the Marschner-Lobb signal that depends on x and y.
double ripple(double x, double y) {
    const double r = std::sqrt(x * x + y * y);
    return std::cos(2.0 * std::numbers::pi * frequency * std::cos(std::numbers::pi * r / 2.0));
}
double slope(double z) {
    return 1.0 - std::sin(std::numbers::pi * z / 2.0);
}
double signal(double slope_of_z, double ripple_of_xy) {
    return (slope_of_z + alpha * (1.0 + ripple_of_xy)) / (2.0 * (1.0 + alpha));
}

std::shared_ptr<const VolumeGrid> sample_signal(const char* name, int n, VoxelType type) {
    // The costly cosines depend on x and y only.
    std::vector<double> ripples(std::size_t(n) * n);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            ripples[std::size_t(j) * n + i] = ripple(centre_in_unit(i, n), centre_in_unit(j, n));
        }
    }
    std::vector<double> slopes(static_cast<std::size_t>(n));
    for (int k = 0; k < n; ++k) {
        slopes[std::size_t(k)] = slope(centre_in_unit(k, n));
    }
    return sample_builtin(name, glm::ivec3(n), type, 1e-3, [&](int i, int j, int k) {
        return signal(slopes[std::size_t(k)], ripples[std::size_t(j) * n + i]);
    });
}

}  // namespace

double marschner_lobb(double x, double y, double z) {
    return signal(slope(z), ripple(x, y));
}

std::shared_ptr<const VolumeGrid> make_marschner_lobb() {
    return sample_signal("marschner-lobb", 41, VoxelType::float32);
}

std::shared_ptr<const VolumeGrid> make_marschner_lobb_256() {
    return sample_signal("marschner-lobb-256", 256, VoxelType::uint8);
}

std::shared_ptr<const VolumeGrid> make_sphere() {
    constexpr int n = 64;
    constexpr double radius = 28.8;  // mm: leaves a rim of zeros, so that no face of the box cuts the ball
    return sample_builtin("sphere", glm::ivec3(n), VoxelType::float32, 1e-3, [](int i, int j, int k) {
        const double x = centre_in_samples(i, n);
        const double y = centre_in_samples(j, n);
        const double z = centre_in_samples(k, n);
        const double t = std::max(0.0, 1.0 - (x * x + y * y + z * z) / (radius * radius));
        return t * t;
    });
}

std::shared_ptr<const VolumeGrid> make_cube() {
    return sample_builtin("cube", glm::ivec3(32), VoxelType::float32, 1e-3, [](int, int, int) { return 1.0; });
}

}  // namespace bruma::scene
