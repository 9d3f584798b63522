#include "scene/mesh/mesh_weld.h"

#include <array>
#include <bit>

namespace bruma::scene {
namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const glm::dvec3& point) {
    return {std::bit_cast<std::uint64_t>(point.x + 0.0), std::bit_cast<std::uint64_t>(point.y + 0.0),
            std::bit_cast<std::uint64_t>(point.z + 0.0)};
}

std::uint64_t mixed(const Bits& bits) {
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
    for (const std::uint64_t part : bits) {
        hash = (hash ^ part) * 0xff51afd7ed558ccdULL;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

std::vector<std::uint32_t> first_equal(std::span<const glm::dvec3> points) {
    constexpr std::uint32_t none = ~std::uint32_t(0);
    // Open addressing at most half full: a lookup touches one or two neighbouring places.
    std::vector<std::uint32_t> table(std::bit_ceil(2 * points.size() + 1), none);
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t n = 0; n < points.size(); ++n) {
        const Bits bits = bits_of(points[n]);
        std::size_t place = mixed(bits) & (table.size() - 1);
        while (table[place] != none && bits_of(points[table[place]]) != bits) {
            place = (place + 1) & (table.size() - 1);
        }
        if (table[place] == none) {
            table[place] = n;
        }
        first[n] = table[place];
    }
    return first;
}

}  // namespace bruma::scene
