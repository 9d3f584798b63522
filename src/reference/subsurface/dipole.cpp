#include "reference/subsurface/dipole.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::reference {
namespace {

using std::numbers::pi;

glm::dvec3 any_orthogonal(glm::dvec3 n) {
    const glm::dvec3 axis = std::abs(n.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    return glm::normalize(glm::cross(axis, n));
}

const SubsurfaceMedium& checked(const SubsurfaceMedium& medium) {
    check(medium);
    return medium;
}

}  // namespace

double standard_dipole_a(double eta) {
    const double f_dr = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
    return (1.0 + f_dr) / (1.0 - f_dr);
}

double standard_dipole_exact_a(double eta) {
    const double f_dr = exact_fresnel_moments(eta).twice_c1;
    return (1.0 + f_dr) / (1.0 - f_dr);
}

double standard_dipole_reflectance(double albedo_reduced, double a) {
    const double q = std::sqrt(3.0 * (1.0 - albedo_reduced));
    return 0.5 * albedo_reduced * (1.0 + std::exp(-4.0 / 3.0 * a * q)) * std::exp(-q);
}

double ray_source_radiance(const DiffusionConstants& k, const DiffuseBoundary& b, glm::dvec3 y, glm::dvec3 w,
                           glm::dvec3 n_o, double rho2) {
    const double y_w = glm::dot(y, w);
    const double rho = std::sqrt(rho2);
    const double t = k.sigma_tr * rho;
    const double p = 1.0 + t;
    const double fluence = b.c_phi * (rho2 / k.d + 3.0 * p * y_w);
    const double flux = b.c_e * (3.0 * k.d * p * glm::dot(w, n_o) -
                                 (p + 3.0 * k.d * (3.0 * p + t * t) / rho2 * y_w) * glm::dot(y, n_o));
    return std::exp(-t) / (rho2 * rho) * (fluence - flux) / (16.0 * pi * pi * b.c_phi_inverse);
}

double directional_dipole_d_r2(const DiffusionConstants& k, glm::dvec3 x, glm::dvec3 omega_12, glm::dvec3 n_o) {
    const double r2 = glm::dot(x, x);
    const double mu_0 = -glm::dot(omega_12, n_o);
    if (mu_0 <= 0.0) {
        return r2 + 1.0 / (9.0 * k.sigma_t * k.sigma_t);  // the one place where sigma_t is not reduced
    }
    const double along = glm::dot(x, omega_12);
    // Rounding can make the difference negative when x lies along omega_12.
    const double cos_beta = -std::sqrt(std::max(0.0, r2 - along * along) / (r2 + k.d_e * k.d_e));
    return r2 + k.d * mu_0 * (k.d * mu_0 - 2.0 * k.d_e * cos_beta);
}

glm::dvec3 modified_tangent_normal(glm::dvec3 n_i, glm::dvec3 omega_12, glm::dvec3 x) {
    const double r = glm::length(x);
    if (r == 0.0) {
        return n_i;
    }
    const glm::dvec3 x_hat = x / r;
    constexpr double parallel = 1e-5;  // sine of an angle: relative, so that no unit of length matters
    if (glm::length(glm::cross(n_i, x_hat)) >= parallel) {
        return glm::normalize(n_i - x_hat * glm::dot(x_hat, n_i));
    }
    const glm::dvec3 across = glm::cross(n_i, omega_12);
    const double sine = glm::length(across);
    return sine >= parallel ? across / sine : any_orthogonal(n_i);
}

Dipole::Dipole(const SubsurfaceChannel& channel, SubsurfaceModel model, MomentSource moments)
    : model_(model),
      diffusion_(diffusion_constants(channel)),
      boundary_(diffuse_boundary(channel.eta, moments)),
      standard_a_(moments == MomentSource::exact ? standard_dipole_exact_a(channel.eta)
                                                 : standard_dipole_a(channel.eta)),
      normalisation_(model == SubsurfaceModel::normalised_directional_dipole
                         ? energy_normalisation(diffusion_.albedo_reduced, channel.eta)
                         : 1.0) {
    check(channel);
}

double Dipole::s_d(const SurfacePoint& entry, glm::dvec3 omega_12, const SurfacePoint& exit) const {
    if (model_ == SubsurfaceModel::standard_dipole) {
        const glm::dvec3 x = exit.position - entry.position;
        return standard(glm::dot(x, x));
    }
    return normalisation_ * directional(entry, omega_12, exit);
}

double Dipole::standard(double r2) const {
    const double z_r = 1.0 / diffusion_.sigma_t_reduced;
    const double z_v = z_r * (1.0 + 4.0 / 3.0 * standard_a_);
    const auto pole = [&](double z) {
        const double d2 = r2 + z * z;
        const double d = std::sqrt(d2);
        return z * (1.0 + diffusion_.sigma_tr * d) * std::exp(-diffusion_.sigma_tr * d) / (d2 * d);
    };
    return diffusion_.albedo_reduced / (4.0 * pi * pi) * (pole(z_r) + pole(z_v));
}

double Dipole::directional(const SurfacePoint& entry, glm::dvec3 omega_12, const SurfacePoint& exit) const {
    const glm::dvec3 x = exit.position - entry.position;
    const glm::dvec3 n_star = modified_tangent_normal(entry.normal, omega_12, x);
    const double lift = 2.0 * boundary_.a * diffusion_.d_e;

    const glm::dvec3 y = x - lift * n_star;
    const glm::dvec3 mirrored = omega_12 - 2.0 * glm::dot(omega_12, n_star) * n_star;
    const double d_r2 = directional_dipole_d_r2(diffusion_, x, omega_12, exit.normal);
    const double real = ray_source_radiance(diffusion_, boundary_, x, omega_12, exit.normal, d_r2);
    const double virtual_one = ray_source_radiance(diffusion_, boundary_, y, mirrored, exit.normal, glm::dot(y, y));
    return std::max(0.0, real - virtual_one);
}

Bssrdf::Bssrdf(const SubsurfaceMedium& medium, SubsurfaceModel model, MomentSource moments)
    : medium_(checked(medium)),
      channels_{Dipole(medium.channel(0), model, moments), Dipole(medium.channel(1), model, moments),
                Dipole(medium.channel(2), model, moments)} {}

double Bssrdf::shortest_transport_length() const {
    double length = 1e300;
    for (const Dipole& channel : channels_) {
        length = std::min(length, 1.0 / channel.diffusion().sigma_t_reduced);
    }
    return length;
}

double Bssrdf::exitance_per_radiance() const {
    return 4.0 * pi * channels_[0].boundary().c_phi_inverse;
}

}  // namespace bruma::reference
