#pragma once
#include <array>
#include <memory>
#include <vector>

#include "scene/volume/volume_grid.h"

namespace bruma::reference {

/// The scalar field of a grid in voxel coordinates, where sample (i, j, k) sits at (i, j, k) and the box reaches from
/// -1/2 to n - 1/2. Cell i lies between the samples i and i + 1; the cells -1 and n - 1 hold the outer half voxels,
/// in which the field is clamped to the border samples.
class TrilinearField {
  public:
    explicit TrilinearField(std::shared_ptr<const scene::VolumeGrid> grid);

    const scene::VolumeGrid& grid() const { return *grid_; }

    /// Samples at the corners x + 2 y + 4 z of a cell in [-1, n - 1]^3.
    std::array<double, 8> corners(glm::ivec3 cell) const { return read_corners_(*grid_, cell); }

    /// Whether any of the corners is absent, so that the cell holds nothing.
    bool is_hole(glm::ivec3 cell) const;

    /// Gradients at the corners, data units per voxel: central differences, one-sided at the border of the grid and
    /// beside absent samples, 0 along an axis without neighbours.
    std::array<glm::dvec3, 8> corner_gradients(glm::ivec3 cell) const { return read_gradients_(*grid_, cell); }

  private:
    std::shared_ptr<const scene::VolumeGrid> grid_;
    std::array<double, 8> (*read_corners_)(const scene::VolumeGrid&, glm::ivec3);
    std::array<glm::dvec3, 8> (*read_gradients_)(const scene::VolumeGrid&, glm::ivec3);
};

/// Smallest and largest sample that the cells of each block of 8^3 cells can read; block (0, 0, 0) begins at cell
/// (-1, -1, -1). Without absent samples; a block of nothing else has its smallest above its largest.
struct BlockRanges {
    static constexpr int edge = 8;             ///< cells
    glm::ivec3 size{0};                        ///< blocks along x, y, z
    std::vector<std::array<float, 2>> ranges;  ///< x fastest; exact, for samples have at most 24 bits
    std::vector<std::uint8_t> has_holes;       ///< 1 where some of those samples are absent
};
BlockRanges block_ranges(const scene::VolumeGrid& grid);

}  // namespace bruma::reference
