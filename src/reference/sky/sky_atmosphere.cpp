#include "reference/sky/sky_atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/interpolation.h"
#include "reference/planet_spheres.h"

namespace bruma::reference {
namespace {

/// From this altitude up the horizon has an angle of its own.
constexpr double least_altitude_m = 1.0;

/// Length of the tangent from an altitude to the ground: sqrt(r^2 - R^2) without cancellation.
double tangent_m(double planet_radius_m, double altitude_m) {
    return std::sqrt(std::max(0.0, altitude_m * (2.0 * planet_radius_m + altitude_m)));
}

/// Angle between straight down and the horizon.
double horizon_nadir_angle(const scene::Atmosphere& atmosphere, double altitude_m) {
    const double altitude = std::max(altitude_m, least_altitude_m);
    return std::atan2(atmosphere.planet_radius_m, tangent_m(atmosphere.planet_radius_m, altitude));
}

}  // namespace

AirPoint air_at(const scene::Atmosphere& atmosphere, double altitude_m) {
    const double air = std::exp(-altitude_m / atmosphere.rayleigh_scale_height_m);
    const double haze = std::exp(-altitude_m / atmosphere.mie_scale_height_m);
    const double ozone =
        std::max(0.0, 1.0 - std::abs(altitude_m - atmosphere.ozone_altitude_m) / atmosphere.ozone_half_width_m);
    AirPoint point;
    point.rayleigh = atmosphere.rayleigh_scattering_per_m * air;
    point.mie = atmosphere.mie_scattering_per_m * haze;
    point.extinction = point.rayleigh + glm::dvec3(point.mie + atmosphere.mie_absorption_per_m * haze) +
                       atmosphere.ozone_absorption_per_m * ozone;
    return point;
}

double rayleigh_phase(double mu) {
    return 3.0 / (16.0 * std::numbers::pi) * (1.0 + mu * mu);
}

double mie_phase(double mu, double g) {
    const double base = 1.0 + g * g - 2.0 * g * mu;
    return 3.0 / (8.0 * std::numbers::pi) * (1.0 - g * g) * (1.0 + mu * mu) / ((2.0 + g * g) * base * std::sqrt(base));
}

double distance_to_top(const scene::Atmosphere& atmosphere, double altitude_m, double climb) {
    return std::max(0.0, sphere_hits(atmosphere.planet_radius_m, altitude_m, climb, atmosphere.height_m).far);
}

double distance_to_end(const scene::Atmosphere& atmosphere, double altitude_m, double climb) {
    const auto ground = sphere_hits(atmosphere.planet_radius_m, altitude_m, climb, 0.0);
    return ground.hit && climb < 0.0 ? std::max(0.0, ground.near) : distance_to_top(atmosphere, altitude_m, climb);
}

double horizon_climb(const scene::Atmosphere& atmosphere, double altitude_m) {
    return -tangent_m(atmosphere.planet_radius_m, altitude_m) / (atmosphere.planet_radius_m + altitude_m);
}

glm::dvec3 transmittance_to_top(const scene::Atmosphere& atmosphere, double altitude_m, double climb, int steps) {
    const double step = distance_to_top(atmosphere, altitude_m, climb) / steps;
    const double level = std::sqrt(std::max(0.0, 1.0 - climb * climb));
    glm::dvec3 optical_depth(0.0);
    for (int n = 0; n < steps; ++n) {
        const double t = (n + 0.5) * step;
        const double altitude =
            altitude_above<double>(atmosphere.planet_radius_m, {t * level, altitude_m + t * climb, 0.0});
        optical_depth += air_at(atmosphere, std::max(0.0, altitude)).extinction;
    }
    return glm::exp(-step * optical_depth);
}

double sun_disc_above_horizon(const scene::Atmosphere& atmosphere, double altitude_m, double sun_climb,
                              double angular_radius_rad) {
    const double horizon = horizon_climb(atmosphere, altitude_m);
    // d(cos) = sin(zenith angle) d(angle), and the sine at the horizon is R / r.
    const double half = angular_radius_rad * atmosphere.planet_radius_m / (atmosphere.planet_radius_m + altitude_m);
    return smoothstep(horizon - half, horizon + half, sun_climb);
}

glm::dvec2 transmittance_coordinates(const scene::Atmosphere& atmosphere, TransmittancePlace place) {
    const double radius = atmosphere.planet_radius_m + place.altitude_m;
    const double longest = tangent_m(atmosphere.planet_radius_m, atmosphere.height_m);
    const double tangent = tangent_m(atmosphere.planet_radius_m, place.altitude_m);
    const double nearest = atmosphere.height_m - place.altitude_m;
    const double top = atmosphere.planet_radius_m + atmosphere.height_m;
    const double d = -radius * place.climb +
                     std::sqrt(std::max(0.0, radius * radius * (place.climb * place.climb - 1.0) + top * top));
    const double span = tangent + longest - nearest;
    return {span > 0.0 ? std::clamp((d - nearest) / span, 0.0, 1.0) : 0.0, std::clamp(tangent / longest, 0.0, 1.0)};
}

TransmittancePlace transmittance_place(const scene::Atmosphere& atmosphere, glm::dvec2 coordinates) {
    const double longest = tangent_m(atmosphere.planet_radius_m, atmosphere.height_m);
    const double tangent = coordinates.y * longest;
    const double planet = atmosphere.planet_radius_m;
    const double altitude = tangent * tangent / (std::sqrt(tangent * tangent + planet * planet) + planet);
    const double nearest = atmosphere.height_m - altitude;
    const double d = nearest + coordinates.x * (tangent + longest - nearest);
    const double radius = planet + altitude;
    const double climb =
        d == 0.0 ? 1.0 : std::clamp((longest * longest - tangent * tangent - d * d) / (2.0 * radius * d), -1.0, 1.0);
    return {altitude, climb};
}

glm::dvec2 sky_view_coordinates(const scene::Atmosphere& atmosphere, double altitude_m, SkyViewPlace place,
                                bool toward_ground) {
    const double nadir = horizon_nadir_angle(atmosphere, altitude_m);
    const double horizon = std::numbers::pi - nadir;
    const double v = toward_ground ? 0.5 + 0.5 * std::sqrt(std::clamp((place.zenith_angle - horizon) / nadir, 0.0, 1.0))
                                   : 0.5 * (1.0 - std::sqrt(std::clamp(1.0 - place.zenith_angle / horizon, 0.0, 1.0)));
    return {std::sqrt(std::clamp(0.5 - 0.5 * place.azimuth_cosine, 0.0, 1.0)), v};
}

SkyViewPlace sky_view_place(const scene::Atmosphere& atmosphere, double altitude_m, glm::dvec2 coordinates) {
    const double nadir = horizon_nadir_angle(atmosphere, altitude_m);
    const double horizon = std::numbers::pi - nadir;
    const double w = 1.0 - 2.0 * coordinates.y;
    const double zenith = w > 0.0 ? horizon * (1.0 - w * w) : horizon + nadir * w * w;
    return {zenith, 1.0 - 2.0 * coordinates.x * coordinates.x};
}

glm::dvec3 sun_disc_radiance(double angle_rad, double angular_radius_rad, bool limb_darkening) {
    const double share = angle_rad / angular_radius_rad;
    if (share >= 1.0) {
        return glm::dvec3(0.0);
    }
    const double half_sine = std::sin(0.5 * angular_radius_rad);
    const double solid_angle = 4.0 * std::numbers::pi * half_sine * half_sine;
    glm::dvec3 limb(1.0);
    if (limb_darkening) {
        const glm::dvec3 exponent(0.397, 0.503, 0.652);
        // The mean of m^a over the disc is 2 / (2 + a).
        limb = glm::pow(glm::dvec3(std::sqrt(1.0 - share * share)), exponent) * (2.0 + exponent) / 2.0;
    }
    return limb / solid_angle;
}

}  // namespace bruma::reference
