#include "reference/sky/sky_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/planet_spheres.h"

namespace bruma::reference {
namespace {

/// (1 - exp(-sigma ds)) / sigma, for each channel.
glm::dvec3 segment_weight(const glm::dvec3& extinction, double length) {
    glm::dvec3 weight;
    for (int channel = 0; channel < 3; ++channel) {
        const double x = extinction[channel] * length;
        weight[channel] = x > 0.0 ? -std::expm1(-x) / x * length : length;
    }
    return weight;
}

double air_altitude(const scene::Atmosphere& atmosphere, const glm::dvec3& from_sea_level) {
    return std::clamp(altitude_above(atmosphere.planet_radius_m, from_sea_level), 0.0, atmosphere.height_m);
}

glm::dvec3 up_at(const scene::Atmosphere& atmosphere, const glm::dvec3& from_sea_level) {
    return glm::normalize(from_sea_level + glm::dvec3(0.0, atmosphere.planet_radius_m, 0.0));
}

/// Cosine of the angle between the horizontal parts of two directions; 1 where either has none.
double azimuth_cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = std::hypot(a.x, a.z) * std::hypot(b.x, b.z);
    return std::hypot(a.x, a.z) < 1e-6 || std::hypot(b.x, b.z) < 1e-6
               ? 1.0
               : std::clamp((a.x * b.x + a.z * b.z) / lengths, -1.0, 1.0);
}

template <class ValueOf>
void fill(SkyTable& table, const ValueOf& value_of) {
    tbb::parallel_for(0, table.height(), [&](int y) {
        for (int x = 0; x < table.width(); ++x) {
            table.at(x, y) = value_of(table.coordinates(x, y));
        }
    });
}

}  // namespace

glm::dvec3 SkyTable::sample(glm::dvec2 coordinates) const {
    const glm::dvec2 at = glm::clamp(coordinates, 0.0, 1.0) * glm::dvec2(double(width_ - 1), double(height_ - 1));
    const int x = std::min(int(at.x), width_ - 2), y = std::min(int(at.y), height_ - 2);
    const glm::dvec2 share = at - glm::dvec2(x, y);
    return glm::mix(glm::mix(this->at(x, y), this->at(x + 1, y), share.x),
                    glm::mix(this->at(x, y + 1), this->at(x + 1, y + 1), share.x), share.y);
}

AtmosphereTables::AtmosphereTables(const scene::Atmosphere& atmosphere, const SkyTableOptions& options)
    : atmosphere_(atmosphere),
      transmittance_(options.transmittance_size.x, options.transmittance_size.y),
      multiple_(options.multiple_size.x, options.multiple_size.y),
      with_multiple_(options.multiple_scattering) {
    fill(transmittance_, [&](glm::dvec2 coordinates) {
        const TransmittancePlace place = transmittance_place(atmosphere_, coordinates);
        return transmittance_to_top(atmosphere_, place.altitude_m, place.climb, options.transmittance_steps);
    });
    if (with_multiple_) {
        fill(multiple_, [&](glm::dvec2 coordinates) {
            return multiple_at(coordinates.y * atmosphere_.height_m, 2.0 * coordinates.x - 1.0, options);
        });
    }
}

glm::dvec3 AtmosphereTables::transmittance(double altitude_m, double climb) const {
    return transmittance_.sample(transmittance_coordinates(atmosphere_, {altitude_m, climb}));
}

glm::dvec3 AtmosphereTables::sun_transmittance(double altitude_m, double sun_climb) const {
    // The table has no rays below the horizon and would answer with the horizon's own.
    const double share = sun_disc_above_horizon(atmosphere_, altitude_m, sun_climb);
    return share > 0.0 ? share * transmittance(altitude_m, std::max(sun_climb, horizon_climb(atmosphere_, altitude_m)))
                       : glm::dvec3(0.0);
}

