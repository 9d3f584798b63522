#pragma once
#include "reference/sky/sky_tables.h"
#include "scene/sky/sky.h"

namespace bruma::reference {

/// A model for comparison, preetham or look, as seen from the ground, in the unit of the atmosphere: for a sun of
/// irradiance 1 above the air, without its disc.
///
/// preetham: its luminance over the solar illuminance above the air, 127.5 klx (IES; 93.7 lm/W of 1361 W/m2). The fit
/// is one by day: under a low sun it is several times too bright (Zotti, Wilkie, Purgathofer 2007, "A Critical Review
/// of the Preetham Skylight Model"). A level plane therefore gets at most half of what the sun sends down, which is
/// what air that scatters evenly does not throw back, and the atmosphere's light, which is all that is left at
/// twilight. A sun that has set stays on the horizon, and a turbidity above 10, where the fit sends more than the sun,
/// is 10. look: scaled so that a level plane gets the atmosphere's luminance.
class GroundSky {
  public:
    /// `atmosphere_planar`: light of the atmosphere on a level plane.
    GroundSky(const scene::Sky& sky, const glm::dvec3& to_sun, const glm::dvec3& atmosphere_planar);

    /// Below the horizon its colour goes on.
    glm::dvec3 radiance(const glm::dvec3& direction) const { return scale_ * bare(direction); }
    /// Of look's own disc; nothing for preetham, which has the sun's.
    glm::dvec3 disc(const glm::dvec3& direction) const;
    const SkyIrradiance& irradiance() const { return irradiance_; }

  private:
    glm::dvec3 bare(const glm::dvec3& direction) const;
    scene::Sky sky_;
    glm::dvec3 to_sun_;
    double scale_ = 1.0;
    SkyIrradiance irradiance_;
};

}  // namespace bruma::reference
