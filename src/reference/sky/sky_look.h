#pragma once
#include <glm/glm.hpp>

#include "scene/sky/sky.h"

namespace bruma::reference {

/// Scattering coefficient of air for wavelengths in metres: 8 pi^3 (n^2 - 1)^2 (6 + 3p) / (3 N l^4 (6 - 7p)), in 1/m.
glm::dvec3 rayleigh_coefficient(const glm::dvec3& wavelength_m);

/// Relative air mass towards a zenith angle in degrees of at most 90 (Kasten and Young's form).
double look_air_mass(double zenith_deg);

/// The sky of three.js' Sky.js as Alaminos 2020 used it: single scattering under Preetham's names with exponents that
/// are no physics and a disc of twice the sun's radius, in a unit of its own (see GroundSky).
glm::dvec3 look_radiance(const scene::Sky& sky, const glm::dvec3& direction_world, const glm::dvec3& to_sun_world,
                         bool with_disc = true);
/// Where its disc ends, radians from the sun's middle.
constexpr double look_disc_radius = 0.0093087;

}  // namespace bruma::reference
