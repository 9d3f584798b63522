// Shelf: closed form. Meshes far from the origin of their files keep every digit, and files find their places.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "io/describe.h"
#include "io/mesh/mesh_source.h"
#include "io/open.h"
#include "io/scene/scene_file.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

/// In a metric map projection, as buildings and terrain come.
constexpr glm::dvec3 on_a_map(448262.125, 5411932.678, 244.5);

struct Facets {
    std::vector<glm::dvec3> corners;
    std::vector<glm::uvec3> faces;
};

/// A ball of radius 5 around a place, of rings by 2 * rings patches.
Facets ball(glm::dvec3 middle, double radius = 5.0, unsigned rings = 12) {
    Facets made;
    const unsigned columns = 2 * rings;
    for (unsigned i = 0; i <= rings; ++i) {
        for (unsigned j = 0; j < columns; ++j) {
            const double theta = M_PI * i / rings, phi = 2.0 * M_PI * j / columns;
            const double ring = i % rings == 0 ? 0.0 : std::sin(theta);  // a pole is one place, wherever it is
            made.corners.push_back(middle +
                                   radius * glm::dvec3(ring * std::cos(phi), std::cos(theta), ring * std::sin(phi)));
        }
    }
    for (unsigned i = 0; i < rings; ++i) {
        for (unsigned j = 0; j < columns; ++j) {
            const unsigned k = (j + 1) % columns;
            if (i > 0) {
                made.faces.emplace_back(i * columns + j, i * columns + k, (i + 1) * columns + k);
            }
            if (i + 1 < rings) {
                made.faces.emplace_back(i * columns + j, (i + 1) * columns + k, (i + 1) * columns + j);
            }
        }
    }
    return made;
}

std::string point_words(glm::dvec3 p) {
    return fmt::format("{:.17g} {:.17g} {:.17g}", p.x, p.y, p.z);
}

std::string text_of(const Facets& facets, const std::string& ending) {
    std::string text =
        ending == ".off" ? fmt::format("OFF\n{} {} 0\n", facets.corners.size(), facets.faces.size()) : "";
    for (const glm::dvec3& p : facets.corners) {
        text += ending == ".raw" ? "" : (ending == ".obj" ? "v " : "") + point_words(p) + "\n";
    }
    for (const glm::uvec3& t : facets.faces) {
        text += ending == ".obj"   ? fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1)
                : ending == ".off" ? fmt::format("3 {} {} {}\n", t.x, t.y, t.z)
                                   : fmt::format("{} {} {}\n", point_words(facets.corners[t.x]),
                                                 point_words(facets.corners[t.y]), point_words(facets.corners[t.z]));
    }
    return text;
}

std::string write(const TemporaryFolder& folder, const std::string& name, const Facets& facets) {
    return folder.write(name, text_of(facets, std::filesystem::path(name).extension().string())).string();
}

scene::Scene open(const std::vector<std::string>& files, const std::vector<std::string>& settings = {}) {
    return open_files(files, {}, settings);
}

const scene::Mesh& mesh_of(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Mesh>(scene.nodes.at(name).content);
}

/// A place of a mesh's file, in its units, as the scene tells it from a place in the world.
glm::dvec3 in_the_file(const scene::Scene& scene, const std::string& name, glm::dvec3 p_world) {
    const scene::Mesh& mesh = mesh_of(scene, name);
    const glm::dvec3 p_model = glm::inverse(scene::world_from_model(scene, name)) * glm::dvec4(p_world, 1.0);
    return 1e3 / (*mesh.triangles)->millimetres_per_unit * (p_model + (*mesh.triangles)->origin);
}

glm::dvec3 middle_of(const scene::Bounds& bounds) {
    return 0.5 * (bounds.low + bounds.high);
}

std::size_t lines_with(const std::string& part) {
    const std::vector<LogLine> lines = logged_lines();
    return std::size_t(
        std::count_if(lines.begin(), lines.end(), [&](const LogLine& line) { return contains(line.text, part); }));
}

