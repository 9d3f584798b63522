// Shelf: closed form. Statements of material libraries, as the published format defines them.
#include <gtest/gtest.h>

#include "io/mesh/mtl_material.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

struct Read {
    MtlMaterial read;
    MtlFindings findings;

    const scene::MeshMaterial& material() const { return read.material; }
    std::string remarks() const {
        std::string all;
        for (const std::string& remark : remarks_of(findings)) {
            all += remark + "\n";
        }
        return all;
    }
};

/// One material of these lines.
Read read(const std::string& lines) {
    const MtlText text = split_mtl_text("newmtl a\n" + lines);
    Read result;
    result.read = read_mtl_material(text.materials.at(0), result.findings);
    return result;
}

TEST(Mtl, AnExponentOfZeroIsNoHighlight) {
    // As Blender writes faces without a material, and MeshLab all of them.
    for (const char* illumination : {"", "illum 2\n", "illum 3\n"}) {
        const Read rough = read(std::string("Kd .2 .2 .2\nKs .9 .9 .9\nNs 0\n") + illumination);
        EXPECT_EQ(rough.material().diffuse, glm::dvec3(0.2));
        EXPECT_EQ(rough.material().specular, glm::dvec3(0.0)) << illumination;
        EXPECT_TRUE(contains(rough.remarks(), "Ks without an exponent Ns above 0 (no highlight) of 1 material"))
            << rough.remarks();
    }
    EXPECT_EQ(read("Ks 1 1 1\n").material().specular, glm::dvec3(0.0)) << "no exponent at all";
    const Read shiny = read("Kd 0 0 0\nKs .9 .8 .7\nNs 0.5\nillum 2\n");
    EXPECT_EQ(shiny.material().specular, glm::dvec3(0.9, 0.8, 0.7));
    EXPECT_EQ(shiny.material().shininess, 0.5);
    EXPECT_EQ(shiny.remarks(), "");
}

TEST(Mtl, IlluminationModelsAreThoseOfTheFormat) {
    const std::string colors = "Kd .2 .3 .4\nKs .9 .9 .9\nNs 200\n";
    const Read constant = read(colors + "illum 0\n");
    EXPECT_TRUE(constant.material().constant);
    EXPECT_EQ(constant.material().specular, glm::dvec3(0.0));
    const Read diffuse = read(colors + "illum 1\n");
    EXPECT_FALSE(diffuse.material().constant);
    EXPECT_EQ(diffuse.material().specular, glm::dvec3(0.0));
    EXPECT_EQ(diffuse.remarks(), "") << "Ks is not used, as the format says";
    for (const char* number : {"illum 2\n", ""}) {
        const Read shiny = read(colors + number);
        EXPECT_EQ(shiny.material().specular, glm::dvec3(0.9)) << number;
        EXPECT_EQ(shiny.material().shininess, 200.0);
        EXPECT_EQ(shiny.remarks(), "");
    }
    for (int n = 3; n <= 9; ++n) {
        const Read more = read(colors + "illum " + std::to_string(n) + "\n");
        EXPECT_EQ(more.material().specular, glm::dvec3(0.9)) << n;
        EXPECT_TRUE(contains(more.remarks(), "(reflection or refraction: drawn as 2) of 1 material")) << n;
    }
    EXPECT_TRUE(contains(read("illum 10\n").remarks(), "illum 10 (an invisible surface"));
    EXPECT_TRUE(contains(read("illum 11\n").remarks(), "illum 11 (unknown"));
    EXPECT_TRUE(contains(read("illum two\n").remarks(), "line 2, 'illum two'"));
}

TEST(Mtl, ColorsAreReadAsTheFormatWritesThem) {
    const auto diffuse = [](const std::string& text) { return read("Kd " + text + "\n").material().diffuse; };
    EXPECT_EQ(diffuse("0.5 0.25 1"), glm::dvec3(0.5, 0.25, 1.0));
    EXPECT_EQ(diffuse("0.5"), glm::dvec3(0.5)) << "the others are the first";
    EXPECT_EQ(diffuse("+.5 1. 1e-1 # red"), glm::dvec3(0.5, 1.0, 0.1));
    EXPECT_EQ(diffuse("spectral ident.rfl"), glm::dvec3(1.0));
    EXPECT_EQ(diffuse("spectral ident.rfl 0.25"), glm::dvec3(0.25));
    EXPECT_EQ(diffuse("spectral tin.rfl 1"), glm::dvec3(0.8)) << "the default";
    EXPECT_TRUE(contains(read("Kd spectral tin.rfl 1\n").remarks(), "Kd spectral (a curve in a .rfl file)"));
    // White of D65 is white; four digits in the matrix.
    const glm::dvec3 white = diffuse("xyz 0.9505 1.0 1.0890");
    EXPECT_NEAR(white.r, 1.0, 5e-4);
    EXPECT_NEAR(white.g, 1.0, 5e-4);
    EXPECT_NEAR(white.b, 1.0, 5e-4);
    // In other capitals.
    EXPECT_EQ(read("kd 0 1 0\n").material().diffuse, glm::dvec3(0, 1, 0));
    // None at all.
    EXPECT_EQ(read("Ka 0 0 0\n").material().diffuse, glm::dvec3(0.8));
    EXPECT_EQ(read("map_Kd a.png\n").material().diffuse, glm::dvec3(1.0));
    EXPECT_EQ(read("map_Kd a.png\nKd 0 0 0\n").material().diffuse, glm::dvec3(0.0));
}

