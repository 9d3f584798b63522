#pragma once
#include <cmath>
#include <numbers>

#include "reference/phase_function.h"
#include "scene/clouds/cloud_optics.h"

/// Phase functions of clouds, in 1/sr; all integrate to 1 over the sphere. `mu` is the cosine between the view ray (eye
/// to scene) and the direction to the sun: looking at the sun gives +1, and g > 0 then peaks there.
namespace bruma::reference {

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

}  // namespace bruma::reference
