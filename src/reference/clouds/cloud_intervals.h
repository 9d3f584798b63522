#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

/// Where a ray runs inside a layer of clouds. Everything is a template over Real: the same lines in float are the form
/// that stays exact to centimetres on a planet, and tests hold them against double and long double.
namespace bruma::reference {

template <class Real>
struct Interval {
    Real begin = 0, end = 0;  ///< metres along the ray; 0 <= begin <= end
};

/// A ray meets a layer of clouds at most twice.
template <class Real>
struct Intervals {
    std::array<Interval<Real>, 2> parts{};
    int count = 0;
    void add(Real begin, Real end) {
        if (end > begin) {
            parts[std::size_t(count++)] = {begin, end};
        }
    }
};

/// Inside an axis-parallel box, by slabs; from the origin on when that lies inside.
template <class Real>
Intervals<Real> box_intervals(const glm::vec<3, Real, glm::defaultp>& origin,
                              const glm::vec<3, Real, glm::defaultp>& direction,
                              const glm::vec<3, Real, glm::defaultp>& low,
                              const glm::vec<3, Real, glm::defaultp>& high) {
    Real enter = 0;
    Real leave = std::numeric_limits<Real>::max();
    for (int axis = 0; axis < 3; ++axis) {
        // 0 * infinity would be NaN for an origin in a face: no component of the direction is let down to 0.
        const Real slope =
            std::abs(direction[axis]) < Real(1e-8) ? std::copysign(Real(1e-8), direction[axis]) : direction[axis];
        const Real a = (low[axis] - origin[axis]) / slope;
        const Real b = (high[axis] - origin[axis]) / slope;
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    Intervals<Real> result;
    result.add(enter, leave);
    return result;
}

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

/// Between the altitudes bottom_m < top_m over a planet that hides what lies behind it. The origin is above the ground.
template <class Real>
Intervals<Real> shell_intervals(Real planet_radius_m, Real from_m, Real climb, Real bottom_m, Real top_m) {
    const auto ground = sphere_hits(planet_radius_m, from_m, climb, Real(0));
    const auto bottom = sphere_hits(planet_radius_m, from_m, climb, bottom_m);
    const auto top = sphere_hits(planet_radius_m, from_m, climb, top_m);
    const bool ground_ahead = ground.hit && ground.near > Real(0);
    Intervals<Real> result;
    if (from_m <= bottom_m) {  // on the bottom counts as below: its near root is 0 there, and the gap would be marched
        if (!ground_ahead) {
            result.add(std::max(bottom.far, Real(0)), top.far);
        }
        return result;
    }
    if (from_m > top_m && !(top.hit && top.near > Real(0))) {
        return result;
    }
    const Real enter = from_m > top_m ? top.near : Real(0);
    if (!bottom.hit || bottom.near <= Real(0)) {
        result.add(enter, top.far);
        return result;
    }
    result.add(enter, bottom.near);
    if (!ground_ahead) {
        result.add(bottom.far, top.far);
    }
    return result;
}

/// Altitude of a point relative to the sea-level point below the camera, y up there: without the difference of two
/// lengths of the planet's size.
template <class Real>
Real altitude_above(Real planet_radius_m, const glm::vec<3, Real, glm::defaultp>& from_sea_level) {
    const Real rise = Real(2) * planet_radius_m * from_sea_level.y + glm::dot(from_sea_level, from_sea_level);
    return rise / (std::sqrt(planet_radius_m * planet_radius_m + rise) + planet_radius_m);
}

}  // namespace bruma::reference