TEST(MeshCoordinates, AFarBallIsTheNearOneInEveryFormat) {
    for (const std::string ending : {".obj", ".off", ".raw"}) {
        const TemporaryFolder folder;
        const std::string far = write(folder, "far" + ending, ball(on_a_map));
        const scene::Scene scene = open({far});
        const scene::Scene at_0 = open({write(folder, "near" + ending, ball(glm::dvec3(0.0)))});
        const scene::TriangleMesh& mesh = **mesh_of(scene, "far").triangles;
        const scene::TriangleMesh& near = **mesh_of(at_0, "near").triangles;
        ASSERT_EQ(mesh.positions.size(), near.positions.size()) << ending;
        for (std::size_t n = 0; n < near.positions.size(); ++n) {
            // The file's own numbers end at 1e-9 of its units, 1e-12 m here, and floats of 5 mm at 5e-10 m.
            EXPECT_LE(glm::length(mesh.positions[n] - near.positions[n]), 1e-9F) << ending;
        }
        const scene::Bounds bounds = scene::world_bounds(scene);
        EXPECT_LE(glm::length(middle_of(bounds)), 1e-8) << ending;
        EXPECT_LE(glm::length(in_the_file(scene, "far", middle_of(bounds)) - on_a_map), 1e-6) << ending;
        EXPECT_TRUE(contains(describe_file(far, {}), "offset   (448262.125, 5411932.678, 244.5) units")) << ending;
        EXPECT_FALSE(contains(describe_file((folder / ("near" + ending)).string(), {}), "offset")) << ending;
    }
}

TEST(MeshCoordinates, AreKeptInTheSceneFile) {
    const TemporaryFolder folder;
    const scene::Scene scene = open({write(folder, "far.obj", ball(on_a_map))});
    save_scene_file(scene, folder / "scene.json");
    const scene::Scene again = read_scene_file(folder / "scene.json");
    EXPECT_EQ(mesh_of(again, "far").source, mesh_of(scene, "far").source);
    EXPECT_EQ(scene::world_bounds(again).low, scene::world_bounds(scene).low);
    // A scene that names no origin has the file's own 0 there, to the last digit.
    scene::Scene older = scene;
    std::get<scene::Mesh>(older.nodes.at("far").content).source.origin.reset();
    const glm::dvec3 there = 1e-3 * on_a_map;  // 1 mm to the unit
    EXPECT_LE(glm::length(middle_of(scene::world_bounds(older)) - there), 1e-8);
    // Moving the origin reads nothing again.
    const std::size_t before = lines_with("far.obj: one unit is");
    const scene::Scene moved =
        with_settings(scene, std::vector<std::string>{"mesh.source.origin=[448260, 5411930, 0]"});
    EXPECT_EQ(*mesh_of(moved, "far").triangles, *mesh_of(scene, "far").triangles);
    EXPECT_LE(glm::length(middle_of(scene::world_bounds(moved)) - 1e-3 * glm::dvec3(2.125, 2.678, 244.5)), 1e-8);
    EXPECT_EQ(lines_with("far.obj: one unit is"), before);
}

TEST(CommonCoordinates, LeaveFarFilesWhereTheyAreToOneAnother) {
    const TemporaryFolder folder;
    const glm::dvec3 apart(12.0, -3.0, 0.25);
    const std::string one = write(folder, "one.obj", ball(on_a_map));
    // Another size, so that another unit would be proposed for it alone.
    const std::string two = write(folder, "two.off", ball(on_a_map + apart, 0.05));
    const scene::Scene beside = open({one, two});
    EXPECT_GT(scene::world_from_model(beside, "two")[3].x, 0.005);
    const scene::Scene common = open({one, two}, {"placement.common_coordinates=true"});
    const glm::dvec3 middle_one = scene::world_from_model(common, "one")[3];
    const glm::dvec3 middle_two = scene::world_from_model(common, "two")[3];
    EXPECT_LE(glm::length(middle_one), 1e-8);
    EXPECT_LE(glm::length(middle_two - middle_one - 1e-3 * apart), 1e-8);
    for (const std::string name : {"one", "two"}) {
        EXPECT_EQ((*mesh_of(common, name).triangles)->millimetres_per_unit, 1.0);
        EXPECT_LE(glm::length(in_the_file(common, name, glm::dvec3(0.0)) - on_a_map), 1e-6) << name;
    }
    // What is added later to the saved scene joins them.
    save_scene_file(common, folder / "scene.json");
    scene::Scene grown = read_scene_file(folder / "scene.json");
    EXPECT_TRUE(grown.placement->common_coordinates);
    add_file(grown, write(folder, "three.raw", ball(on_a_map + 2.0 * apart)), {});
    EXPECT_LE(glm::length(glm::dvec3(scene::world_from_model(grown, "three")[3]) - 2e-3 * apart), 1e-8);
}

