#include "io/mesh/obj_mesh.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

constexpr const char* square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

scene::LoadedMesh load(const TemporaryFolder& folder, const std::string& text) {
    return load_obj_mesh(folder.write("a.obj", text), {});
}

std::string all_remarks(const scene::LoadedMesh& loaded) {
    std::string all;
    for (const std::string& remark : loaded.remarks) {
        all += remark + "\n";
    }
    return all;
}

double area_mm2(const scene::LoadedMesh& loaded) {
    return loaded.unit.millimetres * loaded.unit.millimetres * loaded.report.area;
}

TEST(ObjMesh, ReadsFacesInEveryWriting) {
    const TemporaryFolder folder;
    for (const char* face : {"f 1 2 3 4", "f -4 -3 -2 -1", "f 1 2 3 4 # a comment of 3 words", "f 1 2 \\\n3 4",
                             "  f\t1  2 3 4  ", "f 1 2 3 4\r", "g one two\no three\ns off\nf 1 2 3\nf 1 3 4"}) {
        const scene::LoadedMesh loaded = load(folder, square + std::string(face) + "\n");
        EXPECT_EQ(loaded.mesh->triangles.size(), 2U) << face;
        EXPECT_EQ(loaded.mesh->positions.size(), 4U) << face;
        EXPECT_EQ(loaded.remarks.size(), 0U) << face << all_remarks(loaded);
        EXPECT_NEAR(loaded.report.area, 1.0, 1e-12) << face;
        EXPECT_EQ(loaded.mesh->normals[0], glm::vec3(0, 0, 1)) << face;
    }
    EXPECT_EQ(load(folder, "\xef\xbb\xbf" + std::string(square) + "f 1 2 3 4\n").report.vertices, 4U);
    // Faces before their vertices, and all in lines that end in CR LF or CR alone.
    EXPECT_EQ(load(folder, std::string("f 1 2 3 4\n") + square).mesh->triangles.size(), 2U);
    for (const std::string end : {"\r\n", "\r"}) {
        std::string text = square + std::string("f 1 2 3 4\n");
        for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + end.size())) {
            text.replace(at, 1, end);
        }
        EXPECT_EQ(load(folder, text).mesh->triangles.size(), 2U);
    }
}

TEST(ObjMesh, CutsAConcaveFaceWithoutCoveringItsNotch) {
    const TemporaryFolder folder;
    // An arrow head of area 4; a fan from its first corner would cover 8 with two triangles turned over.
    const scene::LoadedMesh loaded = load(folder, "v 0 4 0\nv 0 0 0\nv 4 0 0\nv 1 1 0\nf 1 2 3 4\n");
    EXPECT_NEAR(loaded.report.area, 4.0, 1e-12);
    const scene::LoadedMesh five = load(folder, "v 0 0 9\nv 4 0 9\nv 4 4 9\nv 2 1 9\nv 0 4 9\nf 1 2 3 4 5\n");
    EXPECT_NEAR(five.report.area, 10.0, 1e-12);
    EXPECT_EQ(five.mesh->triangles.size(), 3U);
}

TEST(ObjMesh, KeepsTheOriginAndTakesTheUnitFromTheSceneTheFileOrItsSize) {
    const TemporaryFolder folder;
    const std::string text = "v 10 0 0\nv 12 0 0\nv 10 1 0\nf 1 2 3\n";
    const scene::LoadedMesh proposed = load(folder, text);
    EXPECT_EQ(proposed.unit.millimetres, 100.0);
    EXPECT_EQ(proposed.mesh->low, glm::dvec3(1, 0, 0));
    EXPECT_EQ(load(folder, "# units: inches\n" + text).unit.millimetres, 25.4);
    scene::MeshSource source;
    source.millimetres_per_unit = 2.0;
    const scene::LoadedMesh chosen = load_obj_mesh(folder / "a.obj", source);
    EXPECT_EQ(chosen.mesh->millimetres_per_unit, 2.0);
    EXPECT_EQ(chosen.mesh->high, glm::dvec3(glm::vec3(0.024F, 0.002F, 0.0F)));
}

