#pragma once
#include <array>
#include <glm/glm.hpp>

#include "reference/subsurface/fresnel.h"
#include "reference/subsurface/subsurface_medium.h"

/// Analytic models of light that enters a body at one point and leaves it at another. All give S_d, in 1/(mm^2 sr),
/// without the Fresnel transmittances: S = T_12 S_d T_21.
namespace bruma::reference {

/// A place on the surface: mm, and the outward unit normal.
struct SurfacePoint {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};
};

enum class SubsurfaceModel {
    standard_dipole,     ///< Jensen, Marschner, Levoy, Hanrahan, A Practical Model for Subsurface Light Transport, 2001
    directional_dipole,  ///< Frisvad, Hachisuka, Kjeldsen, Directional Dipole Model for Subsurface Scattering, 2014
    normalised_directional_dipole  ///< the same times `energy_normalisation`
};

/// Distance of the standard dipole's reflecting boundary in units of 2 D: (1 + F_dr) / (1 - F_dr), with the fit of F_dr
/// that Jensen et al. take from Egan and Hilgeman 1973. eta >= 1.
double standard_dipole_a(double eta);
/// The same with the exact internal reflectance 2 C1(eta) in place of F_dr.
double standard_dipole_exact_a(double eta);
/// Total diffuse reflectance of a half-space by the standard dipole.
double standard_dipole_reflectance(double albedo_reduced, double a);

/// Ratio of the true diffuse reflectance of a half-space at normal incidence to that of the directional dipole, which
/// returns too much. Tabulated from random walks for eta 1.3 and 1.5, interpolated over albedo and eta; (0, 1).
double energy_normalisation(double albedo_reduced, double eta);

/// One channel of one model, with all that does not depend on place worked out.
class Dipole {
  public:
    /// The constants of the published fits are what other implementations use; `exact` moves results by some 1e-3.
    Dipole(const SubsurfaceChannel& channel, SubsurfaceModel model,
           MomentSource moments = MomentSource::published_fits);

    /// S_d for light that travels inside along `omega_12` from `entry`; 1/(mm^2 sr), never negative, finite
    /// everywhere except for the standard dipole's limit sigma_t' = infinity.
    double s_d(const SurfacePoint& entry, glm::dvec3 omega_12, const SurfacePoint& exit) const;

    const DiffusionConstants& diffusion() const { return diffusion_; }
    const DiffuseBoundary& boundary() const { return boundary_; }

  private:
    double standard(double r2) const;
    double directional(const SurfacePoint& entry, glm::dvec3 omega_12, const SurfacePoint& exit) const;

    SubsurfaceModel model_;
    DiffusionConstants diffusion_;
    DiffuseBoundary boundary_;
    double standard_a_;
    double normalisation_;
};

/// S'_d: what a ray source of unit power in an infinite medium sends out through a surface of normal `n_o` at offset
/// `y`, along `w`: (C_phi phi - C_E D n_o . grad phi) / (4 pi C_phi(1 / eta)), 1/(mm^2 sr), of either sign. The
/// regularised squared distance `rho2` stands where |y|^2 does, but not in the dot products.
double ray_source_radiance(const DiffusionConstants& diffusion, const DiffuseBoundary& boundary, glm::dvec3 y,
                           glm::dvec3 w, glm::dvec3 n_o, double rho2);

/// Squared distance to the real source that the directional dipole uses: moved off the surface where light arrives from
/// the front, and behind a body by what light travels between two events.
double directional_dipole_d_r2(const DiffusionConstants& diffusion, glm::dvec3 x, glm::dvec3 omega_12, glm::dvec3 n_o);

/// The normal of the modified tangent plane: the part of n_i across x, so that the mirror images stay apart on curved
/// surfaces. For x along n_i the direction is free, and the one across the plane of incidence is taken.
glm::dvec3 modified_tangent_normal(glm::dvec3 n_i, glm::dvec3 omega_12, glm::dvec3 x);

/// Three channels.
class Bssrdf {
  public:
    /// Throws InputError for a medium out of range.
    Bssrdf(const SubsurfaceMedium& medium, SubsurfaceModel model, MomentSource moments = MomentSource::published_fits);

    glm::dvec3 s_d(const SurfacePoint& entry, glm::dvec3 omega_12, const SurfacePoint& exit) const {
        return {channels_[0].s_d(entry, omega_12, exit), channels_[1].s_d(entry, omega_12, exit),
                channels_[2].s_d(entry, omega_12, exit)};
    }

    const SubsurfaceMedium& medium() const { return medium_; }
    const Dipole& channel(int c) const { return channels_[std::size_t(c)]; }
    /// Shortest of 1 / sigma_t', mm: the finest detail of S_d.
    double shortest_transport_length() const;
    /// 4 pi C_phi(1 / eta): exitance leaving through a smooth boundary per T_21-free radiance.
    double exitance_per_radiance() const;

  private:
    SubsurfaceMedium medium_;
    std::array<Dipole, 3> channels_;
};

}  // namespace bruma::reference