TEST(Mtl, CommasPartNumbersOrAreDecimal) {
    EXPECT_EQ(read("Kd 0,9 0,1 0,1\n").material().diffuse, glm::dvec3(0.9, 0.1, 0.1));
    EXPECT_TRUE(contains(read("Kd 0,9 0,1 0,1\n").remarks(), "decimal commas (line 2, 'Kd 0,9 0,1 0,1')"));
    EXPECT_EQ(read("Kd 0,9\n").material().diffuse, glm::dvec3(0.9));
    for (const char* parted : {"0.9,0.1,0.1", "0.9, 0.1, 0.1", "0.9,0.1 0.1"}) {
        EXPECT_EQ(read(std::string("Kd ") + parted + "\n").material().diffuse, glm::dvec3(0.9, 0.1, 0.1)) << parted;
        EXPECT_EQ(read(std::string("Kd ") + parted + "\n").remarks(), "") << parted;
    }
    EXPECT_EQ(read("Kd 1,0,1\n").material().diffuse, glm::dvec3(1, 0, 1));
    EXPECT_EQ(read("Kd 1, 0, 1\n").material().diffuse, glm::dvec3(1, 0, 1));
}

TEST(Mtl, NumbersThatAreNoneOrTooLargeAreSaid) {
    const Read word = read("Kd red\nNs high\nKs 1 2 nan\n");
    EXPECT_EQ(word.material().diffuse, glm::dvec3(0.8)) << "the default";
    EXPECT_TRUE(contains(word.remarks(), "3 statements without the numbers or the name that belong there"));
    EXPECT_TRUE(contains(word.remarks(), "line 2, 'Kd red'"));
    const Read bright = read("Kd 255 128 0\n");
    EXPECT_EQ(bright.material().diffuse, glm::dvec3(1, 1, 0));
    EXPECT_TRUE(contains(bright.remarks(), "colours beyond 0 to 1 or exponents beyond 1000 of 1 material"));
    EXPECT_EQ(read("Ks 1 1 1\nNs 1e9\n").material().shininess, 1000.0);
    EXPECT_TRUE(contains(read("Kd -1 0 0\n").remarks(), "were limited"));
}

TEST(Mtl, LightOfItsOwnIsEmission) {
    const Read lamp = read("Kd .5 .5 .5\nKe 17 12 4\n");
    EXPECT_EQ(lamp.material().emission, glm::dvec3(17, 12, 4));
    EXPECT_TRUE(contains(lamp.remarks(), "Ke (light of its own: it lights nothing else) of 1 material"));
    EXPECT_EQ(read("Kd 1 1 1\nKe 0 0 0\n").remarks(), "");
    // A map would say where it shines; all of it would be wrong.
    const Read mapped = read("Ke 1 1 1\nmap_Ke screen.png\n");
    EXPECT_EQ(mapped.material().emission, glm::dvec3(0.0));
    EXPECT_TRUE(contains(mapped.remarks(), "map_Ke (map of light of its own) of 1 material"));
}

