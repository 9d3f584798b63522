#include "scene/mesh/mesh_report.h"

#include <gtest/gtest.h>

#include <chrono>

#include "scene/mesh/mesh_parts.h"
#include "scene/mesh/mesh_unit.h"
#include "scene/mesh/mesh_weld.h"

namespace bruma::scene {
namespace {

const std::vector<glm::dvec3> tetrahedron_corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<glm::uvec3> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(MeshReport, OfAClosedBody) {
    const MeshReport report = mesh_report(tetrahedron_corners, tetrahedron);
    EXPECT_TRUE(report.closed());
    EXPECT_FALSE(report.inside_out());
    EXPECT_NEAR(report.volume, 1.0 / 6.0, 1e-14);
    EXPECT_NEAR(report.area, 1.5 + 0.5 * std::sqrt(3.0), 1e-14);
    EXPECT_EQ(report.components, 1U);
    EXPECT_TRUE(fault_words(report).empty());
    EXPECT_EQ(report.high, glm::dvec3(1.0));
}

TEST(MeshReport, FindsWhatIsOpenFlippedDoubledOrFlat) {
    std::vector<glm::uvec3> open(tetrahedron.begin(), tetrahedron.end() - 1);
    EXPECT_EQ(mesh_report(tetrahedron_corners, open).open_edges, 3U);
    EXPECT_EQ(mesh_report(tetrahedron_corners, open).open_borders, 1U);
    EXPECT_FALSE(mesh_report(tetrahedron_corners, open).closed());

    std::vector<glm::uvec3> flipped = tetrahedron;
    std::swap(flipped[2].y, flipped[2].z);
    EXPECT_EQ(mesh_report(tetrahedron_corners, flipped).misoriented_edges, 3U);
    EXPECT_FALSE(mesh_report(tetrahedron_corners, flipped).closed());

    std::vector<glm::uvec3> doubled = tetrahedron;
    doubled.emplace_back(2, 3, 1);
    EXPECT_EQ(mesh_report(tetrahedron_corners, doubled).duplicate_triangles, 1U);
    EXPECT_EQ(mesh_report(tetrahedron_corners, doubled).non_manifold_edges, 3U);

    std::vector<glm::uvec3> flat = tetrahedron;
    flat.emplace_back(1, 1, 2);
    EXPECT_EQ(mesh_report(tetrahedron_corners, flat).degenerate_triangles, 1U);
    EXPECT_TRUE(mesh_report(tetrahedron_corners, flat).closed());
    // In line up to the rounding of thirds and tenths, which leaves a cross product of 1e-17.
    const std::vector<glm::dvec3> line{{0.1, 0.2, 0.3}, {0.4, 0.8, 1.2}, {0.7, 1.4, 2.1}};
    EXPECT_EQ(mesh_report(line, std::vector<glm::uvec3>{{0, 1, 2}}).degenerate_triangles, 1U);
}

TEST(MeshReport, KnowsInsideOutFromHollow) {
    std::vector<glm::uvec3> inverted = tetrahedron;
    for (glm::uvec3& t : inverted) {
        std::swap(t.y, t.z);
    }
    EXPECT_TRUE(mesh_report(tetrahedron_corners, inverted).inside_out());
    EXPECT_NEAR(mesh_report(tetrahedron_corners, inverted).volume, -1.0 / 6.0, 1e-14);
    // A small inverted body inside a large one: a hollow, not a fault of the whole.
    std::vector<glm::dvec3> positions = tetrahedron_corners;
    std::vector<glm::uvec3> both = tetrahedron;
    for (const glm::dvec3& p : tetrahedron_corners) {
        positions.push_back(0.1 + 0.2 * p);
    }
    for (const glm::uvec3& t : inverted) {
        both.push_back(t + 4U);
    }
    const MeshReport report = mesh_report(positions, both);
    EXPECT_EQ(report.components, 2U);
    EXPECT_EQ(report.inverted_components, 1U);
    EXPECT_TRUE(report.closed());
    EXPECT_FALSE(report.inside_out());
}

TEST(MeshReport, WeldsVerticesAtTheSamePlace) {
    std::vector<glm::dvec3> soup;
    std::vector<glm::uvec3> triangles;
    for (const glm::uvec3& t : tetrahedron) {
        triangles.emplace_back(soup.size(), soup.size() + 1, soup.size() + 2);
        for (int k = 0; k < 3; ++k) {
            soup.push_back(tetrahedron_corners[t[k]]);
        }
    }
    soup[0] = glm::dvec3(-0.0, 0.0, -0.0);
    const MeshReport report = mesh_report(soup, triangles);
    EXPECT_TRUE(report.closed());
    EXPECT_EQ(report.open_edges_as_indexed, 12U);
    EXPECT_EQ(first_equal(soup)[3], 0U);
}

TEST(MeshReport, OfAMillionPiecesIsQuick) {
    std::vector<glm::dvec3> positions;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t n = 0; n < 1000000; ++n) {
        positions.insert(positions.end(), {{n, 0, 0}, {n + 0.5, 0, 0}, {n, 0.5, 0}});
        triangles.emplace_back(3 * n, 3 * n + 1, 3 * n + 2);
    }
    const auto start = std::chrono::steady_clock::now();
    const MeshReport report = mesh_report(positions, triangles);
    EXPECT_EQ(report.components, 1000000U);
    EXPECT_EQ(report.open_edges, 3000000U);
    EXPECT_EQ(report.open_borders, 1000000U);
    // A square law would take hours; the margin is for slow machines and sanitizers.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(MeshUnit, IsProposedBySizeOrReadFromAComment) {
    EXPECT_EQ(proposed_unit(0.156).millimetres, 1000.0);
    EXPECT_EQ(proposed_unit(2.0).millimetres, 100.0);
    EXPECT_EQ(proposed_unit(80.0).millimetres, 1.0);
    // Plausible millimetres stay what they are.
    for (const double side : {10.0, 20.0, 556.0, 1800.0}) {
        EXPECT_EQ(proposed_unit(side).millimetres, 1.0) << side;
    }
    for (const double side : {1e-6, 3e-3, 0.3, 7.0, 12345.0, 1e6}) {
        const double longest_mm = proposed_unit(side).millimetres * side;
        EXPECT_GE(longest_mm, 31.6) << side;
        EXPECT_LE(longest_mm, 316.3) << side;
    }
    EXPECT_GT(proposed_unit(0.0).millimetres, 0.0);
    EXPECT_EQ(commented_unit_mm("# 3ds Max\n# File units = centimeters\nv 0 0 0\n"), 10.0);
    EXPECT_EQ(commented_unit_mm("# Units: mm\r\n"), 1.0);
    EXPECT_EQ(commented_unit_mm("# 12 m of hose\n# community of united inches\nunits mm\n"), 0.0);
}

TEST(MakeMesh, LeavesOutWhatHasNoAreaAndTurnsRoundWhatIsInsideOut) {
    MeshParts parts;
    parts.where = "test";
    parts.positions = tetrahedron_corners;
    parts.positions.emplace_back(1e9, 0, 0);
    for (const glm::uvec3& t : tetrahedron) {
        parts.add_face(std::array<FaceCorner, 3>{{{int(t.x)}, {int(t.z)}, {int(t.y)}}}, 0);
    }
    parts.add_face(std::array<FaceCorner, 3>{{{0}, {1}, {1}}}, 0);
    const LoadedMesh loaded = make_mesh(parts, {}, 0.0);
    ASSERT_EQ(loaded.mesh->triangles.size(), 4U);
    EXPECT_TRUE(loaded.mesh->closed);
    EXPECT_EQ(loaded.remarks.size(), 2U);
    EXPECT_EQ(loaded.unit.millimetres, 100.0);
    EXPECT_EQ(loaded.mesh->high, glm::dvec3(glm::vec3(0.1F)));
    std::vector<glm::dvec3> positions(loaded.mesh->positions.begin(), loaded.mesh->positions.end());
    EXPECT_GT(mesh_report(positions, loaded.mesh->triangles).volume, 0.0);
    for (std::size_t n = 0; n < loaded.mesh->triangles.size(); ++n) {
        const glm::uvec3& t = loaded.mesh->triangles[n];
        const glm::dvec3 area = glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
        EXPECT_GT(glm::dot(area, glm::dvec3(loaded.mesh->normals[t.x])), 0.0);
    }
}

TEST(MakeMesh, IsTheSameShapeAtAnySize) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        MeshParts parts;
        parts.where = "test";
        for (const glm::dvec3& p : tetrahedron_corners) {
            parts.positions.push_back(size * p);
        }
        for (const glm::uvec3& t : tetrahedron) {
            parts.add_face(std::array<FaceCorner, 3>{{{int(t.x)}, {int(t.y)}, {int(t.z)}}}, 0);
        }
        for (const double unit : {0.0, 1e-6, 1e6}) {
            const LoadedMesh loaded = make_mesh(parts, {}, unit);
            EXPECT_EQ(loaded.mesh->triangles.size(), 4U) << size << " " << unit;
            EXPECT_EQ(loaded.mesh->positions.size(), 12U) << size << " " << unit;
        }
        MeshSource source;
        source.millimetres_per_unit = 1e12;
        EXPECT_EQ(make_mesh(parts, source, 0.0).mesh->millimetres_per_unit, 1e12);
    }
}

}  // namespace
}  // namespace bruma::scene
