#include "scene/clouds/clouds.h"

#include <algorithm>

namespace bruma::scene {

Clouds preset_clouds(CloudType type) {
    const Cloud preset = cloud_preset(type);
    Clouds clouds;
    clouds.layer = preset.layer;
    clouds.optics = preset.optics;
    clouds.weather = preset.weather;
    return clouds;
}

void make_missing_map(Clouds& clouds) {
    if (clouds.weather->file.empty() && (!*clouds.map || clouds.map_from != *clouds.weather)) {
        clouds.map = make_weather_map(clouds.weather->pattern, clouds.weather->variation);
        clouds.map_from = *clouds.weather;
    }
}

double largest_coverage(const CloudLayer& layer, const CloudWeather& most) {
    if (layer.linear_coverage) {
        return layer.coverage > 0.0 && std::max(most.placement, most.placement_overcast) > 0.0 ? 1.0 : 0.0;
    }
    return layer.coverage * std::max(most.placement, most.placement_overcast);
}

CloudBand cloud_band(const CloudLayer& layer, const CloudWeather& most) {
    const double coverage = largest_coverage(layer, most);
    // Cloud needs base * shape of height > 1 - coverage with a base of at most 1; the shape of height rises linearly
    // over the lowest 0.07 and falls linearly from 0.2 to 1 top.
    const double low = 0.07 * (1.0 - coverage);
    const double high = most.top * (0.2 + 0.8 * coverage);
    const double thickness = layer.top_m - layer.bottom_m;
    if (coverage <= 1e-4 || most.top < 1.0 / 255.0 || high <= low || layer.density == 0.0) {
        return {layer.bottom_m, layer.bottom_m};
    }
    return {layer.bottom_m + low * thickness, layer.bottom_m + std::min(1.0, high) * thickness};
}

}  // namespace bruma::scene
