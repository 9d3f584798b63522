#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/transfer_tables.h"
#include "scene/volume_grid.h"

namespace bruma::render {

/// Smallest and largest data value that a sample inside each macrocell can read: its voxels and one voxel around, for
/// trilinear filtering. Cells are cubes of `edge` voxels; x runs fastest.
struct CellRanges {
    int edge = 4;
    glm::ivec3 cells{0};
    std::vector<float> smallest, largest;  ///< rounded outwards
};
CellRanges make_cell_ranges(const scene::VolumeGrid& grid);

/// Which cells hold anything visible, as the Chebyshev distance to the nearest such cell: 0 in the cell itself, at most
/// 255. From inside a cell at distance D, everything nearer than D cells is empty.
struct Emptiness {
    glm::ivec3 cells{0};
    std::vector<std::uint8_t> distance;
    double occupied_share = 0.0;
};
/// `u_of_value` gives u = x * value + y. A cell is empty only if no table entry that interpolation could touch, and one
/// more on each side for rounding, has any extinction.
Emptiness find_emptiness(const CellRanges& ranges, const TransferTables& tables, glm::dvec2 u_of_value);

}  // namespace bruma::render
