// Shelf: closed form. What an OBJ file and its libraries name is found, and what they tell in vain is said.
#include "io/mesh/obj_materials.h"

#include <gtest/gtest.h>

#include <fmt/core.h>

#include "io/mesh/obj_mesh.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
constexpr const char* face = "f 1/1 2/2 3/3 4/4\n";

/// An uncompressed TARGA picture of one texel.
std::string targa(const std::string& bgra) {
    return std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0", 16) + char(8 * bgra.size()) + '\x28' + bgra;
}

std::string all(const std::vector<std::string>& remarks) {
    std::string text;
    for (const std::string& remark : remarks) {
        text += remark + "\n";
    }
    return text;
}

/// The mesh of `a.obj` whose only material's library has these lines.
scene::LoadedMesh with_material(const TemporaryFolder& folder, const std::string& lines) {
    folder.write("a.mtl", "newmtl m\n" + lines + "\n");
    return load_obj_mesh(folder.write("a.obj", std::string("mtllib a.mtl\nusemtl m\n") + square + face), {});
}

TEST(ObjMaterials, TexturesAreFoundHoweverTheyAreTold) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "maps");
    folder.write("maps/Wood.tga", targa("\1\2\3"));
    folder.write("flat wood.tga", targa("\1\2\3"));
    for (const char* told :
         {"maps/Wood.tga", "./maps/Wood.tga", "maps\\Wood.tga", "\"maps/Wood.tga\"", "'maps\\Wood.tga'",
          "maps/Wood.tga # of the floor", "-s 2 2 maps/Wood.tga", "flat wood.tga", "flat\\ wood.tga"}) {
        const scene::LoadedMesh loaded = with_material(folder, std::string("map_Kd ") + told);
        EXPECT_TRUE(loaded.mesh->materials[0].diffuse_texture) << told << all(loaded.remarks);
        EXPECT_EQ(all(loaded.remarks), "") << told;
    }
    for (const char* told : {"MAPS/wood.TGA", "C:\\Users\\me\\maps\\Wood.tga", "/home/me/maps/wood.tga",
                             "D:\\art\\flat wood.tga", "textures/Flat Wood.tga", "file:///C:/x/flat%20wood.tga"}) {
        const scene::LoadedMesh loaded = with_material(folder, std::string("map_Kd ") + told);
        if (contains(told, "%20")) {
            EXPECT_FALSE(loaded.mesh->materials[0].diffuse_texture);
            EXPECT_TRUE(contains(all(loaded.remarks), "material 'm' goes without its texture: ")) << told;
            continue;
        }
        EXPECT_TRUE(loaded.mesh->materials[0].diffuse_texture) << told << all(loaded.remarks);
        EXPECT_TRUE(contains(all(loaded.remarks), "1 texture is not where or not spelt as told, and taken from "))
            << told << all(loaded.remarks);
    }
}

TEST(ObjMaterials, ATextureToldTwiceIsLoadedOnce) {
    const TemporaryFolder folder;
    folder.write("t.tga", targa("\1\2\3"));
    folder.write("b.mtl", "newmtl n\nmap_Kd ./t.tga\nnewmtl o\nmap_Kd T.TGA\n");
    folder.write("a.mtl", "newmtl m\nmap_Kd t.tga\n");
    const auto materials =
        read_obj_materials(folder.write("a.obj", std::string(square) + face), {"a.mtl", "b.mtl", "./a.mtl"});
    ASSERT_EQ(materials.materials.size(), 3U);
    EXPECT_EQ(materials.materials[0].diffuse_texture, materials.materials[1].diffuse_texture);
    EXPECT_EQ(materials.materials[0].diffuse_texture, materials.materials[2].diffuse_texture);
}

