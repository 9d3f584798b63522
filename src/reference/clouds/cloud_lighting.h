#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>

#include "scene/clouds/cloud_optics.h"

/// Light that clouds scatter towards the eye, in two models on one field. physical: radiative transfer with the octaves
/// of Wrenninge 2013 and Hillaire 2016. artistic: the look of Alaminos 2020, chapter 4, repaired; no phase function and
/// no conservation of energy.
namespace bruma::reference {

/// Length that a segment of constant extinction counts for: (1 - exp(-sigma ds)) / sigma, without division by 0 and, in
/// float, within 1.6e-6 (Hillaire 2015, "Physically Based and Unified Volumetric Rendering in Frostbite").
template <class Real>
Real segment_weight(Real extinction_per_m, Real length_m) {
    const Real x = extinction_per_m * length_m;
    if (x < Real(0.02)) {
        return length_m * (Real(1) - x * (Real(0.5) - x * (Real(1) / Real(6) - x / Real(24))));
    }
    return (Real(1) - std::exp(-x)) / extinction_per_m;
}

// Artistic. `x` is absorption times the optical depth to the sun in reference lengths.

/// Equation 4.20 with the cosine that was meant: 0 at mu <= 0, whatever the exponent.
double silver_rim(double mu, const scene::CloudOptics& optics);
/// Equation 4.21: the larger of lobe and rim towards the sun, blended with the other lobe.
double in_out_scatter(double mu, const scene::CloudOptics& optics);
/// Equation 4.22, attenuation with dark edges; away_from_sun leaves the edges bright when looking at the sun.
double powdered_attenuation(double mu, double x, const scene::CloudOptics& optics);
/// Equation 4.23.
inline double artistic_scatter(double mu, double x, const scene::CloudOptics& optics) {
    return powdered_attenuation(mu, x, optics) * in_out_scatter(mu, optics);
}

// Physical.

/// sum of a^n exp(-b^n tau) p(mu; c^n), in 1/sr: multiple scattering as single scattering in ever thinner and more
/// diffuse matter. Needs a <= b, else thick clouds shine by themselves.
double scattering_octaves(double mu, double sun_optical_depth, const scene::CloudOptics& optics);

/// Optical depths from a point towards the sun, straight up and straight down.
struct CloudDepths {
    double sun = 0.0, up = 0.0, down = 0.0;
};

/// Light of the sun that was scattered before, in 1/sr per albedo of the last scattering. In depths scaled by 1 - g it
/// leaks out of both sides of a cloud as light does that diffuses (van de Hulst 1980, "Multiple Light Scattering"),
/// over the lit end of the sun's ray and the lower end of the plumb line; a wider lobe follows the sun's own ray.
/// `sun_climb`: sine of its elevation. The six constants are fitted to random paths from 496 points of cumulus,
/// stratocumulus, stratus and cumulonimbus under suns of 8 to 88 degrees and mean g of 0.3 to 0.75; at 277 other
/// points, altocumulus among them, the mean of all light of a genus is within 12 %.
double scattered_again(double mu, double sun_climb, const CloudDepths& depths, const scene::CloudOptics& optics);

/// Share of the sun's light that reaches level ground below clouds, what they scatter down included, where the optical
/// depth towards the sun (sine of its elevation) is this: Eddington's approximation for a level layer over black ground
/// (Shettle and Weinman 1970), which knows no light that comes in from beside. Of matter that absorbs nothing.
double light_on_ground_below_clouds(double sun_depth, double sun_climb, const scene::CloudOptics& optics);

/// Share of a random walk's ends above the cloud, from the same points.
double share_from_above(const CloudDepths& depths, const scene::CloudOptics& optics);

/// Light on clouds. Irradiances are of a plane that faces the sun, in the unit of the picture.
struct CloudLight {
    glm::dvec3 to_sun_world{0.0, 1.0, 0.0};  ///< unit vector
    /// Irradiance of the sun behind the atmosphere, over the altitude in metres.
    std::function<glm::dvec3(double)> sun_irradiance = [](double) { return glm::dvec3(1.0); };
    /// Radiance of the sky, over the direction it is seen in.
    std::function<glm::dvec3(const glm::dvec3&)> sky_radiance = [](const glm::dvec3&) { return glm::dvec3(0.0); };
    glm::dvec3 sky_scalar_irradiance{0.0};  ///< radiance of the sky over all directions, without cosine
    glm::dvec3 sky_planar_irradiance{0.0};  ///< on the ground, with cosine
    glm::dvec3 ground_albedo{0.0};
    glm::dvec3 sky_top{0.0}, sky_bottom{0.0};  ///< artistic: radiance of the ambient light above and below the layer

    void set_uniform_sky(const glm::dvec3& radiance);
};

/// Isotropic source radiance (per extinction and albedo 1) of sky and ground light: the sky dimmed by the optical depth
/// above, the ground, lit without clouds, by the one below.
glm::dvec3 ambient_source(const CloudLight& light, const glm::dvec3& up_world, double optical_depth_up,
                          double optical_depth_down);

/// The same for light that diffuses: what does not come from above comes from the ground, which lies in the shade of
/// the cloud itself.
glm::dvec3 diffused_ambient_source(const CloudLight& light, const glm::dvec3& up_world, const CloudDepths& depths,
                                   const scene::CloudOptics& optics);

// Samples towards the sun.

/// Six unit vectors (the last one 0) that spread the cone: fixed numbers, the same everywhere.
const std::array<glm::dvec3, 6>& cone_kernel();

struct ConeSample {
    double distance_m = 0.0;  ///< along the direction to the sun, middle of its segment
    double length_m = 0.0;    ///< of the segment it stands for
    glm::dvec3 offset_world;  ///< to add to the point on the sun's line; grows with the distance
};
/// Segments that grow towards the sun and tile [0, exit] or the reach of the cone, whichever is shorter. `thickness_m`
/// is that of the layer, `exit_m` the distance to where the sun's ray leaves it.
std::array<ConeSample, 6> cone_samples(const scene::CloudOptics& optics, double thickness_m, double exit_m);

}  // namespace bruma::reference