TEST(CommonCoordinates, ASegmentationLiesOnItsScan) {
    const TemporaryFolder folder;
    // Samples 2 mm apart; the segmentation is in millimetres from the middle of the first, and small.
    const std::string scan = folder.write("scan_8x8x8_uint8_2x2x2mm.raw", std::string(512, '\1')).string();
    const std::string labels = folder.write("labels_8x8x8_uint8_2x2x2mm.raw", std::string(512, '\2')).string();
    const std::string surface = write(folder, "surface.obj", ball({7.0, 7.0, 7.0}, 2.5));
    const scene::Scene scene = open({surface, scan, labels}, {"placement.common_coordinates=true"});
    EXPECT_EQ(scene::world_from_texture(scene, "scan"), scene::world_from_texture(scene, "labels"));
    const glm::dvec3 middle = scene::world_from_texture(scene, "scan") * glm::dvec4(0.5, 0.5, 0.5, 1.0);
    EXPECT_LE(glm::length(middle - glm::dvec3(7e-3)), 1e-12);
    scene::Scene surface_alone = scene;
    surface_alone.nodes.erase("scan");
    surface_alone.nodes.erase("labels");
    const scene::Bounds bounds = scene::world_bounds(surface_alone);
    EXPECT_LE(glm::length(middle_of(bounds) - middle), 1e-8);
    EXPECT_NEAR(bounds.high.y - bounds.low.y, 5e-3, 1e-8);
}

TEST(MeshSettings, OfTheSourceHoldBeforeTheFileIsRead) {
    const TemporaryFolder folder;
    const std::string file = write(folder, "once.obj", ball(glm::dvec3(0.0)));
    std::size_t reads = 0;
    const Progress count = [&](double share, std::string_view) { reads += share == 0.0 ? 1 : 0; };
    const std::vector<std::string> settings{"mesh.source.millimetres_per_unit=3", "nodes.once.source.crease_angle=20"};
    const scene::Scene scene = open_files(std::vector{file}, {}, settings, count);
    EXPECT_EQ(reads, 1U);
    EXPECT_EQ((*mesh_of(scene, "once").triangles)->millimetres_per_unit, 3.0);
    EXPECT_EQ(mesh_of(scene, "once").source.crease_angle_deg, 20.0);
    EXPECT_EQ(lines_with("once.obj: one unit is"), 0U);
    // Volumes are no better: a layout that only settings tell is enough.
    const std::string volume = folder.write("plain.raw", std::string("\1\2\3\4\5\6\7\10", 8)).string();
    const scene::Scene grid = open({volume}, {"volume.source.size=[2,2,2]", "volume.source.type=uint8"});
    EXPECT_EQ((*std::get<scene::Volume>(grid.nodes.at("plain").content).grid)->largest, 8.0);
}

/// A pawn of height 3 on a round foot of radius 1, turned about an axis: 1 is y, 2 is z.
Facets pawn(int up) {
    const std::vector<glm::dvec2> outline{{1.0, 0.0}, {1.0, 0.3}, {0.4, 1.0}, {0.3, 2.0}, {0.5, 2.5}, {0.3, 2.9}};
    constexpr unsigned columns = 24;
    Facets made;
    const auto place = [&](double x, double height, double y) {
        made.corners.push_back(up == 2 ? glm::dvec3(x, y, height) : glm::dvec3(y, height, x));
    };
    for (const glm::dvec2& ring : outline) {
        for (unsigned j = 0; j < columns; ++j) {
            const double phi = 2.0 * M_PI * j / columns;
            place(ring.x * std::cos(phi), ring.y, ring.x * std::sin(phi));
        }
    }
    place(0.0, 0.0, 0.0);
    place(0.0, 3.0, 0.0);
    const auto foot = unsigned(columns * outline.size()), tip = foot + 1;
    for (unsigned j = 0; j < columns; ++j) {
        const unsigned k = (j + 1) % columns;
        made.faces.emplace_back(foot, k, j);
        for (unsigned ring = 0; ring + 1 < outline.size(); ++ring) {
            const unsigned a = ring * columns, b = a + columns;
            made.faces.emplace_back(a + j, a + k, b + k);
            made.faces.emplace_back(a + j, b + k, b + j);
        }
        const auto last = unsigned(columns * (outline.size() - 1));
        made.faces.emplace_back(last + j, last + k, tip);
    }
    return made;
}

