#include "scene/mesh/mesh_polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace bruma::scene {
namespace {

using Cut = std::vector<std::array<std::uint32_t, 3>>;

Cut cut(const std::vector<glm::dvec3>& corners) {
    Cut triangles;
    EXPECT_TRUE(triangulate(corners, triangles));
    return triangles;
}

glm::dvec3 area_of(const std::vector<glm::dvec3>& p, const std::array<std::uint32_t, 3>& t) {
    return 0.5 * glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]);
}

/// Twice over: the areas add up to the polygon's, and none is turned over, so that none overlaps another.
void expect_tiles(const std::vector<glm::dvec3>& corners, const std::string& what) {
    const Cut triangles = cut(corners);
    ASSERT_EQ(triangles.size(), corners.size() - 2) << what;
    glm::dvec3 polygon(0.0);
    for (std::size_t n = 0; n < corners.size(); ++n) {
        polygon += 0.5 * glm::cross(corners[n], corners[(n + 1) % corners.size()]);
    }
    const glm::dvec3 normal = glm::normalize(polygon);
    std::size_t turned_over = 0;
    double sum = 0.0;
    for (const auto& triangle : triangles) {
        const double area = glm::dot(area_of(corners, triangle), normal);
        turned_over += area < -1e-12 * glm::length(polygon) ? 1 : 0;  // less: rounding of one without area
        sum += std::abs(area);
    }
    EXPECT_EQ(turned_over, 0U) << what;
    EXPECT_NEAR(sum, glm::length(polygon), 1e-12 * std::sqrt(double(corners.size())) * glm::length(polygon)) << what;
}

TEST(MeshPolygon, TilesConvexAndConcaveOnes) {
    expect_tiles({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, "rectangle");
    expect_tiles({{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}, "arrow head, notch at corner 2");
    expect_tiles({{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}, "arrow head, notch at corner 0");
    expect_tiles({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2, 3, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}, "U");
    expect_tiles({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}}, "corners in line");
    std::vector<glm::dvec3> star;
    for (int n = 0; n < 20; ++n) {
        const double radius = n % 2 == 0 ? 1.0 : 0.3;
        const double angle = std::numbers::pi * n / 10.0;
        star.emplace_back(radius * std::cos(angle), 0.0, radius * std::sin(angle));
    }
    expect_tiles(star, "star");
    // Far from the origin, where products of coordinates instead of differences would drown.
    for (glm::dvec3& p : star) {
        p += glm::dvec3(1e6, -2e6, 3e6);
    }
    const Cut triangles = cut(star);
    EXPECT_EQ(triangles.size(), 18U);
    for (const auto& triangle : triangles) {
        EXPECT_LT(area_of(star, triangle).y, 0.0);
    }
}

TEST(MeshPolygon, ARingWithABridgeKeepsItsHole) {
    expect_tiles(
        {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}},
        "square with a square hole");
}

TEST(MeshPolygon, AlwaysEndsOnWhatIsNoPolygon) {
    EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 2, 0}}).size(), 3U);
    EXPECT_EQ(cut(std::vector<glm::dvec3>(7, glm::dvec3(1.0))).size(), 5U);
    EXPECT_TRUE(cut({{0, 0, 0}, {1, 0, 0}}).empty());
}

/// Corners at a radius that follows from their number, around the origin.
template <class Radius>
std::vector<glm::dvec3> around(int count, double turns, Radius&& radius) {
    std::vector<glm::dvec3> corners;
    for (int n = 0; n < count; ++n) {
        const double angle = 2.0 * std::numbers::pi * turns * n / count;
        corners.emplace_back(radius(n) * std::cos(angle), radius(n) * std::sin(angle), 0.0);
    }
    return corners;
}

// A square law would take minutes for each of these.
TEST(MeshPolygon, ManyCornersAreCutConvexOrNot) {
    constexpr int many = 60000;
    EXPECT_EQ(cut(around(many, 1.0, [](int) { return 1.0; })).size(), std::size_t(many - 2));
    expect_tiles(around(many, 1.0, [](int n) { return n == 500 ? 0.5 : 1.0; }), "a circle with a notch");
    expect_tiles(around(many, 1.0, [](int n) { return n % 2 == 0 ? 1.0 : 0.5; }), "a star");
    expect_tiles(around(many, 1.0, [](int n) { return 1.0 + 0.3 * std::sin(0.01 * n) + 1e-3 * std::cos(2.7 * n); }),
                 "a coast");
    std::vector<glm::dvec3> comb{{double(many), -1.0, 0.0}};
    for (int n = many - 2; n >= 0; --n) {
        comb.emplace_back(n, n % 2 == 0 ? 0.0 : 1000.0, 0.0);
    }
    comb.emplace_back(0.0, -1.0, 0.0);
    expect_tiles(comb, "a comb");
    std::vector<glm::dvec3> spiral = around(many / 2, 40.0, [](int n) { return 1.0 + 1e-3 * n; });
    const std::vector<glm::dvec3> inner = around(many / 2, 40.0, [](int n) { return 0.9 + 1e-3 * n; });
    spiral.insert(spiral.end(), inner.rbegin(), inner.rend());
    expect_tiles(spiral, "a spiral");
}

TEST(MeshPolygon, WhatCrossesItselfAllOverIsGivenUp) {
    std::vector<glm::dvec3> tangle;
    std::uint64_t state = 1;
    const auto draw = [&] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return double(state >> 11) * 0x1p-53;
    };
    for (int n = 0; n < 200000; ++n) {
        const double x = draw();
        tangle.emplace_back(x, draw(), 0.0);
    }
    Cut triangles{{7, 8, 9}};
    EXPECT_FALSE(triangulate(tangle, triangles));
    EXPECT_EQ(triangles.size(), 1U);
}

}  // namespace
}  // namespace bruma::scene
