#include <gtest/gtest.h>

#include <cmath>

#include "io/describe.h"
#include "io/mesh/mesh_source.h"
#include "io/mesh/off_mesh.h"
#include "io/open.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io_temporary_folder.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::io {
namespace {

constexpr const char* square_faces = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

scene::LoadedMesh load(const std::filesystem::path& file) {
    scene::MeshSource source;
    source.file = file.string();
    return load_mesh(source, {});
}

const scene::Mesh& mesh_of(const scene::Scene& scene, const std::string& name) {
    return std::get<scene::Mesh>(scene.nodes.at(name).content);
}

TEST(OffMesh, ReadsWhatItsPrefixesAllow) {
    const TemporaryFolder folder;
    for (const std::string head :
         {"OFF\n4 2 5\n", "OFF 4 2 5\n", "4 2 0\n", "# made by hand\nOFF # comment\r\n\r\n4 2\n"}) {
        const auto file = folder.write("a.off", head + "0 0 0\n1 0 0\n1 1 0\n\n0 1 0\n3 0 1 2\n3 0 2 3 255 0 0\n");
        EXPECT_EQ(load(file).mesh->triangles.size(), 2U) << head;
        EXPECT_EQ(load(file).report.area, 1.0) << head;
    }
    const auto colours =
        folder.write("b.OFF", "COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n1 1 0 1 0 0 1\n0 1 0 1 0 0 1\n4 0 1 2 3\n");
    EXPECT_EQ(load(colours).mesh->triangles.size(), 2U);
}

TEST(OffMesh, NamesTheLineOfEveryFault) {
    const TemporaryFolder folder;
    const auto fault = [&](const std::string& text) { return refusal([&] { load(folder.write("a.off", text)); }); };
    EXPECT_TRUE(contains(fault("PLY\n"), "line 1: found 'PLY', expected OFF"));
    EXPECT_TRUE(contains(fault("OFF BINARY\n"), "binary OFF is not read"));
    EXPECT_TRUE(contains(fault("OFF\n"), "line 2: the file ends here"));
    EXPECT_TRUE(contains(fault("OFF\n1000000000000 1 0\n"), "but the whole file has"));
    EXPECT_TRUE(contains(fault("OFF\n3 1 0\n0 0 0\n1 0\n"), "line 4: expected the three numbers of vertex 2 of 3"));
    EXPECT_TRUE(
        contains(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n"), "line 6: the file ends here, expected face 1 of 1"));
    EXPECT_TRUE(contains(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"), "line 6: expected face 1 of 1"));
    EXPECT_TRUE(contains(fault("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), "1 with corners that do not exist"));
    EXPECT_TRUE(
        contains(fault("OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"), "1 with corners that are no finite numbers"));
    EXPECT_TRUE(contains(fault("OFF\n0 0 0\n"), "holds no faces"));
}

TEST(TriangleText, IsAMesh) {
    const TemporaryFolder folder;
    const std::string file = folder.write("two.raw", "# two\n0 0 0 1 0 0 1 1 0\n0 0 0 1 1 0 0 1 0\nend\n").string();
    const scene::Scene scene = open_files(std::vector{file}, {}, {});
    EXPECT_EQ((*mesh_of(scene, "two").triangles)->triangles.size(), 2U);
    EXPECT_EQ((*mesh_of(scene, "two").triangles)->positions.size(), 4U);
    const scene::LoadedMesh loaded = load(file);
    ASSERT_EQ(loaded.remarks.size(), 1U);
    EXPECT_TRUE(contains(loaded.remarks[0], "line 4 is no triangle"));
    EXPECT_EQ(loaded.report.open_edges, 4U);
    EXPECT_FALSE(is_mesh(folder.write("v_2x2x2_u8.raw", "abcdefgh").string()));
    EXPECT_TRUE(is_mesh(folder.write("late.raw", std::string(5000, '#') + "\n0 0 0 1 0 0 0 1 0\n").string()));
    EXPECT_TRUE(contains(refusal([&] { load((folder / "v_2x2x2_u8.raw").string()); }), "no text of triangles"));
}

TEST(MeshScene, IsSavedAndReadBackIdentical) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "data");
    const std::string file = folder.write("data/square.obj", square_faces).string();
    const std::vector<std::string> settings{"mesh.shading=translucent",      "mesh.material=custom",
                                            "mesh.absorption=[0.1,0.2,0.3]", "mesh.refraction_index=1.4",
                                            "mesh.source.crease_angle=12.5", "mesh.source.millimetres_per_unit=3",
                                            "mesh.diffuse_color=[0.25,1,0]", "mesh.textured=false"};
    const scene::Scene scene = open_files(std::vector{file, file}, {}, settings);
    ASSERT_TRUE(scene.nodes.contains("square_2"));
    EXPECT_EQ(scene.nodes.at("square").transform->translation, glm::dvec3(0.0));
    save_scene_file(scene, folder / "one.json");
    std::ifstream text(folder / "one.json");
    const auto document = nlohmann::json::parse(text);
    EXPECT_EQ(document["nodes"]["square"]["kind"], "mesh");
    EXPECT_EQ(document["nodes"]["square"]["source"]["file"], "data/square.obj");
    EXPECT_EQ(document["nodes"]["square"]["absorption"][2], 0.3);

    const scene::Scene again = read_scene_file(folder / "one.json");
    EXPECT_EQ(to_json(again), to_json(scene));
    EXPECT_EQ(*mesh_of(again, "square").surface, *mesh_of(scene, "square").surface);
    EXPECT_EQ(mesh_of(again, "square").source, mesh_of(scene, "square").source);
    EXPECT_EQ((*mesh_of(again, "square").triangles)->positions, (*mesh_of(scene, "square").triangles)->positions);
    EXPECT_EQ((*mesh_of(again, "square").triangles)->normals, (*mesh_of(scene, "square").triangles)->normals);
    EXPECT_EQ((*mesh_of(again, "square").triangles)->high, glm::dvec3(glm::vec3(0.003F, 0.003F, 0.0F)));
    // Two nodes of one file share it.
    EXPECT_EQ(*mesh_of(again, "square").triangles, *mesh_of(again, "square_2").triangles);
    EXPECT_EQ(scene::medium_of(*mesh_of(again, "square").surface).absorption, glm::dvec3(0.1, 0.2, 0.3));
}

TEST(MeshScene, RefusesWhatNoPictureCanBeMadeOf) {
    const TemporaryFolder folder;
    const std::string file = folder.write("square.obj", square_faces).string();
    const auto fault = [&](const std::vector<std::string>& settings) {
        return refusal([&] { open_files(std::vector{file}, {}, settings); });
    };
    EXPECT_TRUE(contains(fault({"mesh.material=marbel"}),
                         "nodes.square.material: unknown word 'marbel'; did you mean 'marble'?"));
    EXPECT_TRUE(contains(fault({"mesh.refraction_index=3"}), "3 is above 2.5"));
    EXPECT_TRUE(contains(fault({"mesh.source.millimetres_per_unit=0"}), "below 1e-12"));
    EXPECT_TRUE(contains(fault({"mesh.shading=translucent", "mesh.material=custom", "mesh.reduced_scattering=[1,0,1]"}),
                         "without scattering"));
    EXPECT_TRUE(contains(fault({"volume.ambient=0"}), "there is no volume in the scene"));
    EXPECT_TRUE(contains(refusal([&] { open_files(std::vector<std::string>{"builtin:pott"}, {}, {}); }),
                         "did you mean 'pot'?"));
    EXPECT_TRUE(contains(refusal([&] { open_files(std::vector<std::string>{"a.stl"}, {}, {}); }), ".obj, .off"));
}

TEST(MeshScene, CountsInTheBoundsAndInTheListOfWhatIsShown) {
    scene::Scene scene = open_files(std::vector<std::string>{"builtin:sphere", "builtin:mesh-sphere"}, {}, {});
    EXPECT_EQ(scene::shown_meshes(scene), std::vector<std::string>{"mesh-sphere"});
    EXPECT_EQ(scene::shown_volumes(scene), std::vector<std::string>{"sphere"});
    const scene::Bounds both = scene::world_bounds(scene);
    scene.nodes.at("sphere").visible = false;
    const scene::Bounds one = scene::world_bounds(scene);
    EXPECT_NEAR(one.high.x - one.low.x, 0.02, 1e-4);  // chords of the icosphere
    EXPECT_GT(both.high.x - both.low.x, 0.084);       // side by side, with a gap
    scene.nodes.at("mesh-sphere").transform = scene::Transform{.scale = {2.0, 1.0, 1.0}};
    EXPECT_NEAR(scene::world_bounds(scene).high.x, 0.02, 1e-4);
    scene.nodes.at("mesh-sphere").visible = false;
    EXPECT_TRUE(scene::shown_meshes(scene).empty());
}

TEST(Builtin, EveryMeshIsAsItIsDescribed) {
    for (const std::string& name : scene::builtin_mesh_names()) {
        const scene::LoadedMesh loaded = scene::builtin_mesh(name);
        EXPECT_TRUE(loaded.remarks.empty()) << name;
        EXPECT_EQ(loaded.report.degenerate_triangles, 0U) << name;
        EXPECT_EQ(loaded.report.misoriented_edges, 0U) << name;
        EXPECT_EQ(loaded.unit.millimetres, 1.0) << name;
        EXPECT_EQ(loaded.mesh->closed, name != "cornell" && name != "hills") << name;
        EXPECT_EQ(loaded.report.inverted_components, 0U) << name;
    }
    const scene::MeshReport sphere = scene::builtin_mesh("mesh-sphere").report;
    // Closed form; an inscribed icosphere of 20480 triangles lacks 0.12 % of the volume.
    EXPECT_NEAR(sphere.volume, 4.0 / 3.0 * 3.14159265 * 1000.0, 0.002 * 4189.0);
    EXPECT_LT(sphere.volume, 4.0 / 3.0 * 3.14159265 * 1000.0);
    EXPECT_EQ(scene::builtin_mesh("pot").report.components, 3U);
    EXPECT_EQ(scene::builtin_mesh("cornell").mesh->materials.size(), 4U);
    // Pappus: area of the tube's circle times the length of the knot, by the trapezium rule, which converges fast here.
    double length_mm = 0.0;
    for (int n = 0; n < 1000; ++n) {
        const double t = 2.0 * 3.14159265358979 * n / 1000.0;
        const double ring = 2.0 + std::cos(3.0 * t);
        length_mm += 8.0 *
                     std::sqrt(4.0 * ring * ring + 9.0 * std::sin(3.0 * t) * std::sin(3.0 * t) +
                               17.64 * std::cos(3.0 * t) * std::cos(3.0 * t)) *
                     2.0 * 3.14159265358979 / 1000.0;
    }
    // 32 sides fill 0.9936 of the circle.
    EXPECT_NEAR(scene::builtin_mesh("mesh-knot").report.volume / (25.0 * 3.14159265358979 * length_mm), 0.9936, 0.001);
}

TEST(Builtin, MeshesAndVolumesHaveDifferentNames) {
    for (const std::string& name : scene::builtin_mesh_names()) {
        const scene::Scene scene = open_files(std::vector<std::string>{"builtin:" + name}, {}, {});
        EXPECT_EQ(scene::shown_meshes(scene), std::vector<std::string>{name});
    }
}

/// Facts stated in the index of the data, and by an independent count over the faces of the files.
TEST(RealMeshes, ReportTheFactsThatAreKnown) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real meshes";
    }
    struct Case {
        const char* file;
        std::size_t vertices, faces, triangles, unused, open, open_as_indexed, non_manifold, components;
        bool closed;
        double volume;  ///< units cubed
    };
    for (const Case& c :
         {Case{"stanford-bunny.obj", 35947, 69451, 69451, 1113, 223, 223, 0, 1, false, 7.70056523898e-4},
          Case{"dragon-100k.obj", 50000, 100000, 100000, 0, 0, 0, 0, 1, true, 0.4451092043102},
          Case{"teapot.obj", 3644, 6320, 6320, 0, 160, 1036, 0, 3, false, 25.77010607},
          Case{"suzanne.obj", 507, 500, 968, 0, 42, 42, 1, 1, false, 0.0},
          Case{"uvsphere_512f.obj", 482, 512, 960, 0, 0, 0, 0, 1, true, 4.1219414752},
          Case{"spot/spot_triangulated.obj", 2930, 5856, 5856, 0, 0, 0, 0, 1, true, 0.7182587880998},
          Case{"spot/spot_quadrangulated.obj", 2930, 2928, 5856, 0, 0, 0, 0, 1, true, 0.0},
          Case{"cornell/CornellBox-Original.obj", 72, 18, 36, 0, 8, 72, 0, 4, false, 0.0}}) {
        const scene::LoadedMesh loaded = load(*data_folder() / "meshes" / c.file);
        const scene::MeshReport& report = loaded.report;
        EXPECT_EQ(report.vertices, c.vertices) << c.file;
        EXPECT_EQ(loaded.faces, c.faces) << c.file;
        EXPECT_EQ(report.triangles, c.triangles) << c.file;
        EXPECT_EQ(report.unused_vertices, c.unused) << c.file;
        EXPECT_EQ(report.open_edges, c.open) << c.file;
        EXPECT_EQ(report.open_edges_as_indexed, c.open_as_indexed) << c.file;
        EXPECT_EQ(report.non_manifold_edges, c.non_manifold) << c.file;
        EXPECT_EQ(report.components, c.components) << c.file;
        EXPECT_EQ(loaded.mesh->closed, c.closed) << c.file;
        EXPECT_FALSE(report.inside_out()) << c.file;
        if (c.volume > 0.0 && c.closed) {
            EXPECT_NEAR(report.volume, c.volume, 1e-10 * c.volume) << c.file;
        }
    }
}

TEST(RealMeshes, HaveTheirTexturesAndMaterials) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real meshes";
    }
    const auto folder = *data_folder() / "meshes";
    const scene::LoadedMesh cornell = load(folder / "cornell/CornellBox-Original.obj");
    EXPECT_EQ(cornell.mesh->materials.size(), 8U);
    ASSERT_EQ(cornell.remarks.size(), 1U);
    EXPECT_TRUE(contains(cornell.remarks[0],
                         ".mtl: tells more than is drawn: Ka (ambient light: Kd reflects it) of 2 materials, "
                         "Ke (light of its own: it lights nothing else) of 1 material"));
    EXPECT_EQ(cornell.mesh->materials[7].emission, glm::dvec3(17, 12, 4));
    EXPECT_TRUE(contains(load(folder / "uvsphere_512f.obj").remarks.at(0), "untitled.mtl does not exist"));
    scene::MeshSource spot;
    spot.file = (folder / "spot/spot_triangulated.obj").string();
    spot.texture = (folder / "spot/spot_texture.png").string();
    spot.crease_angle_deg = 180.0;
    const scene::LoadedMesh textured = load_mesh(spot, {});
    ASSERT_TRUE(textured.mesh->materials[0].diffuse_texture);
    EXPECT_EQ(textured.mesh->texture_coordinates.size(), textured.mesh->positions.size());
    EXPECT_EQ(textured.mesh->positions.size(), 3225U);  // the pairs of position and texture coordinate in the file
    // A size that people recognise: the bunny is 156 mm tall if its unit is the metre.
    EXPECT_EQ(load(folder / "stanford-bunny.obj").unit.millimetres, 1000.0);
}

TEST(Describe, TellsOfMeshes) {
    const TemporaryFolder folder;
    const std::string text = describe_file(folder.write("s.obj", square_faces).string(), {});
    EXPECT_TRUE(contains(text, "vertices 4, 0 normals, 0 texture coordinates\nfaces    1, 2 triangles\n")) << text;
    EXPECT_TRUE(contains(text, "unit     100 mm (proposed: the longest side is then 100 mm)")) << text;
    EXPECT_TRUE(contains(text, "extent   100 x 100 x 0 mm")) << text;
    EXPECT_TRUE(contains(text, "faults   4 open edges in 1 border")) << text;
    const std::string sphere = describe_file("builtin:mesh-sphere", {});
    EXPECT_TRUE(contains(sphere, "closed, outward, 1 piece\nfaults   none\n")) << sphere;
    EXPECT_TRUE(contains(sphere, "extent   20 x")) << sphere;
}

}  // namespace
}  // namespace bruma::io
