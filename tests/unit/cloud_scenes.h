#pragma once
#include <memory>

#include "reference/clouds/cloud_march.h"
#include "scene/clouds/cloud_presets.h"

/// Small clouds for the tests of march and Monte Carlo.
namespace bruma::reference {

/// A box of 1e6 m edge between two altitudes with a density of the altitude alone, up to 1.
template <class DensityOf>
CloudMedium flat_layer(double bottom_m, double top_m, double extinction_per_m, const DensityOf& density_of) {
    scene::CloudLayer layer;
    layer.bounds = scene::CloudBounds::box;
    layer.bottom_m = bottom_m;
    layer.top_m = top_m;
    layer.box_size_m = {1e6, 1e6};
    scene::CloudOptics optics;
    optics.extinction_per_m = extinction_per_m;
    optics.multiple_scattering = scene::MultipleScattering::octaves;
    optics.octaves = 1;
    optics.ambient = 0.0;
    return {CloudGeometry(layer, glm::dvec3(0.0), 6360e3),
            [density_of](const glm::dvec3& at) { return density_of(at.y); }, 1.0, optics};
}

inline CloudMedium homogeneous_layer(double bottom_m, double top_m, double extinction_per_m) {
    return flat_layer(bottom_m, top_m, extinction_per_m, [](double) { return 1.0; });
}

/// Clouds of a preset seen from one place, with noise that is ready in milliseconds.
inline CloudMedium preset_medium(scene::CloudType type, const glm::dvec3& camera_world, double time_s = 0.0) {
    static const auto noise = make_cloud_noise(scene::NoisePacking::channels, 32, 16);
    const scene::Cloud cloud = scene::cloud_preset(type);
    const auto map = scene::make_weather_map(cloud.weather.pattern, cloud.weather.variation, 64);
    return medium_of(CloudField(cloud.layer, map, noise, time_s), CloudGeometry(cloud.layer, camera_world, 6360e3),
                     cloud.optics);
}

inline scene::Ray ray_along(const glm::dvec3& origin, const glm::dvec3& direction) {
    return {origin, glm::normalize(direction), 0.0};
}

}  // namespace bruma::reference
