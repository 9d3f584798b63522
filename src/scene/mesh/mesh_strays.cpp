#include "scene/mesh/mesh_strays.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

namespace bruma::scene {
namespace {

double longest(const glm::dvec3& sides) {
    return std::max({sides.x, sides.y, sides.z});
}

}  // namespace

MeshCore mesh_core(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                   const MeshReport& report) {
    constexpr double far = 1000.0;
    MeshCore core{report.low, report.high, 0, {}};
    const std::size_t outermost = 3 * triangles.size() / 100;  // at either end of each axis
    if (outermost == 0) {
        return core;
    }
    std::vector<double> places;
    places.reserve(3 * triangles.size());
    glm::dvec3 low(0.0), high(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        places.clear();
        for (const glm::uvec3& t : triangles) {
            for (int k = 0; k < 3; ++k) {
                places.push_back(positions[t[k]][axis]);
            }
        }
        const auto from = places.begin() + std::ptrdiff_t(outermost);
        const auto to = places.end() - 1 - std::ptrdiff_t(outermost);
        std::nth_element(places.begin(), from, places.end());
        low[axis] = *from;
        std::nth_element(from, to, places.end());
        high[axis] = *to;
    }
    const double reach = far * longest(high - low);
    if (!(reach > 0.0) || longest(report.high - report.low) <= reach) {
        return core;
    }
    const glm::dvec3 middle = 0.5 * low + 0.5 * high;
    std::vector<char> seen(positions.size(), 0);
    core.low = core.high = middle;
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = positions[t[k]];
            if (longest(glm::abs(p - middle)) <= 0.5 * reach) {
                core.low = glm::min(core.low, p);
                core.high = glm::max(core.high, p);
            } else if (seen[t[k]] == 0) {
                core.first_stray = core.strays == 0 ? p : core.first_stray;
                ++core.strays;
                seen[t[k]] = 1;
            }
        }
    }
    return core;
}

std::string stray_words(const MeshCore& core, std::string_view where) {
    const glm::dvec3& p = core.first_stray;
    return fmt::format(
        "{}: {} a thousand times as far out as all others are wide, the first at ({:g}, {:g}, {:g}), so that all else "
        "is "
        "a speck beside {}; take {} out of the file if nothing belongs there",
        where, core.strays == 1 ? "1 vertex lies" : fmt::format("{} vertices lie", core.strays), p.x, p.y, p.z,
        core.strays == 1 ? "it" : "them", core.strays == 1 ? "it" : "them");
}

}  // namespace bruma::scene