glm::dvec3 AtmosphereTables::multiple_scattering(double altitude_m, double sun_climb) const {
    return with_multiple_ ? multiple_.sample({0.5 * sun_climb + 0.5, altitude_m / atmosphere_.height_m})
                          : glm::dvec3(0.0);
}

AirLight AtmosphereTables::air_light(double altitude_m, const glm::dvec3& direction_local,
                                     const glm::dvec3& to_sun_local, double length_m, int steps) const {
    const double mu = glm::dot(direction_local, to_sun_local);
    const double rayleigh = rayleigh_phase(mu), mie = mie_phase(mu, atmosphere_.mie_g);
    const double step = length_m / steps;
    AirLight light;
    for (int n = 0; n < steps; ++n) {
        const glm::dvec3 at = glm::dvec3(0.0, altitude_m, 0.0) + (n + 0.5) * step * direction_local;
        const double altitude = air_altitude(atmosphere_, at);
        const double sun_climb = glm::dot(up_at(atmosphere_, at), to_sun_local);
        const AirPoint air = air_at(atmosphere_, altitude);
        const glm::dvec3 source =
            (air.rayleigh * rayleigh + glm::dvec3(air.mie * mie)) * sun_transmittance(altitude, sun_climb) +
            air.scattering() * multiple_scattering(altitude, sun_climb);
        light.radiance += light.transmittance * source * segment_weight(air.extinction, step);
        light.transmittance *= glm::exp(-step * air.extinction);
    }
    return light;
}

AtmosphereTables::Bounce AtmosphereTables::isotropic_bounce(double altitude_m, const glm::dvec3& direction,
                                                            double sun_climb, int steps) const {
    const glm::dvec3 to_sun(0.0, sun_climb, std::sqrt(std::max(0.0, 1.0 - sun_climb * sun_climb)));
    const double length = distance_to_end(atmosphere_, altitude_m, direction.y);
    const double step = length / steps;
    Bounce bounce;
    glm::dvec3 passed(1.0);
    for (int n = 0; n < steps; ++n) {
        const glm::dvec3 at = glm::dvec3(0.0, altitude_m, 0.0) + (n + 0.5) * step * direction;
        const double altitude = air_altitude(atmosphere_, at);
        const AirPoint air = air_at(atmosphere_, altitude);
        const glm::dvec3 scattered = passed * air.scattering() * segment_weight(air.extinction, step);
        const glm::dvec3 sun = sun_transmittance(altitude, glm::dot(up_at(atmosphere_, at), to_sun));
        bounce.radiance += scattered * sun * (0.25 * std::numbers::inv_pi);
        bounce.scattered_share += scattered;
        passed *= glm::exp(-step * air.extinction);
    }
    const auto ground = sphere_hits(atmosphere_.planet_radius_m, altitude_m, direction.y, 0.0);
    if (ground.hit && direction.y < 0.0) {
        const glm::dvec3 up = up_at(atmosphere_, glm::dvec3(0.0, altitude_m, 0.0) + length * direction);
        const double climb = glm::dot(up, to_sun);
        bounce.radiance += passed * sun_transmittance(0.0, climb) * std::max(0.0, climb) * atmosphere_.ground_albedo *
                           std::numbers::inv_pi;
    }
    return bounce;
}

glm::dvec3 AtmosphereTables::multiple_at(double altitude_m, double sun_climb, const SkyTableOptions& options) const {
    const int edge = options.multiple_directions;
    Bounce mean;
    for (int i = 0; i < edge; ++i) {
        for (int j = 0; j < edge; ++j) {
            const double climb = 1.0 - 2.0 * (i + 0.5) / edge;
            const double azimuth = 2.0 * std::numbers::pi * (j + 0.5) / edge;
            const double level = std::sqrt(1.0 - climb * climb);
            const Bounce bounce =
                isotropic_bounce(altitude_m, {level * std::cos(azimuth), climb, level * std::sin(azimuth)}, sun_climb,
                                 options.multiple_steps);
            mean.radiance += bounce.radiance / double(edge * edge);
            mean.scattered_share += bounce.scattered_share / double(edge * edge);
        }
    }
    // All further orders are a geometric series of the share that is scattered again.
    return mean.radiance / (1.0 - glm::min(mean.scattered_share, 0.999));
}

