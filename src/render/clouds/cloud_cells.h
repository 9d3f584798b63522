#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/clouds/clouds.h"

namespace bruma::render {

/// Where a layer can hold cloud, judged by its weather map alone: cells of one tile of the map, x, z, and slices
/// between the altitudes of `scene::cloud_band`. Conservative: a cell that says empty is empty whatever the noise.
struct CloudCells {
    static constexpr int edge = 256;
    static constexpr int slices = 32;
    std::vector<std::uint8_t> distance;  ///< Chebyshev, to the nearest cell with cloud; x fastest, then z, then height
    double occupied_share = 0.0;
};
CloudCells make_cloud_cells(const scene::CloudLayer& layer, const scene::WeatherMap& map);

}  // namespace bruma::render
