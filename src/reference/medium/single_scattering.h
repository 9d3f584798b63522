#pragma once
#include "reference/medium/scattering_scene.h"
#include "reference/volume/emission_absorption.h"

namespace bruma::reference {

/// Light that reaches the eye after one change of direction at most, by brute force: the emission-absorption integral
/// whose source is
///
///     S = w sum over lights of E p(cos) T + e C,   w = albedo C
///
/// (see scene::VolumeOptics), with T by a ray towards the light at each node of the quadrature. All volumes shadow each
/// other. Volumes of lighting none or gradient keep their own S, unshadowed, and absorb. With optics.surfaces the phase
/// function gives way to Lambert's law where the gradient is a surface, and a highlight is added, all in the shadow:
///
///     S = w sum of E T ((1 - s) p + s diffuse |n.l| / pi) + s specular sum of E T highlight / pi + e C
class SingleScattering {
  public:
    /// `tolerance` of each ray's radiance, or a hundredth of it as a share of that where this is more. Keeps a
    /// reference to the scene.
    SingleScattering(const ScatteringScene& scene, double tolerance, bool leap = true)
        : scene_(scene), tolerance_(tolerance), leap_(leap) {}

    RayResult trace(const scene::Ray& ray) const;
    /// What reaches the eye on its own way, not scattered: emission, and volumes of lighting none and gradient.
    RayResult trace_unscattered(const scene::Ray& ray) const;

  private:
    const ScatteringScene& scene_;
    double tolerance_;
    bool leap_;
};

}  // namespace bruma::reference
