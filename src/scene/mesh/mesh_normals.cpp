#include "scene/mesh/mesh_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/mesh/disjoint_sets.h"

namespace bruma::scene {
namespace {

/// Corners by vertex: those of vertex v are corners[start[v]] to corners[start[v + 1] - 1].
struct CornersOfVertices {
    std::vector<std::uint32_t> start, corners;
};

CornersOfVertices corners_of_vertices(std::size_t vertices, std::span<const glm::uvec3> triangles) {
    CornersOfVertices fans;
    fans.start.assign(vertices + 1, 0);
    for (const glm::uvec3& t : triangles) {
        for (int k = 0; k < 3; ++k) {
            ++fans.start[t[k] + 1];
        }
    }
    std::partial_sum(fans.start.begin(), fans.start.end(), fans.start.begin());
    std::vector<std::uint32_t> place(fans.start.begin(), fans.start.end() - 1);
    fans.corners.resize(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            fans.corners[place[triangles[t][k]]++] = 3 * t + std::uint32_t(k);
        }
    }
    return fans;
}

/// The normal of a triangle, and at each corner the same weighted by area and angle.
struct Facet {
    glm::dvec3 unit;
    glm::dvec3 weight_at_corner;
};

Facet facet(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 twice_area = glm::cross(b - a, c - a);
    const double length = glm::length(twice_area);
    const auto angle = [&](const glm::dvec3& at, const glm::dvec3& p, const glm::dvec3& q) {
        return std::atan2(length, glm::dot(p - at, q - at));
    };
    return {twice_area / length, 0.5 * length * glm::dvec3(angle(a, b, c), angle(b, c, a), angle(c, a, b))};
}

/// An edge from the vertex in question to `far`, on one side of which lies a corner.
struct Spoke {
    std::uint32_t far, corner;
    bool operator<(const Spoke& other) const { return far != other.far ? far < other.far : corner < other.corner; }
};

}  // namespace

CornerNormals smooth_normals(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                             double crease_angle_deg) {
    // A hair more, so that an edge at the very angle is smooth in spite of rounding.
    const double least_cosine = std::cos(glm::radians(crease_angle_deg)) - 1e-9;
    std::vector<Facet> facets;
    facets.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        facets.push_back(facet(positions[t.x], positions[t.y], positions[t.z]));
    }
    const CornersOfVertices fans = corners_of_vertices(positions.size(), triangles);

    CornerNormals result;
    result.corner_normal.resize(3 * triangles.size());
    std::vector<Spoke> spokes;
    std::vector<std::uint32_t> normal_of_piece;
    DisjointSets pieces;  // of the corners around one vertex
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const std::span fan(fans.corners.data() + fans.start[v], fans.start[v + 1] - fans.start[v]);
        pieces.reset(fan.size());
        spokes.clear();
        for (std::uint32_t n = 0; n < fan.size(); ++n) {
            const glm::uvec3& t = triangles[fan[n] / 3];
            spokes.push_back({t[int((fan[n] + 1) % 3)], n});
            spokes.push_back({t[int((fan[n] + 2) % 3)], n});
        }
        std::sort(spokes.begin(), spokes.end());
        for (std::size_t n = 1; n < spokes.size(); ++n) {
            // At most two triangles share an edge of a decent surface; a longer run is joined where neighbours agree.
            const Spoke& a = spokes[n - 1];
            const Spoke& b = spokes[n];
            if (a.far == b.far &&
                glm::dot(facets[fan[a.corner] / 3].unit, facets[fan[b.corner] / 3].unit) >= least_cosine) {
                pieces.join(a.corner, b.corner);
            }
        }
        constexpr std::uint32_t none = ~std::uint32_t(0);
        normal_of_piece.assign(fan.size(), none);
        const std::size_t first = result.normals.size();
        for (std::uint32_t n = 0; n < fan.size(); ++n) {
            std::uint32_t& normal = normal_of_piece[pieces.root(n)];
            if (normal == none) {
                normal = std::uint32_t(result.normals.size());
                result.normals.emplace_back(0.0);
            }
            const Facet& around = facets[fan[n] / 3];
            result.normals[normal] += around.weight_at_corner[int(fan[n] % 3)] * around.unit;
            result.corner_normal[fan[n]] = normal;
        }
        for (std::size_t n = first; n < result.normals.size(); ++n) {
            const double length = glm::length(result.normals[n]);
            // Sheets folded onto themselves cancel: any unit vector will do.
            result.normals[n] = length > 0.0 ? result.normals[n] / length : facets[fan[0] / 3].unit;
        }
    }
    return result;
}

}  // namespace bruma::scene
