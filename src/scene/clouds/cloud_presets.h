#pragma once
#include <memory>
#include <span>
#include <string_view>

#include "scene/clouds/cloud_layer.h"
#include "scene/clouds/cloud_optics.h"
#include "scene/clouds/cloud_weather.h"

namespace bruma::scene {

/// One layer of clouds with its light and weather.
struct Cloud {
    CloudLayer layer;
    CloudOptics optics;
    CloudWeatherSource weather;
    std::shared_ptr<const WeatherMap> map;  ///< of `weather`; null until someone made or read it
};

/// A genus of clouds. Coverage, density and lighting of cumulus, stratocumulus and stratus are those of Alaminos 2020,
/// chapter 6, whose altitudes and maps are not printed; the others are ours.
enum class CloudType { cumulus, stratocumulus, stratus, altocumulus, cirrus, cumulonimbus };
template <>
inline std::span<const std::string_view> enum_words<CloudType>() {
    static constexpr std::array<std::string_view, 6> words{"cumulus",     "stratocumulus", "stratus",
                                                           "altocumulus", "cirrus",        "cumulonimbus"};
    return words;
}

/// The layer of a genus; its map is left to `make_weather_map`.
Cloud cloud_preset(CloudType type);

}  // namespace bruma::scene
