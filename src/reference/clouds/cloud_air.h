#pragma once
#include <functional>
#include <vector>

#include "reference/sky/sky_tables.h"

namespace bruma::reference {

/// What the air from an eye up to any point of one ray adds and leaves, for irradiance 1 of the sun: by midpoints that
/// stand closer near the eye. In front of each segment of a cloud, where pictures take one distance for all of it.
class AirAlongRay {
  public:
    /// Share of the sun's light that reaches a point, relative to the sea level below the camera; empty: all.
    using SunShare = std::function<double(const glm::dvec3& from_sea_level)>;
    /// `from_sea_level`: the eye, relative to the sea level below the camera, y up there. `sun_share` dims what is
    /// scattered once alone.
    AirAlongRay(const AtmosphereTables& tables, const glm::dvec3& from_sea_level, const glm::dvec3& direction,
                const glm::dvec3& to_sun, double longest_m, int steps = 512, const SunShare& sun_share = {});
    AirLight before(double distance_m) const;

  private:
    double longest_m_;
    std::vector<AirLight> ends_;  ///< of the segments; their distances grow with the square of the index
};

}  // namespace bruma::reference