SkyView::SkyView(const AtmosphereTables& tables, double altitude_m, const glm::dvec3& to_sun_local, glm::ivec2 size,
                 int steps)
    : atmosphere_(tables.atmosphere()),
      altitude_m_(std::max(altitude_m, 1.0)),
      to_sun_(to_sun_local),
      table_(size.x, size.y) {
    // A frame in which the sun stands in the plane of x and y.
    const glm::dvec3 to_sun(std::hypot(to_sun_.x, to_sun_.z), to_sun_.y, 0.0);
    fill(table_, [&](glm::dvec2 coordinates) {
        const SkyViewPlace place = sky_view_place(atmosphere_, altitude_m_, coordinates);
        const double level = std::sin(place.zenith_angle);
        const double azimuth_sine = std::sqrt(std::max(0.0, 1.0 - place.azimuth_cosine * place.azimuth_cosine));
        const glm::dvec3 direction(level * place.azimuth_cosine, std::cos(place.zenith_angle), level * azimuth_sine);
        const double length = coordinates.y > 0.5 ? distance_to_end(atmosphere_, altitude_m_, direction.y)
                                                  : distance_to_top(atmosphere_, altitude_m_, direction.y);
        return tables.air_light(altitude_m_, direction, to_sun, length, steps).radiance;
    });
}

glm::dvec3 SkyView::radiance(const glm::dvec3& direction_local) const {
    const bool toward_ground = direction_local.y < horizon_climb(atmosphere_, altitude_m_);
    const SkyViewPlace place{std::acos(std::clamp(direction_local.y, -1.0, 1.0)),
                             azimuth_cosine(direction_local, to_sun_)};
    glm::dvec2 coordinates = sky_view_coordinates(atmosphere_, altitude_m_, place, toward_ground);
    // Rows are never blended over the horizon: the last of the sky and the first of the ground keep to themselves.
    const double rows = table_.height() - 1;
    const double last_of_sky = std::floor(0.5 * rows) / rows, first_of_ground = (std::floor(0.5 * rows) + 1.0) / rows;
    coordinates.y = toward_ground ? std::max(coordinates.y, first_of_ground) : std::min(coordinates.y, last_of_sky);
    return table_.sample(coordinates);
}

SkyIrradiance sky_irradiance(const std::function<glm::dvec3(const glm::dvec3& direction)>& radiance) {
    // Midpoints in the zenith angle and azimuth; skies without a disc have no finer structure.
    constexpr int rings = 90, sectors = 180;
    SkyIrradiance sum;
    for (int i = 0; i < rings; ++i) {
        const double zenith = 0.5 * std::numbers::pi * (i + 0.5) / rings;
        for (int j = 0; j < sectors; ++j) {
            const double azimuth = 2.0 * std::numbers::pi * (j + 0.5) / sectors;
            const glm::dvec3 direction(std::sin(zenith) * std::cos(azimuth), std::cos(zenith),
                                       std::sin(zenith) * std::sin(azimuth));
            const glm::dvec3 light = radiance(direction) * std::sin(zenith);
            sum.scalar += light;
            sum.planar += light * std::cos(zenith);
        }
    }
    constexpr double share = (0.5 * std::numbers::pi / rings) * (2.0 * std::numbers::pi / sectors);
    return {share * sum.planar, share * sum.scalar};
}

SkyIrradiance SkyView::irradiance() const {
    return sky_irradiance([this](const glm::dvec3& direction) { return radiance(direction); });
}

}  // namespace bruma::reference
