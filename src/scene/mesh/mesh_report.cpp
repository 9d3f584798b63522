#include "scene/mesh/mesh_report.h"

#include <fmt/core.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "scene/mesh/disjoint_sets.h"
#include "scene/mesh/mesh_weld.h"

namespace bruma::scene {
namespace {

/// An edge between two vertices in 31 bits each, and in the last bit whether its triangle runs from high to low.
using Edge = std::uint64_t;

std::uint32_t low_end(Edge edge) {
    return std::uint32_t(edge >> 32);
}
std::uint32_t high_end(Edge edge) {
    return std::uint32_t(edge >> 1) & 0x7fffffffU;
}

std::vector<Edge> sorted_edges(std::span<const glm::uvec3> triangles) {
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const Edge a = t[k];
            const Edge b = t[(k + 1) % 3];
            edges.push_back(a < b ? a << 32 | b << 1 : b << 32 | a << 1 | 1);
        }
    }
    tbb::parallel_sort(edges.begin(), edges.end());
    return edges;
}

/// Calls `use(edge, triangles on it, those that run from high to low)` for each edge.
template <class Use>
void for_each_edge(const std::vector<Edge>& edges, Use&& use) {
    for (std::size_t from = 0; from < edges.size();) {
        std::size_t to = from;
        std::size_t backwards = 0;
        for (; to < edges.size() && edges[to] >> 1 == edges[from] >> 1; ++to) {
            backwards += edges[to] & 1;
        }
        use(edges[from], to - from, backwards);
        from = to;
    }
}

std::size_t open_edge_count(std::span<const glm::uvec3> triangles) {
    std::size_t count = 0;
    for_each_edge(sorted_edges(triangles), [&](Edge, std::size_t sides, std::size_t) { count += sides == 1 ? 1 : 0; });
    return count;
}

std::size_t duplicate_count(std::span<const glm::uvec3> triangles) {
    std::vector<std::array<std::uint32_t, 3>> corners;
    corners.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        std::array<std::uint32_t, 3> sorted{t.x, t.y, t.z};
        std::sort(sorted.begin(), sorted.end());
        corners.push_back(sorted);
    }
    tbb::parallel_sort(corners.begin(), corners.end());
    return std::size_t(corners.end() - std::unique(corners.begin(), corners.end()));
}

/// Edges, borders and pieces of welded triangles with area.
void examine_connections(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                         MeshReport& report) {
    DisjointSets pieces(positions.size());
    for (const glm::uvec3& t : triangles) {
        pieces.join(t.x, t.y);
        pieces.join(t.y, t.z);
    }
    std::vector<char> has_hole(positions.size(), 0);
    DisjointSets borders(positions.size());
    std::vector<std::uint32_t> border_ends;
    for_each_edge(sorted_edges(triangles), [&](Edge edge, std::size_t sides, std::size_t backwards) {
        report.open_edges += sides == 1 ? 1 : 0;
        report.non_manifold_edges += sides > 2 ? 1 : 0;
        report.misoriented_edges += sides == 2 && backwards != 1 ? 1 : 0;
        if (sides != 2 || backwards != 1) {
            has_hole[pieces.root(low_end(edge))] = 1;
        }
        if (sides == 1) {
            borders.join(low_end(edge), high_end(edge));
            border_ends.push_back(low_end(edge));
        }
    });
    for (std::uint32_t& end : border_ends) {
        end = borders.root(end);
    }
    std::sort(border_ends.begin(), border_ends.end());
    report.open_borders = std::size_t(std::unique(border_ends.begin(), border_ends.end()) - border_ends.begin());

    // About the middle, so that a distant origin does not drown the volume in rounding.
    const glm::dvec3 middle = 0.5 * (report.low + report.high);
    std::vector<double> volumes(positions.size(), 0.0);
    std::vector<char> is_root(positions.size(), 0);
    for (const glm::uvec3& t : triangles) {
        const glm::dvec3 a = positions[t.x] - middle;
        const glm::dvec3 b = positions[t.y] - middle;
        const glm::dvec3 c = positions[t.z] - middle;
        const std::uint32_t piece = pieces.root(t.x);
        is_root[piece] = 1;
        volumes[piece] += glm::dot(a, glm::cross(b, c)) / 6.0;
        report.area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    for (std::size_t n = 0; n < positions.size(); ++n) {
        report.volume += volumes[n];
        report.components += is_root[n] != 0 ? 1 : 0;
        report.inverted_components += is_root[n] != 0 && has_hole[n] == 0 && volumes[n] < 0.0 ? 1 : 0;
    }
}

}  // namespace

MeshReport mesh_report(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    MeshReport report;
    report.vertices = positions.size();
    report.triangles = triangles.size();
    const std::vector<std::uint32_t> first = first_equal(positions);
    std::vector<char> used(positions.size(), 0);
    std::vector<glm::uvec3> welded;
    std::vector<glm::uvec3> as_indexed;
    bool seams = false;
    bool empty = true;
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3& p = positions[t[k]];
            used[t[k]] = 1;
            report.low = empty ? p : glm::min(report.low, p);
            report.high = empty ? p : glm::max(report.high, p);
            seams = seams || first[t[k]] != t[k];
            empty = false;
        }
        const glm::dvec3& a = positions[t.x];
        const glm::dvec3 ab = positions[t.y] - a;
        const glm::dvec3 ac = positions[t.z] - a;
        // Coordinates are known to half a unit in their last place: less than that in height is no area.
        const glm::dvec3 size = glm::abs(a) + glm::abs(ab) + glm::abs(ac);
        const double uncertainty =
            std::numeric_limits<double>::epsilon() * glm::length(size) * std::max(glm::length(ab), glm::length(ac));
        if (!(glm::length(glm::cross(ab, ac)) > uncertainty)) {
            ++report.degenerate_triangles;
            continue;
        }
        welded.emplace_back(first[t.x], first[t.y], first[t.z]);
        as_indexed.push_back(t);
    }
    report.unused_vertices = std::size_t(std::count(used.begin(), used.end(), 0));
    report.duplicate_triangles = duplicate_count(welded);
    examine_connections(positions, welded, report);
    report.open_edges_as_indexed = seams ? open_edge_count(as_indexed) : report.open_edges;
    return report;
}

std::vector<std::string> fault_words(const MeshReport& report) {
    std::vector<std::string> faults;
    const auto say = [&](std::size_t count, std::string_view one, std::string_view many) {
        if (count > 0) {
            faults.push_back(fmt::format("{} {}", count, count == 1 ? one : many));
        }
    };
    say(report.degenerate_triangles, "triangle without area", "triangles without area");
    say(report.duplicate_triangles, "triangle that repeats an earlier one", "triangles that repeat earlier ones");
    say(report.non_manifold_edges, "edge with more than two triangles (non-manifold)",
        "edges with more than two triangles (non-manifold)");
    say(report.misoriented_edges, "edge whose triangles disagree on which side is out",
        "edges whose triangles disagree on which side is out");
    if (report.open_edges > 0) {
        faults.push_back(fmt::format("{} open edge{} in {} border{}", report.open_edges,
                                     report.open_edges == 1 ? "" : "s", report.open_borders,
                                     report.open_borders == 1 ? "" : "s"));
    }
    if (report.inside_out()) {
        faults.emplace_back("the whole surface is inside out");
    } else {
        say(report.inverted_components, "closed piece that is inside out, or the wall of a hollow",
            "closed pieces that are inside out, or walls of hollows");
    }
    return faults;
}

}  // namespace bruma::scene
