#pragma once
#include <glm/glm.hpp>

#include "scene/sky/sky.h"

/// Light in an atmosphere after Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering
/// Technique". Altitudes in metres above the ground; `climb` is the vertical component of a unit direction there; all
/// radiances are for a sun of irradiance 1 above the atmosphere.
namespace bruma::reference {

/// The air at one altitude, in 1/m.
struct AirPoint {
    glm::dvec3 rayleigh{0.0};  ///< scattering
    double mie = 0.0;          ///< scattering
    glm::dvec3 extinction{0.0};
    glm::dvec3 scattering() const { return rayleigh + glm::dvec3(mie); }
};
AirPoint air_at(const scene::Atmosphere& atmosphere, double altitude_m);

double rayleigh_phase(double mu);
/// Cornette and Shanks 1992.
double mie_phase(double mu, double g);

/// Distance to the upper end of the atmosphere, or to the ground where a ray meets that.
double distance_to_top(const scene::Atmosphere& atmosphere, double altitude_m, double climb);
double distance_to_end(const scene::Atmosphere& atmosphere, double altitude_m, double climb);
/// The vertical component of the ray that just touches the ground.
double horizon_climb(const scene::Atmosphere& atmosphere, double altitude_m);

/// Of the path up to the end of the atmosphere, by `steps` midpoints; the ray is taken to miss the ground.
glm::dvec3 transmittance_to_top(const scene::Atmosphere& atmosphere, double altitude_m, double climb, int steps = 1000);

/// Share of the sun's disc above the horizon of a point, smooth over the disc's angle.
double sun_disc_above_horizon(const scene::Atmosphere& atmosphere, double altitude_m, double sun_climb,
                              double angular_radius_rad = 0.004675);

/// Coordinates in [0,1]^2 of the transmittance table: u from the ray straight up (0) to the horizon (1), v over the
/// altitude; both are dense where the transmittance bends (Bruneton and Neyret 2008).
struct TransmittancePlace {
    double altitude_m = 0.0, climb = 1.0;
};
glm::dvec2 transmittance_coordinates(const scene::Atmosphere& atmosphere, TransmittancePlace place);
TransmittancePlace transmittance_place(const scene::Atmosphere& atmosphere, glm::dvec2 coordinates);

/// Coordinates of the sky-view table: u from towards the sun (0) to away from it (1), v from the zenith (0) over the
/// horizon (0.5) to straight down (1). `toward_ground` chooses the half: v = 0.5 is both sky and ground.
struct SkyViewPlace {
    double zenith_angle = 0.0;    ///< radians
    double azimuth_cosine = 1.0;  ///< to the sun
};
glm::dvec2 sky_view_coordinates(const scene::Atmosphere& atmosphere, double altitude_m, SkyViewPlace place,
                                bool toward_ground);
SkyViewPlace sky_view_place(const scene::Atmosphere& atmosphere, double altitude_m, glm::dvec2 coordinates);

/// Radiance of the sun's disc for irradiance 1, at `angle_rad` from its middle, without the atmosphere; red, green and
/// blue darken towards the limb (Hestroffer and Magnan 1998) and keep the irradiance.
glm::dvec3 sun_disc_radiance(double angle_rad, double angular_radius_rad, bool limb_darkening);

}  // namespace bruma::reference
