#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/field.h"

namespace bruma::scene {

enum class VoxelType { uint8, int8, uint16, int16, float32 };

template <>
inline std::span<const std::string_view> enum_words<VoxelType>() {
    static constexpr std::array<std::string_view, 5> words{"uint8", "int8", "uint16", "int16", "float32"};
    return words;
}

constexpr std::size_t bytes_per_voxel(VoxelType type) {
    switch (type) {
        case VoxelType::uint16:
        case VoxelType::int16:
            return 2;
        case VoxelType::float32:
            return 4;
        default:
            return 1;
    }
}

/// A value that stands for 'nothing was measured here', as scanners and simulations pad their data with.
struct FillValue {
    double value = 0.0;
    std::uint64_t count = 0;  ///< samples that hold it
};

/// A measured scalar field on a regular grid. x runs fastest, z slowest. Sample (i, j, k) sits at texture coordinate
/// ((i + 1/2) / nx, ...); the field fills the box [0,1]^3 and is clamped to its border samples in the outer half voxel.
/// Samples may be absent (not finite, or a fill value): where any of the eight samples around a place is, nothing is
/// drawn. Never changed once it is shared.
struct VolumeGrid {
    std::string name;    ///< file stem or builtin name, for people
    glm::ivec3 size{0};  ///< samples along x, y, z
    VoxelType type = VoxelType::uint8;
    glm::dvec3 spacing{1e-3};       ///< metres between neighbouring samples
    std::vector<std::byte> voxels;  ///< native endian, size.x * size.y * size.z * bytes_per_voxel; all values finite
    double smallest = 0.0;          ///< smallest and largest value present
    double largest = 0.0;
    /// The same without the few values that lie far apart from all others, which decide nothing; equal to these where
    /// there are none, and for samples of 8 bits.
    std::array<double, 2> core{0.0, 0.0};
    /// What suits the first look (see robust_window.h): the 0.1 and 99.9 % ranks of the samples that are present.
    std::array<double, 2> suggested_window{0.0, 1.0};
    /// 1 for samples that are absent, in the order of `voxels`, where the lower end of the suggested window stands in
    /// for them; empty: all are present.
    std::vector<std::uint8_t> absent;
    std::vector<FillValue> fills;  ///< the values that were taken for fills
    std::uint64_t nonfinite = 0;   ///< samples that were NaN or infinite

    std::size_t voxel_count() const { return std::size_t(size.x) * size.y * size.z; }
    glm::dvec3 extent() const { return glm::dvec3(size) * spacing; }  ///< metres along each axis

    bool has_outliers() const { return core[0] != smallest || core[1] != largest; }
    bool is_absent(std::size_t index) const { return !absent.empty() && absent[index] != 0; }
    std::uint64_t present_count() const;

    /// The value of one sample; indices are clamped to the grid.
    double value(int i, int j, int k) const;
};

/// Calls `use(std::span<const T>)` with the samples in their own type.
template <class Use>
decltype(auto) visit_voxels(const VolumeGrid& grid, Use&& use) {
    const auto as = [&]<class T>(const T*) {
        return std::span<const T>(reinterpret_cast<const T*>(grid.voxels.data()), grid.voxel_count());
    };
    switch (grid.type) {
        case VoxelType::int8:
            return use(as(static_cast<const std::int8_t*>(nullptr)));
        case VoxelType::uint16:
            return use(as(static_cast<const std::uint16_t*>(nullptr)));
        case VoxelType::int16:
            return use(as(static_cast<const std::int16_t*>(nullptr)));
        case VoxelType::float32:
            return use(as(static_cast<const float*>(nullptr)));
        default:
            return use(as(static_cast<const std::uint8_t*>(nullptr)));
    }
}

/// Whether fill values are looked for. Data made by code have none.
enum class Fills { kept, left_out };

/// Completes a grid whose samples are in place: ranges, windows and what is absent. Returns how many samples were not
/// finite. Without a present sample the range is 0 to 0.
std::size_t finish_grid(VolumeGrid& grid, Fills fills = Fills::kept);

/// A float32 grid from samples in order x fastest; the usual way for data made by code. Values must be finite.
std::shared_ptr<const VolumeGrid> make_grid(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                            std::span<const float> samples);
/// The same, rounded to uint8 after clamping to [0, 1]: 0 -> 0, 1 -> 255.
std::shared_ptr<const VolumeGrid> make_grid_uint8(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                                  std::span<const float> samples);

/// How often values occur: `counts[b]` for the equal bins between smallest and largest value. Values beyond count in
/// the bins at the ends, absent samples not at all.
struct Histogram {
    double smallest = 0.0, largest = 0.0;
    std::vector<std::uint64_t> counts;
};
Histogram histogram(const VolumeGrid& grid, int bins, std::array<double, 2> range);

}  // namespace bruma::scene
