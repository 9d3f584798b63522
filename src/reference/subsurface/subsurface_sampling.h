#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "reference/subsurface/subsurface_medium.h"

/// Densities of points in the plane across the light, from which the BSSRDF integral of one point x_o is estimated:
///
///     R(x_o) = E_perp / N  sum of T_12 S_d(x_j; x_o) / p(d_j)
///
/// d is the offset from x_o in that plane, mm; p is per mm^2 and integrates to 1 over the plane. A drawn point that
/// meets no surface counts in N. All lengths in mm.
namespace bruma::reference {

/// Van der Corput's radical inverse of n in a prime base, in [0, 1).
double radical_inverse(std::uint64_t n, unsigned base);

/// A point of the disk of radius 1, uniform by area for uniform u, v in [0, 1).
glm::dvec2 uniform_disk_point(double u, double v);

/// e^(-sigma* rho) on a disk: the density of Dal Corso et al., Interactive Directional Subsurface Scattering and
/// Transport of Emergent Light, The Visual Computer 2016.
class ExponentialDisk {
  public:
    ExponentialDisk(double rate, double radius);
    /// sigma* = the smallest sigma_tr, radius 8 / sigma*. A sigma_tr of 0 is raised to 0.5e-3 / `bounding_radius`.
    static ExponentialDisk published(const SubsurfaceMedium& medium, double bounding_radius);
    /// The same cut at the body's bounding diameter, beyond which nothing can lie (at its radius, light is lost).
    ExponentialDisk cut_to(double bounding_radius) const;

    double rate() const { return rate_; }
    double radius() const { return radius_; }
    /// Z = integral of e^(-sigma* rho) over the disk, mm^2.
    double normaliser() const;
    double pdf(glm::dvec2 d) const;
    glm::dvec2 sample(double u, double v) const;

  private:
    double rate_, radius_;
};

/// For x_o in the light: a core as wide as a transport mean free path and a tail as long as 1 / sigma_tr, of every
/// channel; p = 1/6 sum of s e^(-s rho) / (2 pi rho) over six rates s.
class CoreTailDensity {
  public:
    /// A core narrower than half a texel of the light map cannot be resolved: `texel` > 0 caps its rates at 2 / texel.
    CoreTailDensity(const SubsurfaceMedium& medium, double bounding_radius, double texel = 0.0);
    double pdf(glm::dvec2 d) const;
    glm::dvec2 sample(double u, double v) const;
    /// The six rates, 1/mm: tails of red, green and blue, then cores.
    const std::array<double, 6>& rates() const { return rates_; }

  private:
    friend class BackLitDensity;
    std::array<double, 6> rates_;
};

/// The body's outline seen along the light: a disk that holds it.
struct BoundingDisk {
    glm::dvec2 centre{0.0};  ///< relative to x_o
    double radius = 1.0;
};

/// For x_o at depth h below the lit surface: core + tail with cores no narrower than h, or h / 2 in thick parts, mixed
/// with uniform points in the bounding disk, since from behind a body all of its lit side is seen alike. In thick parts
/// (h at least a quarter of the disk's radius) points that would be uniform on a lit hemisphere over the disk are mixed
/// in: the rim of the lit side is nearest to what lies behind it. Half of the points stay around x_o, for bodies that
/// are no ball: a strand in another's shade is lit from beside, so near that few points elsewhere would find it.
class BackLitDensity {
  public:
    BackLitDensity(const SubsurfaceMedium& medium, double depth, BoundingDisk disk);
    double pdf(glm::dvec2 d) const;
    glm::dvec2 sample(double u, double v) const;
    /// Share of uniform points: 1/4.
    double uniform_share() const { return uniform_share_; }
    /// Share of points on the hemisphere: 1/4, or none in thin parts.
    double hemisphere_share() const { return hemisphere_share_; }
    /// What both of these add to `pdf`.
    double disk_pdf(glm::dvec2 d) const;

  private:
    CoreTailDensity around_;
    BoundingDisk disk_;
    double uniform_share_, hemisphere_share_;
};

/// Whether x_o at depth h along the light is to be sampled by BackLitDensity.
bool is_back_lit(const SubsurfaceMedium& medium, double depth);

}  // namespace bruma::reference
