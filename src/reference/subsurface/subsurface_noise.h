#pragma once
#include <functional>

#include "reference/subsurface/dipole.h"

/// How noisy an estimate of R(x_o) from one drawn point is (see subsurface_sampling.h), by quadrature of the first two
/// moments of T_12 S_d / p. For the same noise evaluations are needed in proportion to the deviation's square.
namespace bruma::reference {

/// Per mm^2 at an offset from x_o in the plane across the light, mm.
using PlaneDensity = std::function<double(glm::dvec2)>;
/// Of one of the densities in subsurface_sampling.h, which must outlive it.
template <class Density>
PlaneDensity pdf_of(const Density& density) {
    return [&density](glm::dvec2 d) { return density.pdf(d); };
}

/// Integrals over the plane across the light.
struct EstimateMoments {
    double mean = 0.0;    ///< of T_12 S_d: R(x_o) for E_perp = 1
    double square = 0.0;  ///< of (T_12 S_d)^2 / p
    /// Standard deviation of T_12 S_d / p over its mean.
    double deviation() const;
};

/// x_o on a flat half-space in normal light, for a density of the distance alone; nothing is drawn, and nothing summed,
/// beyond `end`, mm. `rate`, 1/mm: no faster than S_d and p decay. T_12, a constant here, is left out.
EstimateMoments lit_slab_moments(const Dipole& dipole, double rate, const PlaneDensity& pdf, double end = 1e300);

/// T_12 S_d on a sphere around the origin lit along +z, for a point of the light plane at `across`; 0 beside it.
double sphere_kernel(const Dipole& dipole, double eta, double radius, glm::dvec2 across, const SurfacePoint& exit);
/// A place on that sphere by the cosine of its angle from the lit pole.
SurfacePoint on_sphere(double radius, double cosine);
/// x_o on that sphere: at the lit pole, or behind, where the kernel is smooth.
EstimateMoments sphere_moments(const Dipole& dipole, double eta, double radius, const SurfacePoint& exit,
                               const PlaneDensity& pdf);

}  // namespace bruma::reference
