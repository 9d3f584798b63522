#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "scene/cloud_optics.h"

/// Phase functions of clouds, in 1/sr; all integrate to 1 over the sphere. `mu` is the cosine between the view ray (eye
/// to scene) and the direction to the sun: looking at the sun gives +1, and g > 0 then peaks there.
namespace bruma::reference {

/// Henyey and Greenstein 1941.
inline double henyey_greenstein(double mu, double g) {
    g = std::clamp(g, -0.99, 0.99);
    const double base = std::max(1.0 + g * g - 2.0 * g * mu, 1e-4);
    return (1.0 - g * g) / (4.0 * std::numbers::pi * base * std::sqrt(base));
}

/// Two Henyey-Greenstein lobes with both asymmetries scaled by `anisotropy`.
inline double dual_lobe(double mu, const scene::CloudOptics& optics, double anisotropy = 1.0) {
    return optics.forward_share * henyey_greenstein(mu, optics.forward_g * anisotropy) +
           (1.0 - optics.forward_share) * henyey_greenstein(mu, optics.backward_g * anisotropy);
}

/// Draine 2003, "Scattering by Interstellar Dust Grains": Henyey-Greenstein for alpha 0, Cornette-Shanks for 1.
inline double draine(double mu, double g, double alpha) {
    const double base = 1.0 + g * g - 2.0 * g * mu;
    return (1.0 - g * g) * (1.0 + alpha * mu * mu) /
           (4.0 * std::numbers::pi * (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0) * base * std::sqrt(base));
}

/// Water droplets of 10 um: fit of Jendersie and d'Eon 2023, "An Approximate Mie Scattering Function for Fog and Cloud
/// Rendering".
inline double droplets_10_um(double mu) {
    constexpr double g_hg = 0.98818, g_draine = 0.55567, alpha = 21.9955, draine_share = 0.48196;
    // No clamp of the peak here: its base is 1.4e-4 at mu = 1.
    return (1.0 - draine_share) * henyey_greenstein(mu, g_hg) + draine_share * draine(mu, g_draine, alpha);
}

/// Schlick's approximation, with the sign that makes k > 0 forward and Pharr's fit of k to a Henyey-Greenstein g.
inline double schlick_k(double g) {
    return 1.55 * g - 0.55 * g * g * g;
}
inline double schlick(double mu, double k) {
    const double base = 1.0 - k * mu;
    return (1.0 - k * k) / (4.0 * std::numbers::pi * base * base);
}

/// Direction drawn from a Henyey-Greenstein lobe around `forward_world`, by two numbers in [0,1). Here g > 0 goes on
/// along `forward_world`, which is where light goes and not where it comes from.
glm::dvec3 sample_henyey_greenstein(const glm::dvec3& forward_world, double g, double u, double v);

}  // namespace bruma::reference