TEST(ObjMesh, RepairsOrLeavesOutWhatIsBrokenAndSaysSo) {
    const TemporaryFolder folder;
    const auto remarks_of = [&](const std::string& rest) {
        const scene::LoadedMesh loaded = load(folder, square + rest + "f 1 2 3\n");
        EXPECT_EQ(loaded.mesh->triangles.size(), 1U) << rest;
        return all_remarks(loaded);
    };
    EXPECT_TRUE(contains(remarks_of("f 1 2 9\n"), "1 face with vertices that do not exist left out"));
    EXPECT_TRUE(contains(remarks_of("f 1 2 9\n"), "stands in line 5"));
    EXPECT_TRUE(contains(remarks_of("f 0 1 2\nf 1 2 -9\nf 1 2 x\n"), "3 faces with vertices that do not exist"));
    EXPECT_TRUE(contains(remarks_of("f 1 2 99999999999999999999\n"), "do not exist"));
    EXPECT_TRUE(contains(remarks_of("f 1 2\nf 3\n"), "2 faces with less than three corners"));
    EXPECT_TRUE(contains(remarks_of("f 1 1 2\n"), "1 triangle without area"));
    for (const char* vertex :
         {"v nan 0 0\n", "v 0 inf 0\n", "v 0 0 1e999\n", "v 1 2\n", "v a b c\n", "v 1 2 3x\n", "v -Inf 0 0\n"}) {
        EXPECT_TRUE(contains(remarks_of(vertex + std::string("f 1 2 5\n")), "no finite numbers")) << vertex;
    }
    const scene::LoadedMesh loaded = load(folder, square + std::string("vt 0 0\nvn 0 0 0\nf 1/1/1 2/7/1 3/1/8\n"));
    EXPECT_TRUE(contains(all_remarks(loaded), "2 corners named texture coordinates or normals that do not exist"));
    EXPECT_EQ(loaded.mesh->normals[0], glm::vec3(0, 0, 1));
}

TEST(ObjMesh, RefusesInOneSentenceWhatCannotBeShown) {
    const TemporaryFolder folder;
    const auto fault = [&](const std::string& text) { return refusal([&] { load(folder, text); }); };
    EXPECT_TRUE(contains(fault("# nothing\n"), "a.obj: holds no faces"));
    EXPECT_TRUE(contains(fault(square), "holds no faces"));
    EXPECT_TRUE(contains(fault("v 0 0 0\nf 1 1 1\n"), "none of its 1 triangle has an area"));
    EXPECT_TRUE(contains(fault("f 1 2 3\n"), "1 with corners that do not exist"));
    EXPECT_TRUE(contains(fault(std::string("\x4c\x01\0\0\0", 5)), "no text"));
    EXPECT_TRUE(contains(refusal([&] { load_obj_mesh(folder / "none.obj", {}); }), "no such file"));
    scene::MeshSource source;
    source.millimetres_per_unit = 1e12;
    const auto far = folder.write("far.obj", "v 1e38 0 0\nv 2e38 0 0\nv 0 1e38 0\nf 1 2 3\n");
    EXPECT_TRUE(contains(refusal([&] { load_obj_mesh(far, source); }), "too large for single precision"));
    std::string polygon = "f";
    std::string vertices;
    for (int n = 0; n < 9000; ++n) {
        vertices += fmt::format("v {} {} 0\n", n, n % 2 == 0 ? 0.0 : 0.4);
        polygon += fmt::format(" {}", n + 1);
    }
    // No polygon is too large to be cut.
    EXPECT_EQ(load(folder, vertices + "v 4500 9999 0\n" + polygon + " 9001\n").mesh->triangles.size(), 8999U);
}

TEST(ObjMesh, NormalsOfTheFileAreKeptCompletedOrReplaced) {
    const TemporaryFolder folder;
    const std::string text = square + std::string("vn 0 3 4\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//2 4\n");
    const scene::LoadedMesh kept = load(folder, text);
    // Position 3 carries two normals, position 4 a computed one.
    EXPECT_EQ(kept.mesh->positions.size(), 5U);
    EXPECT_EQ(kept.mesh->normals[0], glm::vec3(0.0F, 0.6F, 0.8F));
    EXPECT_EQ(kept.mesh->normals.back(), glm::vec3(0, 0, 1));
    scene::MeshSource source;
    source.normals = scene::MeshNormals::computed;
    const scene::LoadedMesh computed = load_obj_mesh(folder / "a.obj", source);
    EXPECT_EQ(computed.mesh->positions.size(), 4U);
    EXPECT_EQ(computed.mesh->normals[0], glm::vec3(0, 0, 1));
    const scene::LoadedMesh opposed = load(folder, square + std::string("vn 0 0 -1\nf 1//1 2//1 3//1\n"));
    EXPECT_TRUE(contains(all_remarks(opposed), "runs against its own normals"));
    EXPECT_EQ(opposed.mesh->normals[0], glm::vec3(0, 0, -1));
}

