#include "scene/mesh_polygon.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace bruma::scene {
namespace {

using Cut = std::vector<std::array<std::uint32_t, 3>>;

Cut cut(const std::vector<glm::dvec3>& corners) {
    Cut triangles;
    triangulate(corners, triangles);
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
    double sum = 0.0;
    for (const auto& triangle : triangles) {
        const double area = glm::dot(area_of(corners, triangle), normal);
        EXPECT_GE(area, -1e-12 * glm::length(polygon)) << what;  // rounding of a triangle without area
        sum += std::abs(area);
    }
    EXPECT_NEAR(sum, glm::length(polygon), 1e-12 * glm::length(polygon)) << what;
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

TEST(MeshPolygon, ManyCornersTakeLinearTimeOrARefusal) {
    std::vector<glm::dvec3> round;
    for (int n = 0; n < 100000; ++n) {
        const double angle = 2.0 * std::numbers::pi * n / 100000.0;
        round.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(cut(round).size(), 99998U);
    // A square law would take minutes; the margin is for slow machines.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    round[500] *= 0.5;
    EXPECT_THROW(cut(round), InputError);
}

}  // namespace
}  // namespace bruma::scene
