#pragma once
#include <glm/glm.hpp>

/// The phase function of Henyey and Greenstein (Diffuse radiation in the galaxy, Astrophysical Journal 93, 1941). The
/// angle lies between the ways that light travels before and after, so that g > 0 scatters forward: 0 degrees is on.
namespace bruma::reference {

/// Share scattered per steradian; its integral over the sphere is 1. |g| < 1.
double henyey_greenstein(double g, double cosine);

/// Share scattered by less than the given angle, in [0, 1].
double share_in_cone(double g, double cosine_of_half_angle);

/// The cosine below which a share `uniform` in [0, 1] lies: sampling by the inverse of the distribution.
double sample_cosine(double g, double uniform);

/// The way after scattering: at an angle to `way` (unit) drawn by `sample_cosine`, all round alike. `u`, `v` uniform
/// in [0, 1).
glm::dvec3 sample_way(double g, glm::dvec3 way, double u, double v);

}  // namespace bruma::reference
