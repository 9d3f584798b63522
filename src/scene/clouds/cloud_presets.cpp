#include "scene/clouds/cloud_presets.h"

namespace bruma::scene {

// Edges of weather maps are multiples of those of the noise, so that the whole pattern repeats with the map.
Cloud cloud_preset(CloudType type) {
    Cloud cloud;
    switch (type) {
        case CloudType::cumulus:
            break;  // the defaults of every struct
        case CloudType::stratocumulus:
            cloud.layer.coverage = 0.8;
            cloud.layer.density = 0.5;
            break;
        case CloudType::stratus:
            cloud.layer.bottom_m = 500.0;
            cloud.layer.top_m = 1200.0;
            cloud.layer.coverage = 1.0;
            cloud.layer.density = 0.2;
            cloud.layer.shape_tile_m = 6000.0;
            cloud.layer.weather_tile_m = 36000.0;
            cloud.layer.wind_speed_m_s = 5.0;
            cloud.weather.pattern = WeatherPattern::overcast;
            break;
        case CloudType::altocumulus:
            cloud.layer.bottom_m = 4500.0;
            cloud.layer.top_m = 5300.0;
            cloud.layer.coverage = 0.45;
            cloud.layer.density = 0.4;
            cloud.layer.density_follows_top = true;
            cloud.layer.shape_tile_m = 6000.0;
            cloud.layer.detail_tile_m = 600.0;
            cloud.layer.weather_tile_m = 12000.0;
            cloud.layer.skew_m = 100.0;
            cloud.layer.wind_speed_m_s = 15.0;
            cloud.weather.pattern = WeatherPattern::ripples;
            cloud.optics.extinction_per_m = 0.03;
            break;
        case CloudType::cirrus:
            cloud.layer.bottom_m = 8500.0;
            cloud.layer.top_m = 10000.0;
            cloud.layer.coverage = 0.5;
            cloud.layer.density = 1.0;
            cloud.layer.density_follows_top = true;
            cloud.layer.shape_tile_m = 10000.0;
            cloud.layer.detail_tile_m = 1000.0;
            cloud.layer.weather_tile_m = 60000.0;
            cloud.layer.skew_m = 3000.0;  // ice falls out of the faster air above
            cloud.layer.wind_speed_m_s = 40.0;
            cloud.weather.pattern = WeatherPattern::wisps;
            cloud.optics.extinction_per_m = 8e-4;
            break;
        case CloudType::cumulonimbus:
            cloud.layer.bottom_m = 800.0;
            cloud.layer.top_m = 12000.0;
            cloud.layer.coverage = 0.6;
            cloud.layer.density_follows_top = true;
            cloud.layer.shape_tile_m = 10000.0;
            cloud.layer.detail_tile_m = 1000.0;
            cloud.layer.weather_tile_m = 60000.0;
            cloud.layer.skew_m = 1500.0;
            cloud.weather.pattern = WeatherPattern::towers;
            cloud.optics.extinction_per_m = 0.08;
            cloud.optics.albedo = 0.998;
            break;
    }
    return cloud;
}

}  // namespace bruma::scene
