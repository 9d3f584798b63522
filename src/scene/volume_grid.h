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

/// A measured scalar field on a regular grid. x runs fastest, z slowest. Sample (i, j, k) sits at texture coordinate
/// ((i + 1/2) / nx, ...); the field fills the box [0,1]^3 and is clamped to its border samples in the outer half voxel.
/// Never changed once it is shared.
struct VolumeGrid {
    std::string name;    ///< file stem or builtin name, for people
    glm::ivec3 size{0};  ///< samples along x, y, z
    VoxelType type = VoxelType::uint8;
    glm::dvec3 spacing{1e-3};       ///< metres between neighbouring samples
    std::vector<std::byte> voxels;  ///< native endian, size.x * size.y * size.z * bytes_per_voxel; all values finite
    double smallest = 0.0;          ///< smallest and largest value present
    double largest = 0.0;

    std::size_t voxel_count() const { return std::size_t(size.x) * size.y * size.z; }
    glm::dvec3 extent() const { return glm::dvec3(size) * spacing; }  ///< metres along each axis

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

/// Sets `smallest` and `largest`. Replaces NaN and infinities by the smallest finite value (0 when there is none) and
/// returns how many were replaced.
std::size_t finish_grid(VolumeGrid& grid);

/// A float32 grid from samples in order x fastest; the usual way for data made by code. Values must be finite.
std::shared_ptr<const VolumeGrid> make_grid(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                            std::span<const float> samples);
/// The same, rounded to uint8 after clamping to [0, 1]: 0 -> 0, 1 -> 255.
std::shared_ptr<const VolumeGrid> make_grid_uint8(std::string name, glm::ivec3 size, glm::dvec3 spacing,
                                                  std::span<const float> samples);

/// How often values occur: `counts[b]` for the equal bins between smallest and largest value.
struct Histogram {
    double smallest = 0.0, largest = 0.0;
    std::vector<std::uint64_t> counts;
};
Histogram histogram(const VolumeGrid& grid, int bins);

}  // namespace bruma::scene
