#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/mesh/mesh_texture.h"
#include "io/picture/picture_file.h"
#include "io/picture/weather_file.h"
#include "io_picture_samples.h"
#include "io_temporary_folder.h"

// Every door at which pictures come in against every sort of picture: it is read right, or refused in a sentence.
// All files are called t.png, since only their content counts.
namespace bruma::io {
namespace {

using namespace samples;

/// A door, by its name in the messages of a failing test.
struct Door {
    const char* name;
    std::function<void(const std::filesystem::path&)> read;
};
const Door doors[]{{"texture", [](const auto& path) { load_texture(path); }},
                   {"weather", [](const auto& path) { load_weather_map(path); }},
                   {"compare", [](const auto& path) { read_picture(path); }}};

std::vector<std::uint8_t> texels(const TemporaryFolder& folder, const std::string& bytes) {
    const auto texture = load_texture(folder.write("t.png", bytes));
    std::vector<std::uint8_t> values(texture->texels.size());
    std::transform(texture->texels.begin(), texture->texels.end(), values.begin(),
                   [](std::byte value) { return std::uint8_t(value); });
    return values;
}

using Bytes = std::vector<std::uint8_t>;

TEST(PictureKinds, SixteenBitNetpbmIsReadAtEveryDoor) {
    const TemporaryFolder folder;
    for (const int size : {64, 512}) {
        const std::string side = std::to_string(size);
        std::string bytes = "P6\n# deep\n" + side + " " + side + "\n65535\n";
        for (int n = 0; n < size * size; ++n) {
            bytes += big(0xFFFF, 2) + big(0x8000, 2) + big(std::uint64_t(n) & 0xFFFF, 2);
        }
        const auto file = folder.write("t.png", bytes);
        const auto texture = load_texture(file);
        EXPECT_EQ(texture->bits, 16);
        EXPECT_EQ(texture->linear_color(0, 0).r, 1.0);
        EXPECT_NEAR(texture->linear_color(3, 0).g, linear_of_srgb(0x8000 / 65535.0), 1e-7);
        EXPECT_NEAR(texture->linear_color(size - 1, 0).b, linear_of_srgb((size - 1) / 65535.0), 1e-7);
        const auto map = load_weather_map(file);
        EXPECT_EQ(map->rgba[0], 255);
        EXPECT_EQ(map->rgba[1], 128);
        EXPECT_EQ(map->rgba[3], 128) << "without alpha, density is neutral";
        EXPECT_NEAR(read_picture(file).rgba[1], linear_of_srgb(0x8000 / 65535.0), 1e-6);
    }
}

TEST(PictureKinds, EightBitKindsAreReadAsTheyStand) {
    const TemporaryFolder folder;
    EXPECT_EQ(texels(folder, "P5 2 1 255 " + std::string("\x10\x20")), (Bytes{16, 16, 16, 255, 32, 32, 32, 255}));
    EXPECT_EQ(texels(folder, "P3 1 1 15 15 0 3"), (Bytes{255, 0, 51, 255}));
    EXPECT_EQ(texels(folder, "P1 3 1 101"), (Bytes{0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 255}));
    EXPECT_EQ(texels(folder, "P4 2 1 " + std::string("\x40")), (Bytes{255, 255, 255, 255, 0, 0, 0, 255}));
    // Blue, green, red; rows from the bottom, each filled up to four bytes.
    EXPECT_EQ(texels(folder, bmp(1, 2, 24, "", std::string("\1\2\3\0\4\5\6\0", 8))),
              (Bytes{6, 5, 4, 255, 3, 2, 1, 255}));
    EXPECT_EQ(texels(folder, bmp(3, 1, 4, std::string("\0\0\0\0\3\2\1\0", 8), std::string("\1\1\0\0", 4))),
              (Bytes{0, 0, 0, 255, 1, 2, 3, 255, 0, 0, 0, 255}));
    EXPECT_EQ(texels(folder, bmp(1, 1, 16, "", std::string("\x1f\x7c\0\0", 4))), (Bytes{255, 0, 255, 255}));
    EXPECT_EQ(texels(folder, tga(2, 1, 1, 32, "\x1\x2\x3\x4")), (Bytes{3, 2, 1, 4}));
    EXPECT_EQ(texels(folder, tga(3, 1, 1, 16, "\x7\x9")), (Bytes{7, 7, 7, 9}));
    // A run of two, then one as it is.
    EXPECT_EQ(texels(folder, tga(11, 3, 1, 8, std::string("\x81\x5\0\x6", 4))),
              (Bytes{5, 5, 5, 255, 5, 5, 5, 255, 6, 6, 6, 255}));
    EXPECT_EQ(texels(folder, tga(1, 2, 1, 8, std::string("\1\0", 2), "\1\2\3\4\5\6")),
              (Bytes{6, 5, 4, 255, 3, 2, 1, 255}));
    // A pixel of a palette that is shorter than the pixels think is black; one of grey and alpha keeps both.
    EXPECT_EQ(texels(folder, png(2, 1, 8, 3, std::string("\0\0\7", 3), "\1\2\3")), (Bytes{1, 2, 3, 255, 0, 0, 0, 255}));
    EXPECT_EQ(texels(folder, png(1, 1, 8, 4, std::string("\0\x10\x20", 3))), (Bytes{16, 16, 16, 32}));
}

TEST(PictureKinds, WhatIsNotReadIsNamedAtEveryDoor) {
    const TemporaryFolder folder;
    const std::pair<std::string, const char*> cases[]{
        {"GIF89a" + noise(100), "a GIF picture"},
        {"8BPS" + zeros(100), "a Photoshop picture"},
        {"\x53\x80\xf6\x34" + zeros(200), "a Softimage PIC picture"},
        {"II*" + zeros(100), "a TIFF picture"},
        {"RIFF" + zeros(4) + "WEBPVP8 " + zeros(100), "a WebP picture"},
        {"DDS " + zeros(124), "a DDS texture"},
        {"<svg></svg>", "an SVG drawing"},
        {"PF\n1 1\n-1\n" + zeros(12), "a floating-point PFM picture"},
        {bmp(16, 16, 8, zeros(1024), noise(256), 1), "its pixels are packed"},
        {"\x89PNG\r\n\x1a\n" + png_chunk("CgBI", zeros(4)), "telephones"},
    };
    for (const auto& [bytes, what] : cases) {
        const auto file = folder.write("t.png", bytes);
        for (const Door& door : doors) {
            const std::string sentence = refusal([&] { door.read(file); });
            EXPECT_TRUE(contains(sentence, what) && contains(sentence, "convert it to .png")) << door.name << sentence;
        }
    }
    for (const std::string& light : {radiance_runs(16, 9), exr(16, 9)}) {
        const auto file = folder.write("t.png", light);
        EXPECT_EQ(read_picture(file).width, 16);
        for (const Door& door : {doors[0], doors[1]}) {
            EXPECT_TRUE(contains(refusal([&] { door.read(file); }), "floating-point light")) << door.name;
        }
    }
}

TEST(PictureKinds, ASizeOfZeroIsRefused) {
    const TemporaryFolder folder;
    for (const std::string& bytes :
         {bmp(0, 4, 24, "", noise(64)), bmp(4, 0, 24, "", noise(64)), tga(2, 0, 4, 24, noise(64)),
          tga(10, 4, 0, 24, noise(64)), png(0, 4, 8, 2, png_rows(4, 12)), png(4, 0, 8, 2, png_rows(4, 12)),
          "P6 0 4 255 " + noise(64), radiance(0, 4, noise(64))}) {
        for (const Door& door : doors) {
            EXPECT_NE(refusal([&] { door.read(folder.write("t.png", bytes)); }), "") << door.name;
        }
    }
}

// No door takes a file that ends early, however much of it is there.
TEST(PictureKinds, EveryBeginningOfAFileIsRefused) {
    const TemporaryFolder folder;
    const std::string wholes[]{png(9, 8, 8, 2, png_rows(8, 27)),
                               png(9, 8, 16, 6, png_rows(8, 72)),
                               bmp(8, 8, 24, "", noise(192)),
                               bmp(8, 8, 32, "", noise(256)),
                               tga(2, 8, 8, 24, noise(192)),
                               tga(10, 8, 8, 24, std::string("\xbf\1\2\3", 4)),
                               "P6 8 8 65535 " + noise(384),
                               radiance(8, 8, noise(256)),
                               radiance_runs(8, 8),
                               exr(8, 8),
                               exr(8, 8, 3)};
    for (const std::string& whole : wholes) {
        EXPECT_NO_THROW(read_picture(folder.write("t.png", whole)));
        // Behind the pixels of a PNG there is nothing but its end mark's checksum.
        const std::size_t longest = whole.starts_with("\x89PNG") ? whole.size() - 4 : whole.size();
        // Every one within the header, some among the pixels, and all but the last byte.
        for (std::size_t length = 1; length < longest; length = length < 64 ? length + 1
                                                                : length == longest - 1
                                                                    ? longest
                                                                    : std::min(length + 29, longest - 1)) {
            const auto file = folder.write("t.png", whole.substr(0, length));
            for (const Door& door : doors) {
                EXPECT_NE(refusal([&] { door.read(file); }), "") << door.name << " took " << length << " bytes";
            }
        }
    }
}

TEST(PictureKinds, ASizeThatTheBytesCannotHoldIsRefusedBeforeMemoryIsTaken) {
    const TemporaryFolder folder;
    for (const std::string& bytes :
         {png(16384, 16384, 8, 6, png_rows(1, 64)), bmp(16384, 16384, 24, "", noise(64)),
          bmp(0x7fffffff, 0x80000000, 32, "", noise(64)), tga(10, 16384, 16384, 24, noise(64)),
          "P6 16000 16000 65535 " + noise(64), radiance(16384, 16384, noise(64)),
          exr(8, 8).replace(exr(8, 8).find("box2i") + 18, 8, little(0xffffff, 4) + little(0xffffff, 4))}) {
        for (const Door& door : doors) {
            EXPECT_NE(refusal([&] { door.read(folder.write("t.png", bytes)); }), "") << door.name;
        }
    }
}

TEST(Radiance, RunsOfBothAgesAndBothOrdersOfRows) {
    const TemporaryFolder folder;
    const Image runs = read_picture(folder.write("t.hdr", radiance_runs(16, 3)));
    // 2^(129 - 136) a step: the value in row y is 16 y + component.
    EXPECT_EQ(runs.pixel(15, 2)[1], 33.0F / 128.0F);
    EXPECT_EQ(runs.pixel(0, 0)[3], 1.0F);
    const std::string one("\x40\x20\x10\x81", 4);
    const Image old = read_picture(folder.write("t.hdr", radiance(7, 1, one + std::string("\1\1\1\6", 4))));
    EXPECT_EQ(old.pixel(6, 0)[0], 0.5F);
    const std::string up = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n+Y 2 +X 1\n" + one + zeros(4);
    EXPECT_EQ(read_picture(folder.write("t.hdr", up)).pixel(0, 1)[0], 0.5F);
    const std::string hangs = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n" + std::string("\2\2\0\x08", 4);
    EXPECT_TRUE(contains(refusal([&] { read_picture(folder.write("t.hdr", hangs)); }), "ends at byte"));
}

TEST(OpenExr, RowsTilesAndGreyAreRead) {
    const TemporaryFolder folder;
    for (const std::uint32_t tile : {0U, 3U, 64U}) {
        const Image image = read_picture(folder.write("t.exr", exr(8, 5, tile)));
        EXPECT_EQ(image.rgba, std::vector<float>(4 * 40, 1.0F)) << tile;
    }
    EXPECT_EQ(read_picture(folder.write("t.exr", exr(3, 3, 0, {"Y"}))).rgba, std::vector<float>(36, 1.0F));
}

TEST(OpenExr, WhatALibraryWouldAssertIsASentence) {
    const TemporaryFolder folder;
    std::string bytes = exr(8, 5);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = bytes;
        changed.replace(changed.find(from), from.size(), to);
        return refusal([&] { read_picture(folder.write("t.exr", changed)); });
    };
    EXPECT_TRUE(contains(with("scanlineimage", "xcanlineimage"), "'type' is not 'scanlineimage'"));
    EXPECT_TRUE(contains(with("channels", "xhannels"), "lacks the attribute 'channels'"));
    EXPECT_TRUE(contains(with("dataWindow", "xataWindow"), "lacks the attribute 'dataWindow'"));
    EXPECT_TRUE(contains(with("compression" + zeros(1) + "compression" + zeros(1) + little(1, 4) + zeros(1),
                              "compression" + zeros(1) + "compression" + zeros(1) + little(1, 4) + "\x8"),
                         "packed by DWAA"));
    bytes = exr(8, 5, 0, {"depth", "id"});
    EXPECT_TRUE(contains(with("depth", "depth"), "no channels R, G and B, or Y alone, but depth, id"));
}

}  // namespace
}  // namespace bruma::io
