#include "reference/sky/sky_look.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/interpolation.h"
#include "reference/phase_function.h"

namespace bruma::reference {
namespace {

const glm::dvec3 wavelength_m(680e-9, 550e-9, 450e-9);
const glm::dvec3 mie_per_particle(1.8399918514e14, 2.7798023920e14, 4.0790479544e14);

}  // namespace

glm::dvec3 rayleigh_coefficient(const glm::dvec3& wavelength) {
    constexpr double n = 1.0003, molecules_per_m3 = 2.545e25, depolarization = 0.035;
    const double strength = 8.0 * std::pow(std::numbers::pi, 3.0) * std::pow(n * n - 1.0, 2.0) *
                            (6.0 + 3.0 * depolarization) / (3.0 * molecules_per_m3 * (6.0 - 7.0 * depolarization));
    return strength / (wavelength * wavelength * wavelength * wavelength);
}

double look_air_mass(double zenith_deg) {
    const double cosine = std::cos(zenith_deg * std::numbers::pi / 180.0);
    return 1.0 / (cosine + 0.15 * std::pow(93.885 - zenith_deg, -1.253));
}

glm::dvec3 look_radiance(const scene::Sky& sky, const glm::dvec3& direction_world, const glm::dvec3& to_sun_world,
                         bool with_disc) {
    const glm::dvec3 air = rayleigh_coefficient(wavelength_m) * sky.look_rayleigh;
    const glm::dvec3 haze = 0.434 * (0.2 * sky.turbidity * 1e-17) * mie_per_particle * sky.look_mie;
    const double zenith_deg = std::acos(std::clamp(direction_world.y, 0.0, 1.0)) * 180.0 / std::numbers::pi;
    const glm::dvec3 extinction = glm::exp(-(air * 8400.0 + haze * 1250.0) * look_air_mass(zenith_deg));
    const double mu = glm::dot(direction_world, to_sun_world);
    const double sun_zenith = std::acos(std::clamp(to_sun_world.y, -1.0, 1.0));
    const double sun = 1000.0 * std::max(0.0, 1.0 - std::exp(-(1.61107 - sun_zenith) / 1.5));
    const double half = 0.5 * mu + 0.5;
    const double rayleigh = 3.0 / (16.0 * std::numbers::pi) * (1.0 + half * half);
    const glm::dvec3 scattered =
        sun * (air * rayleigh + haze * henyey_greenstein(mu, sky.look_mie_g)) / glm::max(air + haze, 1e-300);
    const double low_sun = std::clamp(std::pow(1.0 - to_sun_world.y, 5.0), 0.0, 1.0);
    const glm::dvec3 in_scattered = glm::pow(scattered * (1.0 - extinction), glm::dvec3(1.5)) *
                                    glm::mix(glm::dvec3(1.0), glm::sqrt(scattered * extinction), low_sun);
    constexpr double disc = 0.99995667694;
    const glm::dvec3 direct =
        0.1 * extinction +
        (with_disc ? 19000.0 * sun * extinction * smoothstep(disc, disc + 0.00002, mu) : glm::dvec3(0.0));
    // A unit vector makes the original's fade of the sun, which divides by 450000, a constant 1 to five digits.
    const double fade = 1.0 - std::clamp(1.0 - std::exp(to_sun_world.y / 450000.0), 0.0, 1.0);
    return glm::pow((in_scattered + direct) * 0.04 + glm::dvec3(0.0, 0.0003, 0.00075),
                    glm::dvec3(1.0 / (1.2 + 1.2 * fade)));
}

}  // namespace bruma::reference
