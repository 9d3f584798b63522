#pragma once
#include <glm/glm.hpp>

/// The phase function of Henyey and Greenstein (Diffuse radiation in the galaxy, Astrophysical Journal 93, 1941). The
/// angle lies between the ways that light travels before and after, so that g > 0 scatters forward: 0 degrees is on.
namespace bruma::reference {

/// Share scattered per steradian; its integral over the sphere is 1. |g| < 1. `cosine` comes first here, as in every
/// phase function of this program: both are numbers from -1 to 1, and no compiler sees them change places.
double henyey_greenstein(double cosine, double g);

/// Share scattered by less than the given angle, in [0, 1].
double share_in_cone(double g, double cosine_of_half_angle);

/// The cosine below which a share `uniform` in [0, 1] lies: sampling by the inverse of the distribution.
double sample_cosine(double g, double uniform);

/// The direction of travel after scattering: at an angle to `direction` (unit, of travel before) drawn by
/// `sample_cosine`, with a uniform azimuth. `u` and `v` are uniform in [0, 1).
glm::dvec3 sample_henyey_greenstein(const glm::dvec3& direction, double g, double u, double v);

}  // namespace bruma::reference
