#include "scene/clouds/cloud_layer.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace bruma::scene {

glm::dvec3 wind_direction_world(const CloudLayer& layer) {
    const double azimuth = layer.wind_azimuth_deg * std::numbers::pi / 180.0;
    return {std::sin(azimuth), 0.0, -std::cos(azimuth)};
}

void check(const CloudLayer& layer, std::string_view name) {
    if (!(layer.top_m > layer.bottom_m)) {
        throw InputError(fmt::format("{}: the top of the layer is at {} m and its bottom at {} m; set top above bottom",
                                     name, layer.top_m, layer.bottom_m));
    }
}

}  // namespace bruma::scene
