#pragma once
#include <glm/glm.hpp>
#include <optional>

/// A smooth boundary between two dielectrics, for unpolarised light. `eta` is always n_inside / n_outside >= 1,
/// normals point out of the body, directions have unit length.
namespace bruma::reference {

/// Share of power that is reflected. `relative_index` is that of the far side divided by that of the near side;
/// 1 beyond the critical angle. `cos_incidence` in [0, 1].
double fresnel_reflectance(double cos_incidence, double relative_index);

/// Share of power that passes from outside to inside or, along the reversed path, from inside to outside; both are the
/// same number, told by the cosine of the angle outside. 0 for cosines below 0.
double fresnel_transmittance(double cos_outside, double eta);

/// Where light that comes from `to_light` (a direction away from the surface, above it) travels inside the body.
glm::dvec3 refract_into(glm::dvec3 to_light, glm::dvec3 normal, double eta);

/// Where light travelling inside along `direction` (towards the surface, direction . normal > 0) leaves, or nothing
/// where it is reflected totally.
std::optional<glm::dvec3> refract_out(glm::dvec3 direction, glm::dvec3 normal, double eta);

/// Hemispherical moments of the reflectance R(mu) of one side of the boundary.
struct FresnelMoments {
    double twice_c1 = 0.0;   ///< 2 integral of R mu over [0, 1]
    double thrice_c2 = 0.0;  ///< 3 integral of R mu^2 over [0, 1]
};

/// Polynomial fits of d'Eon and Irving, A Quantized-Diffusion Model for Rendering Translucent Materials, SIGGRAPH 2011.
/// `index` above 1 is light inside the body, below 1 light outside. Good to 0.01 for [0.4, 0.952] and [1.05, 2.5] and
/// useless outside: see `fits_hold`.
FresnelMoments fitted_fresnel_moments(double index);
bool fresnel_fits_hold(double index);

/// By quadrature split at the critical angle; to 1e-12. Any index > 0; a matched boundary gives 0.
FresnelMoments exact_fresnel_moments(double index);

enum class MomentSource { published_fits, exact };

/// The constants of a diffusion boundary (Frisvad et al. 2014, Directional Dipole Model for Subsurface Scattering).
struct DiffuseBoundary {
    double c_phi = 0.0;  ///< C_phi(eta) = (1 - 2 C1) / 4
    double c_e = 0.0;    ///< C_E(eta) = (1 - 3 C2) / 2
    double c_phi_inverse =
        0.0;         ///< C_phi(1 / eta); light that leaves fills 4 pi C_phi(1 / eta) of T-weighted solid angle
    double a = 0.0;  ///< A(eta) = (1 - C_E) / (2 C_phi)
};
/// Where the published fits do not hold, the exact moments stand in for them.
DiffuseBoundary diffuse_boundary(double eta, MomentSource source = MomentSource::published_fits);

}  // namespace bruma::reference