TEST(ObjMaterials, WhatCannotBeLoadedIsSaidOnceAndTheMeshIsThere) {
    const TemporaryFolder folder;
    folder.write("broken.dds", "DDS |....");
    std::string lines;
    for (int n = 0; n < 5; ++n) {
        lines += fmt::format("newmtl gone{}\nmap_Kd gone{}.png\nnewmtl broken{}\nmap_Kd broken.dds\n", n, n, n);
    }
    folder.write("b.mtl", lines);
    const scene::LoadedMesh loaded =
        load_obj_mesh(folder.write("b.obj", std::string("mtllib b.mtl\nusemtl gone0\n") + square + face), {});
    EXPECT_EQ(loaded.mesh->triangles.size(), 2U);
    ASSERT_EQ(loaded.remarks.size(), 2U) << all(loaded.remarks);
    EXPECT_TRUE(contains(loaded.remarks[0], "material 'broken0' goes without its texture: ")) << loaded.remarks[0];
    EXPECT_TRUE(
        contains(loaded.remarks[1], "materials 'gone0', 'gone1', 'gone2' and 2 more go without their textures: "))
        << loaded.remarks[1];
}

TEST(ObjMaterials, LibrariesAreFoundHoweverTheyAreTold) {
    const TemporaryFolder folder;
    folder.write("Red.mtl", "newmtl red # as the roof\nKd 1 0 0\n");
    folder.write("my blue.mtl", "newmtl blue\nKd 0 0 1\n");
    const auto read = [&](const std::string& line) { return read_obj_materials(folder / "a.obj", {line}); };
    for (const char* told :
         {"Red.mtl", "\"Red.mtl\"", "Red.mtl # colours", "red.MTL", "C:\\me\\Red.mtl", "./Red.mtl"}) {
        EXPECT_TRUE(read(told).find("red")) << told << all(read(told).remarks);
    }
    for (const char* told : {"my blue.mtl", "\"my blue.mtl\"", "my\\ blue.mtl", "MY Blue.mtl", "D:\\x\\my blue.mtl",
                             "my blue.mtl # comment"}) {
        EXPECT_TRUE(read(told).find("blue")) << told << all(read(told).remarks);
    }
    const ObjMaterials both = read("Red.mtl none.mtl my\\ blue.mtl");
    EXPECT_TRUE(both.find("red"));
    EXPECT_TRUE(both.find("blue # of the sky")) << "a comment behind usemtl";
    ASSERT_EQ(both.remarks.size(), 1U);
    EXPECT_TRUE(contains(both.remarks[0], "none.mtl does not exist"));
    EXPECT_EQ(read("gone blue.mtl").remarks.size(), 1U) << "one line, one sentence";
    EXPECT_TRUE(contains(all(read("red.MTL").remarks), "told as 'red.MTL' and taken from "));
}

TEST(ObjMaterials, ASymbolicLinkLeadsToItsLibraryAndTextures) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "real");
    folder.write("real/a.mtl", "newmtl m\nmap_Kd t.tga\n");
    folder.write("real/t.tga", targa("\1\2\3"));
    folder.write("real/a.obj", std::string("mtllib a.mtl\nusemtl m\n") + square + face);
    fs::create_symlink(folder / "real/a.obj", folder / "link.obj");
    const scene::LoadedMesh loaded = load_obj_mesh(folder / "link.obj", {});
    EXPECT_EQ(all(loaded.remarks), "");
    EXPECT_TRUE(loaded.mesh->materials.at(0).diffuse_texture);
}

TEST(ObjMaterials, TransparencyOfTexturesAndRepeatedNamesAreSaid) {
    const TemporaryFolder folder;
    folder.write("leaf.tga", targa(std::string("\1\2\3\0", 4)));
    folder.write("leaf2.tga", targa("\1\2\3\xff"));
    const scene::LoadedMesh leaf = with_material(folder, "map_Kd leaf.tga\nnewmtl m\nKd 1 0 0");
    EXPECT_TRUE(contains(all(leaf.remarks), "1 texture with transparent texels, which are drawn opaque: "))
        << all(leaf.remarks);
    EXPECT_TRUE(contains(all(leaf.remarks), "describes material 'm' more than once; the first one counts"));
    EXPECT_EQ(all(with_material(folder, "map_Kd leaf2.tga").remarks), "");
}