TEST(ObjMesh, MissingAndBrokenMaterialsAreSaidAndDoneWithout) {
    const TemporaryFolder folder;
    const std::string face = square + std::string("usemtl red\nf 1 2 3\n");
    const auto with = [&](const std::string& library) { return load(folder, "mtllib " + library + "\n" + face); };
    EXPECT_TRUE(contains(all_remarks(with("none.mtl")), "none.mtl does not exist"));
    EXPECT_TRUE(contains(all_remarks(with("none.mtl")), "uses material 'red', which no library describes"));
    EXPECT_EQ(with("none.mtl").mesh->materials.size(), 1U);
    folder.write("empty.mtl", "");
    EXPECT_TRUE(contains(all_remarks(with("empty.mtl")), "is empty"));
    folder.write("broken.mtl", "\x89PNG\nKd 1 0 0\n");
    EXPECT_TRUE(contains(all_remarks(with("broken.mtl")), "describes no material"));
    folder.write("other.mtl", "newmtl blue\nKd 0 0 1\n");
    EXPECT_TRUE(contains(all_remarks(with("other.mtl")), "uses material 'red'"));

    const std::string red =
        "\xef\xbb\xbf# with a mark of UTF-8\r\nnewmtl  red  \r\nKd 0.5 nan 2\r\nKs 1 1 1\r\nNs 1e9\r\n";
    folder.write("my colours.mtl", red);
    for (const char* name :
         {"my colours.mtl", "my\\ colours.mtl", "none.mtl my\\ colours.mtl", ".\\my\\ colours.mtl"}) {
        const scene::LoadedMesh loaded = with(name);
        ASSERT_EQ(loaded.mesh->materials.size(), 1U) << name << all_remarks(loaded);
        EXPECT_EQ(loaded.mesh->materials[0].name, "red") << name;
        EXPECT_EQ(loaded.mesh->materials[0].diffuse, glm::dvec3(0.5, 0.0, 1.0)) << name;
        EXPECT_EQ(loaded.mesh->materials[0].shininess, 1000.0) << name;
    }
    const scene::LoadedMesh mixed =
        load(folder, "mtllib my colours.mtl\n" + std::string(square) + "f 1 2 3\nusemtl red\nf 1 3 4\n");
    ASSERT_EQ(mixed.mesh->materials.size(), 2U);
    EXPECT_EQ(mixed.mesh->triangle_materials, (std::vector<std::uint32_t>{1, 0}));
    EXPECT_EQ(mixed.mesh->materials[1].name, "");
}

TEST(ObjMesh, TellsItsProgressAndStopsWhenAskedTo) {
    const TemporaryFolder folder;
    std::string text = square;
    while (text.size() < (5U << 20)) {
        text += "# a long comment that makes this file longer than a few pieces of reading\n";
    }
    const auto file = folder.write("a.obj", text + "f 1 2 3\n");
    std::vector<double> shares;
    load_obj_mesh(file, {}, [&](double share, std::string_view) { shares.push_back(share); });
    ASSERT_GE(shares.size(), 5U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_LE(shares.back(), 1.0);
    struct Stop {};
    EXPECT_THROW(load_obj_mesh(file, {}, [](double share, std::string_view) { share > 0.5 ? throw Stop{} : void(); }),
                 Stop);
}

TEST(ObjMesh, AMillionPiecesLoadInSeconds) {
    const TemporaryFolder folder;
    std::string text;
    for (int n = 0; n < 1000000; ++n) {
        text += fmt::format("v {0} 0 0\nv {0}.5 0 0\nv {0} 1 0\nf -3 -2 -1\n", n);
    }
    const auto file = folder.write("a.obj", text);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(load_obj_mesh(file, {}).mesh->triangles.size(), 1000000U);
    // 6 s on a busy machine of two cores; a square law would take hours.
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(ObjMesh, EveryNastyFileLoadsOrIsRefusedInOneSentence) {
    if (!data_folder()) {
        GTEST_SKIP() << "BRUMA_DATA does not name a folder with real meshes";
    }
    std::size_t loaded = 0;
    std::vector<std::string> refused;
    for (const auto& entry : std::filesystem::directory_iterator(*data_folder() / "nasty/tinyobj")) {
        if (entry.path().extension() != ".obj") {
            continue;
        }
        const std::string sentence = refusal([&] {
            const scene::LoadedMesh mesh = load_obj_mesh(entry.path(), {});
            ++loaded;
            for (const glm::uvec3& t : mesh.mesh->triangles) {
                EXPECT_LT(std::max({t.x, t.y, t.z}), mesh.mesh->positions.size()) << entry.path();
            }
            for (const glm::vec3& normal : mesh.mesh->normals) {
                EXPECT_NEAR(glm::length(normal), 1.0F, 1e-5F) << entry.path();
            }
            EXPECT_TRUE(std::isfinite(area_mm2(mesh))) << entry.path();
        });
        if (!sentence.empty()) {
            refused.push_back(entry.path().stem().string());
            EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
            EXPECT_TRUE(sentence.starts_with(entry.path().string() + ": ")) << sentence;
        }
    }
    std::sort(refused.begin(), refused.end());
    // Three of faces that name nothing or have two corners, two of lines and points, one without any face.
    EXPECT_EQ(refused, (std::vector<std::string>{"invalid-face-definition", "invalid-relative-texture-index",
                                                 "invalid-relative-vertex-index", "issue-356-leading-spaces-newmtl",
                                                 "line-prim", "points-prim"}));
    EXPECT_EQ(loaded, 41U);
}

}  // namespace
}  // namespace bruma::io
