#include "reference/clouds/light_of_sky.h"

#include <algorithm>
#include <numbers>

#include "reference/sky/sky_models.h"

namespace bruma::reference {

CloudLight light_of_sky(std::shared_ptr<const AtmosphereTables> tables, const scene::Sun& sun, double altitude_m,
                        const scene::Sky& sky) {
    CloudLight light;
    light.to_sun_world = scene::to_sun_world(sun);
    const auto view = std::make_shared<const SkyView>(*tables, altitude_m, light.to_sun_world);
    const glm::dvec3 irradiance = sun.irradiance;
    if (sky.model == scene::SkyModel::atmosphere) {
        light.sky_radiance = [view, irradiance](const glm::dvec3& direction) {
            return irradiance * view->radiance(direction);
        };
        light.sky_scalar_irradiance = irradiance * view->scalar_irradiance();
        light.sky_planar_irradiance = irradiance * view->planar_irradiance();
    } else {
        const GroundSky model(sky, light.to_sun_world, view->planar_irradiance());
        light.sky_radiance = [model, irradiance](const glm::dvec3& direction) {
            return irradiance * model.radiance(direction);
        };
        light.sky_scalar_irradiance = irradiance * model.irradiance().scalar;
        light.sky_planar_irradiance = irradiance * model.irradiance().planar;
    }
    light.sky_top = light.sky_scalar_irradiance * (0.5 * std::numbers::inv_pi);
    light.ground_albedo = tables->atmosphere().ground_albedo;
    // What the lower side of a layer sees: the ground under sun and sky.
    const double climb = light.to_sun_world.y;
    const glm::dvec3 sun_on_ground =
        climb > 0.0 ? climb * irradiance * tables->sun_transmittance(0.0, climb) : glm::dvec3(0.0);
    light.sky_bottom = light.ground_albedo * (sun_on_ground + light.sky_planar_irradiance) * std::numbers::inv_pi;
    light.sun_irradiance = [tables = std::move(tables), irradiance, climb](double altitude) {
        return irradiance * tables->sun_transmittance(std::clamp(altitude, 0.0, tables->atmosphere().height_m), climb);
    };
    return light;
}

}  // namespace bruma::reference
