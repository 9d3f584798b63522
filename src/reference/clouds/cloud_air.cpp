#include "reference/clouds/cloud_air.h"

#include <algorithm>
#include <cmath>

#include "reference/clouds/cloud_intervals.h"

namespace bruma::reference {

AirAlongRay::AirAlongRay(const AtmosphereTables& tables, const glm::dvec3& from_sea_level, const glm::dvec3& direction,
                         const glm::dvec3& to_sun, double longest_m, int steps, const SunShare& sun_share)
    : longest_m_(longest_m) {
    const scene::Atmosphere& atmosphere = tables.atmosphere();
    const glm::dvec3 center(0.0, -atmosphere.planet_radius_m, 0.0);
    const double mu = glm::dot(direction, to_sun);
    const double rayleigh = rayleigh_phase(mu), mie = mie_phase(mu, atmosphere.mie_g);
    ends_.reserve(std::size_t(steps) + 1);
    ends_.emplace_back();
    for (int n = 0; n < steps; ++n) {
        const double low = longest_m * n * n / (double(steps) * steps);
        const double high = longest_m * (n + 1.0) * (n + 1.0) / (double(steps) * steps);
        const glm::dvec3 at = from_sea_level + 0.5 * (low + high) * direction;
        const double altitude = altitude_above(atmosphere.planet_radius_m, at);
        AirLight light = ends_.back();
        if (altitude <= atmosphere.height_m) {
            const AirPoint air = air_at(atmosphere, std::max(0.0, altitude));
            const double sun_climb = glm::dot(glm::normalize(at - center), to_sun);
            const double share = sun_share ? sun_share(at) : 1.0;
            const glm::dvec3 source = (air.rayleigh * rayleigh + glm::dvec3(air.mie * mie)) * share *
                                          tables.sun_transmittance(std::max(0.0, altitude), sun_climb) +
                                      air.scattering() * tables.multiple_scattering(std::max(0.0, altitude), sun_climb);
            const glm::dvec3 passed = glm::exp(-(high - low) * air.extinction);
            light.radiance += light.transmittance * source * (1.0 - passed) / glm::max(air.extinction, 1e-30);
            light.transmittance *= passed;
        }
        ends_.push_back(light);
    }
}

AirLight AirAlongRay::before(double distance_m) const {
    const double at = std::sqrt(std::clamp(distance_m / longest_m_, 0.0, 1.0)) * (double(ends_.size()) - 1.0);
    const auto low = std::min(std::size_t(at), ends_.size() - 2);
    const double share = at - double(low);
    return {glm::mix(ends_[low].radiance, ends_[low + 1].radiance, share),
            glm::mix(ends_[low].transmittance, ends_[low + 1].transmittance, share)};
}

}  // namespace bruma::reference
