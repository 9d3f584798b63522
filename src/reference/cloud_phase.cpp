#include "reference/cloud_phase.h"

namespace bruma::reference {

glm::dvec3 sample_henyey_greenstein(const glm::dvec3& forward_world, double g, double u, double v) {
    double mu = 1.0 - 2.0 * u;
    if (std::abs(g) > 1e-3) {
        const double part = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
        mu = std::clamp((1.0 + g * g - part * part) / (2.0 * g), -1.0, 1.0);
    }
    const double radius = std::sqrt(std::max(0.0, 1.0 - mu * mu));
    const double phi = 2.0 * std::numbers::pi * v;
    // Frame of Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
    const glm::dvec3& n = forward_world;
    const double sign = std::copysign(1.0, n.z);
    const double a = -1.0 / (sign + n.z);
    const double b = n.x * n.y * a;
    const glm::dvec3 x(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    const glm::dvec3 y(b, sign + n.y * n.y * a, -n.y);
    return glm::normalize(radius * std::cos(phi) * x + radius * std::sin(phi) * y + mu * n);
}

}  // namespace bruma::reference
