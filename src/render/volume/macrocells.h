#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/volume/transfer_tables.h"
#include "scene/volume/volume_grid.h"

namespace bruma::render {

/// Smallest and largest data value that a sample inside each macrocell can read: its voxels and one voxel around, for
/// trilinear filtering. Cells are cubes of `edge` voxels; x runs fastest.
struct CellRanges {
    int edge = 4;
    glm::ivec3 cells{0};
    std::vector<float> smallest, largest;  ///< rounded outwards, without absent samples; 1 and 0 where all are
    std::vector<std::uint8_t> holes;       ///< 1 where some samples are absent; empty: nowhere
    /// The largest magnitude among all values but outliers.
    double usual_magnitude = 1e300;

    /// Nothing but absent samples.
    bool is_nothing(std::size_t cell) const { return !holes.empty() && smallest[cell] > largest[cell]; }
};
CellRanges make_cell_ranges(const scene::VolumeGrid& grid);

/// Which entries of a table over u in [0, 1] linear lookups inside a cell can touch, and one more on each side for
/// rounding. `u_of_value` gives u = x * value + y. Not to be asked for cells of nothing.
class TouchedEntries {
  public:
    TouchedEntries(const CellRanges& ranges, glm::dvec2 u_of_value, int entries);
    struct Span {
        int first, behind;  ///< entries first .. behind - 1, at least one
    };
    Span of(std::size_t cell) const;

  private:
    const CellRanges& ranges_;
    glm::dvec2 u_of_value_;
    int entries_;
    double magnitude_ = 0.0;  ///< the largest that occurs
};

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
