#pragma once
#include <memory>

#include "base/revision.h"
#include "scene/clouds/cloud_march.h"
#include "scene/clouds/cloud_presets.h"

namespace bruma::scene {

/// A layer of clouds as the content of a node. Clouds stand in the world, not in their node's space: the node's
/// transform does not move them.
struct Clouds {
    Tracked<CloudLayer> layer;
    Tracked<CloudOptics> optics;
    Tracked<CloudWeatherSource> weather;
    Tracked<CloudMarch> march;
    Tracked<std::shared_ptr<const WeatherMap>> map;  ///< null until someone made or read it
    CloudWeatherSource map_from;                     ///< what `map` was made or read from
};

/// The layer of a genus, without its map.
Clouds preset_clouds(CloudType type);
/// Makes the map by code where its source names no file.
void make_missing_map(Clouds& clouds);

/// Altitudes between which a layer can hold cloud at all, metres: its round base and the fall-off towards the highest
/// top leave less than its thickness. Nothing (low == high) for a clear sky.
struct CloudBand {
    double low_m = 0.0, high_m = 0.0;
};
CloudBand cloud_band(const CloudLayer& layer, const CloudWeather& most);

/// Largest effective coverage that a weather map with these largest values can give, in [0,1].
double largest_coverage(const CloudLayer& layer, const CloudWeather& most);

}  // namespace bruma::scene
