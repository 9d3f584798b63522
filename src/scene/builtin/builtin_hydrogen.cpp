#include <cmath>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

/// r^2 times the radial part R(4,2), without its norm; r in Bohr radii. The r^2 of the angular part is left in the
/// polynomial (3 y^2 - r^2), so that the centre needs no special case.
double radial_4d_over_r2(double r) {
    return (1.0 - r / 12.0) * std::exp(-r / 4.0);
}

}  // namespace

std::shared_ptr<const VolumeGrid> make_hydrogen() {
    constexpr int n = 128;
    constexpr double bohr_radii_per_mm = 1.0 / 1.8;
    // |psi| is largest on the axis, where r^2 (1 - r/12) exp(-r/4) has its first extremum, r = 12 - sqrt(48).
    const double r_peak = 12.0 - std::sqrt(48.0);
    const double psi_peak = 2.0 * r_peak * r_peak * radial_4d_over_r2(r_peak);
    return sample_builtin("hydrogen", glm::ivec3(n), VoxelType::uint8, 1e-3, [&](int i, int j, int k) {
        const double x = bohr_radii_per_mm * centre_in_samples(i, n);
        const double y = bohr_radii_per_mm * centre_in_samples(j, n);
        const double z = bohr_radii_per_mm * centre_in_samples(k, n);
        const double r2 = x * x + y * y + z * z;
        // |psi| is the square root of the probability density: it lifts the outer lobes from 0.19 to 0.44 of the peak.
        return std::abs((3.0 * y * y - r2) * radial_4d_over_r2(std::sqrt(r2))) / psi_peak;
    });
}

}  // namespace bruma::scene