TEST(ObjMaterials, ColoursBehindVerticesAreFactorsOfTheDiffuseColour) {
    const TemporaryFolder folder;
    const auto colors = [&](const std::string& text) {
        return load_obj_mesh(folder.write("c.obj", text), {}).mesh->colors;
    };
    const std::vector<glm::vec3> three{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    EXPECT_EQ(colors("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n"), three);
    EXPECT_EQ(colors("v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 0 0 255\nf 1 2 3\n"), three) << "bytes";
    EXPECT_EQ(colors("v 0 0 0 1 0 0 1\nv 1 0 0 0 1 0 1\nv 0 1 0 0 0 1 1\nf 1 2 3\n"), three) << "with alpha";
    EXPECT_EQ(colors("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n")[1], glm::vec3(1.0F)) << "one without";
    EXPECT_TRUE(colors("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").empty()) << "weights";
    // The sRGB curve of IEC 61966-2-1 at 188/255; rounded to a float.
    EXPECT_NEAR(colors("v 0 0 0 188 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n")[0].r, 0.50288646F, 1e-6F);
    // Two colours at one place.
    EXPECT_EQ(colors("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nv 0 0 0 0 0 1\nv 1 0 0 0 0 1\nv 0 -1 0 0 0 1\n"
                     "f 1 2 3\nf 4 6 5\n")
                  .size(),
              6U);
}

TEST(ObjMesh, TexturesWithoutCoordinatesAreSaid) {
    const TemporaryFolder folder;
    folder.write("t.tga", targa("\1\2\3"));
    folder.write("a.mtl", "newmtl m\nmap_Kd t.tga\nnewmtl plain\nKd 1 1 1\n");
    const auto said = [&](const std::string& name) {
        return all(
            load_obj_mesh(
                folder.write("a.obj", "mtllib a.mtl\nusemtl " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), {})
                .remarks);
    };
    EXPECT_TRUE(
        contains(said("m"), "has no texture coordinates (vt), so the textures of its materials cannot be laid"));
    EXPECT_EQ(said("plain"), "");
}

TEST(ObjMesh, StatementsThatAreNotDrawnAreSaidOnce) {
    const TemporaryFolder folder;
    const auto said = [&](const std::string& lines) {
        return all(load_obj_mesh(folder.write("s.obj", square + lines + face), {}).remarks);
    };
    EXPECT_EQ(said("g a\no b\n# s 1\nusemtl\n"), said("usemtl\n")) << "groups are drawn";
    EXPECT_TRUE(contains(said("l 1 2\nl 2 3\np 1\n"), "s.obj: tells more than is drawn: lines (l 2), points (p 1)\n"));
    EXPECT_TRUE(contains(said("vp 0.1\ncstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n"),
                         "free-form curves and surfaces (vp 1, cstype 1, deg 1, curv 1, parm 1, end 1)"));
    EXPECT_TRUE(
        contains(said("s 1\ns off\ns 2\ns 0\n"), "smoothing groups, where edges are smoothed by their angle (s 2)"));
    EXPECT_EQ(said("s off\n s 0\n"), "");
    EXPECT_EQ(said("vn 0 0 1\ns 1\n"), "") << "normals say it";
    for (const char* statement :
         {"vp",     "bmat",  "step",     "curv2",    "surf", "trim",       "hole",      "scrv",  "sp",    "con",
          "mg",     "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj", "ctech", "stech", "maplib",
          "usemap", "call",  "csh",      "bsp",      "bzp",  "cdc",        "cdp",       "res",   "fo",    "#MRGB"}) {
        const std::string sentence = said(std::string(statement) + " 1\n");
        EXPECT_TRUE(contains(sentence, std::string("(") + statement + " 1)")) << statement << ": " << sentence;
        EXPECT_FALSE(contains(sentence, "unknown")) << statement;
    }
    EXPECT_TRUE(contains(said("nonsense 1\n"), "unknown statements (nonsense 1)"));
}

}  // namespace
}  // namespace bruma::io
