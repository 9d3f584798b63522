#include "reference/sky/sky_models.h"

#include <algorithm>
#include <cmath>

#include "reference/sky/sky_look.h"
#include "reference/sky/sky_preetham.h"

namespace bruma::reference {
namespace {

constexpr double solar_illuminance_klx = 127.5;
constexpr double most_turbidity = 10.0;

glm::dvec3 preetham_radiance(double turbidity, const glm::dvec3& direction, const glm::dvec3& to_sun) {
    const glm::dvec3 above = glm::normalize(glm::dvec3(direction.x, std::max(direction.y, 1e-4), direction.z));
    const glm::dvec3 sun =
        glm::normalize(glm::dvec3(to_sun.x, std::max(to_sun.y, 0.0), to_sun.z) + glm::dvec3(0.0, 1e-6, 0.0));
    const glm::dvec3 Yxy =
        preetham_Yxy(std::min(turbidity, most_turbidity), std::acos(above.y), std::acos(std::min(sun.y, 1.0)),
                     std::acos(std::clamp(glm::dot(above, sun), -1.0, 1.0)));
    return glm::max(rec709_from_Yxy(Yxy), 0.0) / solar_illuminance_klx;
}

}  // namespace

GroundSky::GroundSky(const scene::Sky& sky, const glm::dvec3& to_sun, const glm::dvec3& atmosphere_planar)
    : sky_(sky), to_sun_(to_sun) {
    irradiance_ = sky_irradiance([this](const glm::dvec3& direction) { return bare(direction); });
    const double found = std::max(scene::luminance(irradiance_.planar), 1e-30);
    const double atmosphere = scene::luminance(atmosphere_planar);
    scale_ = sky.model == scene::SkyModel::look ? atmosphere / found
                                                : std::min(1.0, (0.5 * std::max(to_sun.y, 0.0) + atmosphere) / found);
    irradiance_.planar *= scale_;
    irradiance_.scalar *= scale_;
}

glm::dvec3 GroundSky::bare(const glm::dvec3& direction) const {
    return sky_.model == scene::SkyModel::look ? look_radiance(sky_, direction, to_sun_, false)
                                               : preetham_radiance(sky_.turbidity, direction, to_sun_);
}

glm::dvec3 GroundSky::disc(const glm::dvec3& direction) const {
    return sky_.model == scene::SkyModel::look
               ? scale_ * (look_radiance(sky_, direction, to_sun_) - look_radiance(sky_, direction, to_sun_, false))
               : glm::dvec3(0.0);
}

}  // namespace bruma::reference
