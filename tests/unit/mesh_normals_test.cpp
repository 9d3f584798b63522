#include "scene/mesh/mesh_normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

/// A roof over the y axis whose two sides bend by `bend_deg`, cut into triangles of different sizes.
struct Roof {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
};
Roof roof(double bend_deg) {
    const double half = glm::radians(0.5 * bend_deg);
    const glm::dvec3 left(-std::cos(half), 0.0, -std::sin(half));
    const glm::dvec3 right(std::cos(half), 0.0, -std::sin(half));
    return {{{0, 0, 0}, {0, 1, 0}, left, right}, {{0, 1, 2}, {1, 0, 3}}};
}

TEST(MeshNormals, AnEdgeIsSmoothUpToTheCreaseAngleAndSharpBeyond) {
    for (const double bend : {10.0, 59.0, 61.0, 120.0}) {
        const Roof r = roof(bend);
        const CornerNormals found = smooth_normals(r.positions, r.triangles, 60.0);
        // Corner 0 of the first triangle and corner 1 of the second stand on the same end of the ridge.
        EXPECT_EQ(found.corner_normal[0] == found.corner_normal[4], bend < 60.0) << bend;
        const double tilt = std::abs(found.normals[found.corner_normal[0]].x);
        // By symmetry the smooth normal is upright; closed form, rounding only.
        EXPECT_NEAR(tilt, bend < 60.0 ? 0.0 : std::sin(glm::radians(0.5 * bend)), 1e-12) << bend;
    }
}

TEST(MeshNormals, AreWeightedByAreaAndAngle) {
    // At the origin a right angle of a triangle of area 2 that faces +z, and a small angle of one of area 1/2 that
    // faces -y; closed form, rounding only.
    const std::vector<glm::dvec3> positions{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 0, -0.5}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 3, 1}};
    const CornerNormals found = smooth_normals(positions, triangles, 180.0);
    const glm::dvec3 expected = glm::normalize(2.0 * glm::radians(90.0) * glm::dvec3(0, 0, 1) +
                                               0.5 * std::atan2(0.5, 2.0) * glm::dvec3(0, -1, 0));
    EXPECT_NEAR(glm::length(found.normals[found.corner_normal[0]] - expected), 0.0, 1e-12);
    EXPECT_EQ(found.corner_normal[0], found.corner_normal[3]);
}

TEST(MeshNormals, OfASpherePointOutward) {
    const MeshParts parts = mesh_sphere_parts();
    MeshSource source;
    source.normals = MeshNormals::computed;
    const LoadedMesh sphere = builtin_mesh("mesh-sphere", source);
    double worst_deg = 0.0;
    for (std::size_t n = 0; n < sphere.mesh->positions.size(); ++n) {
        const glm::dvec3 outward = glm::normalize(glm::dvec3(sphere.mesh->positions[n]));
        const double sine = glm::length(glm::cross(outward, glm::dvec3(sphere.mesh->normals[n])));
        EXPECT_GT(glm::dot(outward, glm::dvec3(sphere.mesh->normals[n])), 0.9);
        worst_deg = std::max(worst_deg, glm::degrees(std::asin(sine)));
    }
    // Closed form. Edges span 2 degrees, and the error of the mean over a fan is of second order in that; 0.152 degrees
    // where the triangles around a vertex differ most.
    EXPECT_LT(worst_deg, 0.2);
    EXPECT_EQ(sphere.mesh->positions.size(), parts.positions.size());
}

TEST(MeshNormals, ACubeHasFlatFaces) {
    std::vector<glm::dvec3> positions;
    positions.reserve(8);
    for (int n = 0; n < 8; ++n) {
        positions.emplace_back(n & 1, (n >> 1) & 1, (n >> 2) & 1);
    }
    const std::vector<glm::uvec3> triangles{{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                            {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const CornerNormals sharp = smooth_normals(positions, triangles, 60.0);
    EXPECT_EQ(sharp.normals.size(), 24U);
    for (const glm::dvec3& normal : sharp.normals) {
        EXPECT_NEAR(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 1.0, 1e-12);
    }
    EXPECT_EQ(smooth_normals(positions, triangles, 90.0).normals.size(), 8U);
}

}  // namespace
}  // namespace bruma::scene
