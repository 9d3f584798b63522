#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

/// Where a ray runs inside a layer of clouds. Everything is a template over Real: the same lines in float are the form
/// that stays exact to centimetres on a planet, and tests hold them against double and long double.
#include "reference/planet_spheres.h"

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

}  // namespace bruma::reference
