#include "render/clouds/cloud_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::render {
namespace {

constexpr int edge = CloudCells::edge;
constexpr int slices = CloudCells::slices;

/// Largest value of each channel that bilinear lookups inside a cell can give.
std::array<double, 4> most_in_cell(const scene::WeatherMap& map, int cx, int cz) {
    const auto first = [](int cell, int size) { return int(std::floor(double(cell) * size / edge - 0.5)); };
    const auto last = [](int cell, int size) { return int(std::ceil(double(cell + 1) * size / edge - 0.5)); };
    std::array<std::uint8_t, 4> most{};
    // No more texels than there are: a coarse map has many cells to a texel, a fine one many texels to a cell.
    const int x_first = first(cx, map.width);
    const int z_first = first(cz, map.height);
    const int x_last = std::min(last(cx, map.width), x_first + map.width - 1);
    const int z_last = std::min(last(cz, map.height), z_first + map.height - 1);
    for (int z = z_first; z <= z_last; ++z) {
        const int row = (z + map.height) % map.height;
        for (int x = x_first; x <= x_last; ++x) {
            const std::uint8_t* texel = &map.rgba[4 * (std::size_t(row) * map.width + (x + map.width) % map.width)];
            for (std::size_t k = 0; k < 4; ++k) {
                most[k] = std::max(most[k], texel[k]);
            }
        }
    }
    return {most[0] / 255.0, most[1] / 255.0, most[2] / 255.0, most[3] / 255.0};
}

/// Distances by two sweeps over the 26 neighbours, twice, so that they pass the seams of the tile.
void spread_distance(std::vector<std::uint8_t>& distance) {
    const auto at = [&](int x, int z, int y) -> std::uint8_t& {
        return distance[(std::size_t(y) * edge + ((z + edge) % edge)) * edge + ((x + edge) % edge)];
    };
    for (const int way : {1, -1, 1, -1}) {
        for (int yy = 0; yy < slices; ++yy) {
            const int y = way > 0 ? yy : slices - 1 - yy;
            for (int zz = 0; zz < edge; ++zz) {
                const int z = way > 0 ? zz : edge - 1 - zz;
                for (int xx = 0; xx < edge; ++xx) {
                    const int x = way > 0 ? xx : edge - 1 - xx;
                    int nearest = at(x, z, y);
                    if (nearest == 0) {
                        continue;
                    }
                    // The 13 neighbours that this sweep has visited already, those beyond the seam excepted.
                    for (int n = 0; n < 13; ++n) {
                        const int py = y - way * (1 - n / 9);
                        if (py < 0 || py >= slices) {
                            continue;
                        }
                        const int px = x - way * (1 - n % 3);
                        const int pz = z - way * (1 - n / 3 % 3);
                        nearest = std::min(nearest, at(px, pz, py) + 1);
                    }
                    at(x, z, y) = std::uint8_t(std::min(nearest, 255));
                }
            }
        }
    }
}

}  // namespace

CloudCells make_cloud_cells(const scene::CloudLayer& layer, const scene::WeatherMap& map) {
    const scene::CloudBand band = scene::cloud_band(layer, map.largest());
    const double thickness = layer.top_m - layer.bottom_m;
    const auto share = [&](int slice) {
        return (band.low_m + (band.high_m - band.low_m) * slice / slices - layer.bottom_m) / thickness;
    };
    // Weather is filtered in single precision, or in 16 bits.
    constexpr double rounding = 1e-3;
    CloudCells cells;
    cells.distance.assign(std::size_t(edge) * edge * slices, 255);
    if (band.high_m <= band.low_m) {
        return cells;
    }
    tbb::parallel_for(0, edge, [&](int cz) {
        for (int cx = 0; cx < edge; ++cx) {
            const std::array<double, 4> most = most_in_cell(map, cx, cz);
            const double coverage = scene::largest_coverage(layer, {most[0], most[1], most[2], most[3]}) + rounding;
            const double top = most[2] + rounding;
            if (most[3] == 0.0 || top < 1.0 / 255.0) {
                continue;
            }
            for (int slice = 0; slice < slices; ++slice) {
                // The shape of height is a rise times a fall: the one at the slice's top, the other at its bottom.
                const double rise = std::clamp(share(slice + 1) / 0.07, 0.0, 1.0);
                const double fall = 1.0 - std::clamp((share(slice) - 0.2 * top) / (0.8 * top), 0.0, 1.0);
                if (rise * fall + rounding > 1.0 - coverage) {
                    cells.distance[(std::size_t(slice) * edge + std::size_t(cz)) * edge + std::size_t(cx)] = 0;
                }
            }
        }
    });
    const auto occupied = std::count(cells.distance.begin(), cells.distance.end(), std::uint8_t(0));
    cells.occupied_share = double(occupied) / double(cells.distance.size());
    if (occupied > 0) {
        spread_distance(cells.distance);
    }
    return cells;
}

}  // namespace bruma::render