TEST(Mtl, WhatIsNotDrawnIsSaidAndWhatChangesNothingIsNot) {
    const auto said = [](const std::string& lines) { return read(lines).remarks(); };
    EXPECT_TRUE(contains(said("d 0.5\n"), "tells more than is drawn: d (opacity: drawn opaque) of 1 material"));
    EXPECT_TRUE(contains(said("d -halo 0.5\n"), "d -halo"));
    EXPECT_TRUE(contains(said("Tr 0.5\n"), "Tr (transparency: drawn opaque)"));
    EXPECT_EQ(said("d 0.75\nTr 0.25\n"), said("d 0.75\n")) << "one and the same";
    EXPECT_EQ(said("d 1\nTr 1\n"), "") << "two readings of Tr; d is the published statement";
    EXPECT_EQ(said("d 1.0\nTr 0.0\nTf 1 1 1\nKe 0 0 0\nNi 1\nPm 0\naniso 0\nKa 0 0 0\nKa .2 .2 .2\nKd .2 .2 .2\n"), "");
    EXPECT_EQ(said("Ni 1.5\nTf .5 .5 .5\nillum 2\n"), "") << "models up to 3 know no refraction";
    EXPECT_TRUE(contains(said("Ni 1.5\nTf .5 .5 .5\nillum 6\n"), "Ni (index of refraction) of 1 material, Tf"));
    EXPECT_TRUE(contains(said("Kd 1 0 0\nKa 1 1 1\n"), "Ka (ambient light: Kd reflects it)"));
    for (const char* statement :
         {"bump",   "map_bump", "map_Bump", "norm",    "disp",      "decal",  "refl", "map_Ka",  "map_Ks",
          "map_Ns", "map_d",    "map_Ke",   "map_aat", "sharpness", "Pr",     "Pm",   "Ps",      "Pc",
          "Pcr",    "aniso",    "anisor",   "map_Pr",  "map_Pm",    "map_Ps", "Kt",   "nonsense"}) {
        EXPECT_TRUE(contains(said(std::string(statement) + " 0.5\n"), "of 1 material")) << statement;
    }
    EXPECT_TRUE(contains(said("nonsense 1\n"), "nonsense (unknown) of 1 material"));
}

TEST(Mtl, TheSameIsSaidOncePerLibraryWithItsCount) {
    const MtlText text = split_mtl_text(
        "\xef\xbb\xbfnewmtl a\rd 0.5\r\r\nnewmtl b # the roof\n\td .5\n\tbump x.png\nnewmtl\nd 0.1\nnewmtl c\nd 1\n");
    ASSERT_EQ(text.materials.size(), 3U);
    EXPECT_EQ(text.without_name, 1U);
    EXPECT_EQ(text.materials[0].statements[0].line, 2U);
    MtlFindings findings;
    for (const MtlEntry& entry : text.materials) {
        read_mtl_material(entry, findings);
    }
    EXPECT_EQ(remarks_of(findings),
              (std::vector<std::string>{"tells more than is drawn: d (opacity: drawn opaque) of 2 materials, "
                                        "bump (bump map) of 1 material"}));
}

TEST(MtlMap, OptionsAndNamesAreParted) {
    const auto names = [](const std::string& text) { return read_mtl_map(text).names; };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names("wood.png"), Names{"wood.png"});
    EXPECT_EQ(names("wood 01.png"), Names{"wood 01.png"});
    EXPECT_EQ(names("-s 2 2 2 -o .5 wood.png"), Names{"wood.png"});
    EXPECT_EQ(names("-o 1 2 3.png"), Names{"3.png"});
    EXPECT_EQ(names("-o 1 2 3"), Names{"3"}) << "a name must be left";
    EXPECT_EQ(names("-blendu on -cc off -texres 512 a.png"), Names{"a.png"});
    EXPECT_EQ(names("a.png # the floor"), (Names{"a.png # the floor", "a.png"}));
    EXPECT_EQ(names("a-b -c.png"), Names{"a-b -c.png"});
    EXPECT_EQ(names("a.png -s 2 3 -t 1"), (Names{"a.png -s 2 3 -t 1", "a.png"}));
    EXPECT_EQ(read_mtl_map("a.png -s 2 3 -t 1").placement.scale, glm::dvec2(2, 3));
    EXPECT_TRUE(names("").empty());
    EXPECT_TRUE(names("-clamp on").empty());
}

TEST(MtlMap, PlacementsAreReadAndOtherOptionsNamed) {
    const MtlMap map = read_mtl_map("-s 2 3 1 -o 0.25 -.5 0 -clamp on -mm 0.1 0,5 -t 0 0 0 -blendu on a.png");
    EXPECT_EQ(map.placement.scale, glm::dvec2(2, 3));
    EXPECT_EQ(map.placement.offset, glm::dvec2(0.25, -0.5));
    EXPECT_TRUE(map.placement.once);
    EXPECT_EQ(map.placement.base, 0.1);
    EXPECT_EQ(map.placement.gain, 0.5);
    EXPECT_TRUE(map.unused_options.empty());
    EXPECT_EQ(read_mtl_map("-s 2 a.png").placement.scale, glm::dvec2(2, 1));
    EXPECT_EQ(read_mtl_map("-t 1 1 1 -blendu off -blendv off -texres 64 -boost 2 -cc on -imfchan r -bm 2 a.png")
                  .unused_options,
              (std::vector<std::string>{"-t", "-blendu", "-blendv", "-texres", "-boost", "-cc", "-imfchan", "-bm"}));
    EXPECT_TRUE(contains(read("map_Kd -t 1 a.png\n").remarks(), "map_Kd -t (option of the texture) of 1 material"));
}

}  // namespace
}  // namespace bruma::io