TEST(MeshUp, WhatStandsOnZIsSetUprightAndSaid) {
    const TemporaryFolder folder;
    const std::string file = write(folder, "standing.obj", pawn(2));
    const scene::Scene scene = open({file});
    const scene::Bounds bounds = scene::world_bounds(scene);
    EXPECT_GT(bounds.high.y - bounds.low.y, 1.4 * (bounds.high.z - bounds.low.z));
    const glm::dvec3 foot = scene::world_from_model(scene, "standing") * glm::dvec4(0.0, 0.0, 0.0, 1.0);
    EXPECT_NEAR(foot.y, bounds.low.y, 1e-6);
    EXPECT_EQ(lines_with("standing.obj: stands on a wide flat base"), 1U);
    const scene::Scene back = open({file}, {"nodes.standing.transform.rotation=[0,0,0]"});
    EXPECT_EQ(back.nodes.at("standing").transform->rotation_deg, glm::dvec3(0.0));
    EXPECT_EQ(open({file}, {"placement.common_coordinates=true"}).nodes.at("standing").transform->rotation_deg,
              glm::dvec3(0.0));
    EXPECT_TRUE(contains(describe_file(file, {}), "up       z"));
}

TEST(MeshUp, WhatMayAsWellStandOnYIsLeftAlone) {
    const TemporaryFolder folder;
    const auto rotation = [&](const std::string& file) {
        return open({file}).nodes.begin()->second.transform->rotation_deg;
    };
    EXPECT_EQ(rotation(write(folder, "upright.obj", pawn(1))), glm::dvec3(0.0));
    EXPECT_EQ(rotation(write(folder, "ball.obj", ball(glm::dvec3(0.0)))), glm::dvec3(0.0));
    Facets low = pawn(2);
    for (glm::dvec3& p : low.corners) {
        p.z *= 0.05;  // a relief, which may as well lie on its back
    }
    EXPECT_EQ(rotation(write(folder, "relief.obj", low)), glm::dvec3(0.0));
    const std::string box =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
        "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    EXPECT_EQ(rotation(folder.write("box.obj", box).string()), glm::dvec3(0.0));
}

TEST(MeshNumbers, BeyondSinglePrecisionAreLeftOutAndSaid) {
    const TemporaryFolder folder;
    const scene::MeshSource source{
        .file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 1e39 0 0\nf 1 2 3\nf 1 2 4\n").string()};
    const scene::LoadedMesh loaded = load_mesh(source, {});
    EXPECT_EQ(loaded.mesh->triangles.size(), 1U);
    ASSERT_EQ(loaded.remarks.size(), 2U);
    EXPECT_TRUE(contains(loaded.remarks[0], "1 face with vertices that are no finite numbers up to 3.4e38 left out"));
    EXPECT_TRUE(contains(loaded.remarks[1], "stands in line 6"));
}

TEST(MeshStrays, AreSaidAndSpoilNeitherCoordinatesNorUnit) {
    const TemporaryFolder folder;
    Facets facets = ball(on_a_map);
    facets.corners.emplace_back(0.0);  // as exporters write what they do not know
    facets.faces.emplace_back(60, 61, facets.corners.size() - 1);
    const scene::LoadedMesh loaded = load_mesh({.file = write(folder, "stray.obj", facets)}, {});
    ASSERT_EQ(loaded.remarks.size(), 1U);
    EXPECT_TRUE(contains(loaded.remarks[0], "1 vertex lies a thousand times as far out")) << loaded.remarks[0];
    EXPECT_EQ(loaded.unit.millimetres, 1.0);
    EXPECT_LE(glm::length(loaded.mesh->origin - 1e-3 * on_a_map), 1e-8);
    facets.corners.back() = on_a_map + glm::dvec3(20.0, 0.0, 0.0);
    EXPECT_TRUE(load_mesh({.file = write(folder, "spike.obj", facets)}, {}).remarks.empty());
}

}  // namespace
}  // namespace bruma::io
