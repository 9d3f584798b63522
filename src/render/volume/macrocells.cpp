#include "render/volume/macrocells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bruma::render {
namespace {

int choose_edge(glm::ivec3 size) {
    // 4^3 voxels were the fastest on 256^3; larger volumes keep the number of cells, and with it a TF edit, bounded.
    int edge = 4;
    while (std::max({size.x, size.y, size.z}) / edge > 128) {
        edge *= 2;
    }
    return edge;
}

/// Chebyshev distance by two sweeps over the 26 neighbours; exact, since every step to a neighbour has length 1.
void spread_distance(std::vector<std::uint8_t>& distance, glm::ivec3 cells) {
    const auto at = [&](int x, int y, int z) -> std::uint8_t& {
        return distance[(std::size_t(z) * cells.y + y) * cells.x + x];
    };
    for (const int way : {-1, 1}) {
        for (int zz = 0; zz < cells.z; ++zz) {
            const int z = way < 0 ? zz : cells.z - 1 - zz;
            for (int yy = 0; yy < cells.y; ++yy) {
                const int y = way < 0 ? yy : cells.y - 1 - yy;
                for (int xx = 0; xx < cells.x; ++xx) {
                    const int x = way < 0 ? xx : cells.x - 1 - xx;
                    int nearest = at(x, y, z);
                    if (nearest == 0) {
                        continue;
                    }
                    // The 13 neighbours that this sweep has visited already.
                    for (int n = 0; n < 13; ++n) {
                        const int px = x - way * (n % 3 - 1);
                        const int py = y - way * (n / 3 % 3 - 1);
                        const int pz = z - way * (n / 9 - 1);
                        if (px < 0 || py < 0 || pz < 0 || px >= cells.x || py >= cells.y || pz >= cells.z) {
                            continue;
                        }
                        nearest = std::min(nearest, at(px, py, pz) + 1);
                    }
                    at(x, y, z) = std::uint8_t(std::min(nearest, 255));
                }
            }
        }
    }
}

}  // namespace

CellRanges make_cell_ranges(const scene::VolumeGrid& grid) {
    CellRanges ranges;
    ranges.edge = choose_edge(grid.size);
    ranges.cells = (grid.size + ranges.edge - 1) / ranges.edge;
    const std::size_t count = std::size_t(ranges.cells.x) * ranges.cells.y * ranges.cells.z;
    ranges.smallest.resize(count);
    ranges.largest.resize(count);
    ranges.holes.resize(grid.absent.empty() ? 0 : count);
    ranges.usual_magnitude = std::max(std::abs(grid.core[0]), std::abs(grid.core[1]));
    const int edge = ranges.edge;
    const glm::ivec3 size = grid.size;
    scene::visit_voxels(grid, [&](auto samples) {
        tbb::parallel_for(0, ranges.cells.z * ranges.cells.y, [&](int row) {
            const int cz = row / ranges.cells.y;
            const int cy = row % ranges.cells.y;
            for (int cx = 0; cx < ranges.cells.x; ++cx) {
                const glm::ivec3 low = glm::max(glm::ivec3(cx, cy, cz) * edge - 1, 0);
                const glm::ivec3 high = glm::min(glm::ivec3(cx + 1, cy + 1, cz + 1) * edge, size - 1);
                using Sample = typename decltype(samples)::value_type;
                Sample smallest = std::numeric_limits<Sample>::max();
                Sample largest = std::numeric_limits<Sample>::lowest();
                bool holes = false;
                for (int z = low.z; z <= high.z; ++z) {
                    for (int y = low.y; y <= high.y; ++y) {
                        const std::size_t first = (std::size_t(z) * size.y + y) * size.x;
                        const auto* line = samples.data() + first;
                        for (int x = low.x; x <= high.x; ++x) {
                            if (grid.is_absent(first + std::size_t(x))) {
                                holes = true;
                                continue;
                            }
                            smallest = std::min(smallest, line[x]);
                            largest = std::max(largest, line[x]);
                        }
                    }
                }
                const std::size_t cell = std::size_t(row) * ranges.cells.x + cx;
                const bool nothing = smallest > largest;
                ranges.smallest[cell] = nothing ? 1.0F : float(smallest);
                ranges.largest[cell] = nothing ? 0.0F : float(largest);
                if (holes) {
                    ranges.holes[cell] = 1;
                }
            }
        });
    });
    return ranges;
}

TouchedEntries::TouchedEntries(const CellRanges& ranges, glm::dvec2 u_of_value, int entries)
    : ranges_(ranges), u_of_value_(u_of_value), entries_(entries) {
    for (std::size_t cell = 0; cell < ranges.smallest.size(); ++cell) {
        magnitude_ =
            std::max({magnitude_, std::abs(double(ranges.smallest[cell])), std::abs(double(ranges.largest[cell]))});
    }
}

TouchedEntries::Span TouchedEntries::of(std::size_t cell) const {
    const auto entry_of = [&](double value) {
        return std::clamp(value * u_of_value_.x + u_of_value_.y, 0.0, 1.0) * (entries_ - 1);
    };
    const double smallest = ranges_.smallest[cell];
    const double largest = ranges_.largest[cell];
    // Rounding is relative to the largest number that occurs, be it a value or the window's end that is taken from it.
    // An outlier counts in its own cell only.
    const double magnitude =
        std::min(magnitude_, std::max({ranges_.usual_magnitude, std::abs(smallest), std::abs(largest)}));
    const double largest_term = magnitude * std::abs(u_of_value_.x) + std::abs(u_of_value_.y);
    const double room =
        std::min(double(entries_), 4.0 * std::numeric_limits<float>::epsilon() * largest_term * (entries_ - 1));
    const double one = entry_of(smallest);
    const double other = entry_of(largest);
    return {std::max(0, int(std::floor(std::min(one, other) - room)) - 1),
            std::min(entries_, int(std::ceil(std::max(one, other) + room)) + 2)};
}

Emptiness find_emptiness(const CellRanges& ranges, const TransferTables& tables, glm::dvec2 u_of_value) {
    const int entries = int(tables.depth.size());
    // visible[i]: how many entries below i have extinction.
    std::vector<int> visible(std::size_t(entries) + 1, 0);
    for (int n = 0; n < entries; ++n) {
        visible[std::size_t(n) + 1] = visible[std::size_t(n)] + (tables.depth[std::size_t(n)].y > 0.0F ? 1 : 0);
    }
    const TouchedEntries touched(ranges, u_of_value, entries);
    Emptiness result;
    result.cells = ranges.cells;
    result.distance.resize(ranges.smallest.size());
    std::size_t occupied = 0;
    for (std::size_t cell = 0; cell < ranges.smallest.size(); ++cell) {
        const auto [first, behind] = ranges.is_nothing(cell) ? TouchedEntries::Span{0, 0} : touched.of(cell);
        const bool empty = visible[std::size_t(behind)] == visible[std::size_t(first)];
        result.distance[cell] = empty ? 255 : 0;
        occupied += empty ? 0 : 1;
    }
    result.occupied_share = double(occupied) / double(std::max<std::size_t>(1, ranges.smallest.size()));
    if (occupied > 0) {
        spread_distance(result.distance, result.cells);
    }
    return result;
}

}  // namespace bruma::render
