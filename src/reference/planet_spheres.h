#pragma once
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace bruma::reference {

/// Where a line meets a sphere around the planet; both distances are negative behind the origin.
template <class Real>
struct SphereHits {
    bool hit = false;
    Real near = 0, far = 0;
};

/// Sphere of altitude `sphere_m` seen from altitude `from_m`; `climb` is the vertical component of the unit direction.
/// No squares of the planet's radius are subtracted: the constant term is factored, and the root that would cancel
/// comes from the product of both (Citardauq). In float this holds to some millimetres where the textbook form is off
/// by metres.
template <class Real>
SphereHits<Real> sphere_hits(Real planet_radius_m, Real from_m, Real climb, Real sphere_m) {
    const Real product = (from_m - sphere_m) * (Real(2) * planet_radius_m + from_m + sphere_m);
    const Real half_sum = (planet_radius_m + from_m) * climb;
    const Real discriminant = half_sum * half_sum - product;
    if (!(discriminant >= Real(0))) {
        return {};
    }
    const Real root = std::sqrt(discriminant);
    const Real q = half_sum > Real(0) ? -half_sum - root : -half_sum + root;
    const Real other = q == Real(0) ? Real(0) : product / q;
    return {true, std::min(q, other), std::max(q, other)};
}

/// Altitude of a point relative to the sea-level point below the camera, y up there: without the difference of two
/// lengths of the planet's size.
template <class Real>
Real altitude_above(Real planet_radius_m, const glm::vec<3, Real, glm::defaultp>& from_sea_level) {
    const Real rise = Real(2) * planet_radius_m * from_sea_level.y + glm::dot(from_sea_level, from_sea_level);
    return rise / (std::sqrt(planet_radius_m * planet_radius_m + rise) + planet_radius_m);
}

}  // namespace bruma::reference
