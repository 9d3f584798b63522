#include "reference/phase_function.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::reference {
namespace {

/// Below this the closed forms divide 0 by 0; what is left out is of the order of g.
constexpr double isotropic = 1e-6;

}  // namespace

double henyey_greenstein(double cosine, double g) {
    // 1 + g^2 - 2 g c, as a sum of what is not negative: exact at the peak, where the difference would cancel.
    const double apart =
        g >= 0.0 ? (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine) : (1.0 + g) * (1.0 + g) - 2.0 * g * (1.0 + cosine);
    return (1.0 - g) * (1.0 + g) / (4.0 * std::numbers::pi * apart * std::sqrt(apart));
}

double share_in_cone(double g, double cosine_of_half_angle) {
    if (std::abs(g) < isotropic) {
        return 0.5 * (1.0 - cosine_of_half_angle);
    }
    const double apart = std::sqrt(1.0 + g * g - 2.0 * g * cosine_of_half_angle);
    return (1.0 - g * g) / (2.0 * g) * (1.0 / (1.0 - g) - 1.0 / apart);
}

double sample_cosine(double g, double uniform) {
    if (std::abs(g) < isotropic) {
        return 2.0 * uniform - 1.0;
    }
    const double inner = (1.0 - g * g) / (1.0 - g + 2.0 * g * uniform);
    return std::clamp((1.0 + g * g - inner * inner) / (2.0 * g), -1.0, 1.0);
}

glm::dvec3 sample_henyey_greenstein(const glm::dvec3& direction, double g, double u, double v) {
    const double cosine = sample_cosine(g, u);
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double azimuth = 2.0 * std::numbers::pi * v;
    // Two axes across `direction` without a case for any but the sign of z (Duff et al., Building an Orthonormal
    // Basis, Revisited, JCGT 2017).
    const glm::dvec3& n = direction;
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    const glm::dvec3 across_1(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const glm::dvec3 across_2(b, sign + n.y * n.y * a, -n.y);
    return glm::normalize(sine * std::cos(azimuth) * across_1 + sine * std::sin(azimuth) * across_2 + cosine * n);
}

}  // namespace bruma::reference
