#include "io/mesh/mesh_texture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/mesh/obj_mesh.h"
#include "io_temporary_folder.h"

namespace bruma::io {
namespace {

std::string big_endian(std::uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

/// A chunk whose checksum is left 0: the decoder does not look at it.
std::string chunk(const std::string& type, const std::string& content) {
    return big_endian(std::uint32_t(content.size())) + type + content + std::string(4, '\0');
}

/// A PNG of stored, that is uncompressed, rows; each row of `rows` begins with its filter, 0.
std::string png(std::uint32_t width, std::uint32_t height, int bits, int color_type, const std::string& rows,
                const std::string& palette = {}) {
    const auto length = std::uint32_t(rows.size());
    const std::string stored = std::string("\x78\x01\x01", 3) + char(length & 255) + char(length >> 8) +
                               char(~length & 255) + char((~length >> 8) & 255) + rows + std::string(4, '\0');
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR",
                 big_endian(width) + big_endian(height) + char(bits) + char(color_type) + std::string(3, '\0')) +
           (palette.empty() ? "" : chunk("PLTE", palette)) + chunk("IDAT", stored) + chunk("IEND", "");
}

TEST(MeshTexture, ReadsGreyPaletteColourAndSixteenBits) {
    const TemporaryFolder folder;
    const auto color = [&](const std::string& bytes, int x) {
        return load_texture(folder.write("t.png", bytes))->linear_color(x, 0);
    };
    // The sRGB curve of IEC 61966-2-1 at 188/255; tolerance of rounding.
    const double linear_188 = 0.50288646;
    EXPECT_NEAR(color(png(2, 1, 8, 0, std::string("\0\xff\xbc", 3)), 1).g, linear_188, 1e-7);
    EXPECT_EQ(color(png(1, 1, 8, 2, std::string("\0\xff\0\xff", 4)), 0), glm::dvec3(1, 0, 1));
    EXPECT_EQ(color(png(2, 1, 8, 3, std::string("\0\1\0", 3), std::string("\0\0\xff\0\xff\0", 6)), 0),
              glm::dvec3(0, 1, 0));
    // One bit a texel: 0b10...
    EXPECT_EQ(color(png(2, 1, 1, 3, std::string("\0\x80", 2), std::string("\xff\0\0\0\0\xff", 6)), 0),
              glm::dvec3(0, 0, 1));
    const auto deep = load_texture(folder.write("d.png", png(2, 1, 16, 0, std::string("\0\xff\xff\x12\x34", 5))));
    EXPECT_EQ(deep->bits, 16);
    EXPECT_EQ(deep->linear_color(0, 0), glm::dvec3(1.0));
    EXPECT_NEAR(deep->linear_color(1, 0).r, std::pow((0x1234 / 65535.0 + 0.055) / 1.055, 2.4), 1e-12);
    EXPECT_EQ(deep->linear_color(99, -5), deep->linear_color(1, 0));
}

TEST(MeshTexture, RefusesWhatIsBrokenOrTooLarge) {
    const TemporaryFolder folder;
    const auto fault = [&](const std::string& bytes) {
        return refusal([&] { load_texture(folder.write("t.png", bytes)); });
    };
    EXPECT_TRUE(contains(fault(png(16385, 1, 8, 0, "")), "16385 x 1 texels, but a texture has at most 16384"));
    EXPECT_TRUE(contains(fault("no picture"), "broken or unknown picture"));
    EXPECT_TRUE(contains(fault(png(4, 4, 8, 0, "abc")), "broken or unknown picture"));
    EXPECT_TRUE(contains(fault(""), "is empty"));
}

TEST(MeshTexture, IsFoundThroughTheMaterialOrSaidToBeMissing) {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "maps");
    folder.write("maps/wood 1.png", png(1, 1, 8, 0, std::string("\0\xff", 2)));
    folder.write("a.mtl", "newmtl wood\nmap_Kd maps\\wood 1.png\nnewmtl none\nmap_Kd gone.png\n");
    const std::string mesh =
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt nan 1\nusemtl wood\nf 1/1 2/2 3/3\n";
    const scene::LoadedMesh loaded = load_obj_mesh(folder.write("a.obj", mesh), {});
    ASSERT_EQ(loaded.mesh->materials.size(), 2U);
    ASSERT_TRUE(loaded.mesh->materials[0].diffuse_texture);
    // No Kd beside a texture: its colours are shown as they are.
    EXPECT_EQ(loaded.mesh->materials[0].diffuse, glm::dvec3(1.0));
    EXPECT_EQ(loaded.mesh->texture_coordinates, (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 0}}));
    EXPECT_FALSE(loaded.mesh->materials[1].diffuse_texture);
    ASSERT_EQ(loaded.remarks.size(), 1U);
    EXPECT_TRUE(contains(loaded.remarks[0], "material 'none' goes without its texture: ")) << loaded.remarks[0];
    EXPECT_TRUE(contains(loaded.remarks[0], "gone.png: no such file")) << loaded.remarks[0];
}

}  // namespace
}  // namespace bruma::io
