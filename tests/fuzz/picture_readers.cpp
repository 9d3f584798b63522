#include <stb/stb_image_write.h>
#include <tinyexr.h>

#include <array>
#include <memory>

#include "io/mesh/mesh_texture.h"
#include "io/picture/picture_file.h"
#include "io/picture/weather_file.h"
#include "io_picture_samples.h"
#include "readers.h"

namespace bruma::fuzz {
namespace {

namespace fs = std::filesystem;
using namespace io::samples;

/// Whatever it is, it comes through every door of pictures.
void through_all_doors(const std::string& input, const fs::path& folder) {
    const fs::path path = put(folder, "t.png", input);
    each({[&] { io::load_texture(path); }, [&] { io::load_weather_map(path); }, [&] { io::read_picture(path); }});
}

/// So many numbers of one digit.
std::string spaced(int count) {
    std::string text;
    for (int n = 0; n < count; ++n) {
        text += char('0' + n % 9);
        text += ' ';
    }
    return text;
}

std::string jpeg(int width, int height, int channels, int quality) {
    std::string bytes;
    const std::string pixels = noise(std::size_t(width) * height * channels);
    stbi_write_jpg_to_func(
        [](void* to, void* from, int count) { static_cast<std::string*>(to)->append(static_cast<char*>(from), count); },
        &bytes, width, height, channels, pixels.data(), quality);
    return bytes;
}

/// OpenEXR by the library that writes them, three channels of a smooth ramp.
std::string packed_exr(int compression, int pixel_type) {
    constexpr int width = 21;
    constexpr int height = 34;
    std::array<std::vector<float>, 3> planes;
    std::array<float*, 3> pointers{};
    std::array<EXRChannelInfo, 3> channels{};
    std::array<int, 3> from{TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT, TINYEXR_PIXELTYPE_FLOAT};
    std::array<int, 3> to{pixel_type, pixel_type, pixel_type};
    for (std::size_t c = 0; c < 3; ++c) {
        for (int n = 0; n < width * height; ++n) {
            planes[c].push_back(float(n % width) / 8.0F + float(c));
        }
        pointers[c] = planes[c].data();
        channels[c].name[0] = "BGR"[c];
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 3;
    header.channels = channels.data();
    header.pixel_types = from.data();
    header.requested_pixel_types = to.data();
    header.compression_type = compression;
    EXRImage image;
    InitEXRImage(&image);
    image.num_channels = 3;
    image.width = width;
    image.height = height;
    image.images = reinterpret_cast<unsigned char**>(pointers.data());
    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const std::size_t size = SaveEXRImageToMemory(&image, &header, &memory, &message);
    const std::unique_ptr<unsigned char, void (*)(void*)> owner(memory, std::free);
    return {reinterpret_cast<const char*>(memory), size};
}

}  // namespace

std::vector<Reader> picture_readers() {
    return {
        {"png",
         {png(9, 8, 8, 2, png_rows(8, 27)), png(9, 8, 16, 6, png_rows(8, 72)),
          png(16, 8, 1, 3, png_rows(8, 2), std::string("\0\0\0\xff\xff\xff", 6)),
          png(8, 8, 4, 3, png_rows(8, 4), noise(48), png_chunk("tRNS", "\x10\x20")), png(8, 8, 8, 4, png_rows(8, 16)),
          png(8, 8, 8, 0, png_rows(8, 8), "", png_chunk("tRNS", std::string("\0\x07", 2)))},
         {"IHDR", "IDAT", "IEND", "PLTE", "tRNS", "CgBI", "gAMA", "acTL", "\x78\x9c", "\x89PNG\r\n\x1a\n",
          std::string("\0\0\0\0IEND", 8), std::string("\0\0\0\0IDAT\0\0\0\0", 12)},
         through_all_doors},
        {"jpeg",
         {jpeg(17, 20, 3, 90), jpeg(16, 16, 3, 30), jpeg(8, 40, 1, 100), jpeg(40, 9, 4, 95)},
         {"\xff\xd8", "\xff\xd9", "\xff\xda", "\xff\xc4", "\xff\xc0", "\xff\xc2", "\xff\xdb", "\xff\xdd", "\xff\xd0",
          "\xff\xdc", "\xff\xee", std::string("\xff\0", 2), "\xff\xff\xff", "Adobe"},
         through_all_doors},
        {"bmp",
         {bmp(9, 8, 24, "", noise(28 * 8)), bmp(8, 8, 32, "", noise(256)), bmp(8, 8, 16, "", noise(128)),
          bmp(8, 8, 8, noise(64), noise(64)), bmp(9, 8, 4, noise(64), noise(64)), bmp(33, 8, 1, noise(8), noise(64)),
          bmp(8, 8, 32, little(0xff00, 4) + little(0xff, 4) + little(0xff0000, 4), noise(256), 3)},
         {"BM", std::string("\x28\0\0\0", 4), std::string("\x7c\0\0\0", 4), std::string("\x0c\0\0\0", 4),
          std::string("\3\0\0\0", 4), std::string("\1\0\x20\0", 4), "\xff\xff\xff\xff"},
         through_all_doors},
        {"tga",
         {tga(2, 9, 8, 24, noise(216)), tga(3, 8, 8, 8, noise(64)), tga(1, 8, 8, 8, zeros(64), noise(48)),
          tga(10, 8, 8, 32, std::string("\xbf\1\2\3\4", 5)), tga(11, 8, 8, 16, std::string("\x9f\1\2\x9f\3\4", 6)),
          tga(9, 8, 8, 8, std::string("\xbf\1", 2), noise(48)), tga(2, 8, 8, 16, noise(128))},
         {std::string("\0\1\1", 3), std::string("\0\0\x0a", 3), "\xff", "\x80", "TRUEVISION-XFILE.", "\x10\x20"},
         through_all_doors},
        {"netpbm",
         {"P6 8 8 255 " + noise(192), "P6\n# c\n8 8\n65535\n" + noise(384), "P5 9 8 200 " + zeros(72),
          "P4 17 8 " + noise(24), "P3 8 8 9 " + spaced(192), "P2 2 2 9 1 2 3 4", "P1 8 8 " + std::string(64, '1')},
         {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "#", "\n", " ", "65535", "65536", "8 8"},
         through_all_doors},
        {"hdr",
         {radiance_runs(16, 9), radiance(8, 8, noise(256)), radiance_runs(90, 8),
          radiance(9, 8, std::string("\x40\x20\x10\x81\1\1\1\x08", 8) + noise(256))},
         {"#?RADIANCE\n", "#?RGBE\n", "FORMAT=32-bit_rle_rgbe\n", "FORMAT=32-bit_rle_xyze\n", "-Y ", "+X ", "+Y ",
          "-X ", std::string("\2\2\0\x10", 4), "\1\1\1\xff", "\n\n", "\x80", "EXPOSURE=2\n"},
         through_all_doors},
        {"exr",
         {exr(9, 8), exr(9, 8, 4), exr(8, 8, 0, {"Y"}), exr(8, 8, 0, {"A", "B", "G", "R", "Z"}),
          packed_exr(TINYEXR_COMPRESSIONTYPE_NONE, TINYEXR_PIXELTYPE_HALF),
          packed_exr(TINYEXR_COMPRESSIONTYPE_RLE, TINYEXR_PIXELTYPE_HALF),
          packed_exr(TINYEXR_COMPRESSIONTYPE_ZIPS, TINYEXR_PIXELTYPE_FLOAT),
          packed_exr(TINYEXR_COMPRESSIONTYPE_ZIP, TINYEXR_PIXELTYPE_HALF),
          packed_exr(TINYEXR_COMPRESSIONTYPE_PIZ, TINYEXR_PIXELTYPE_HALF),
          packed_exr(TINYEXR_COMPRESSIONTYPE_PIZ, TINYEXR_PIXELTYPE_FLOAT)},
         {"channels", "chlist", "compression", "dataWindow", "box2i", "tiles", "tiledesc", "type", "scanlineimage",
          "xcanlineimage", "tiledimage", "deepscanline", "R", std::string("\0", 1), std::string("\1\0\0\0", 4),
          "lineOrder", "\xff\xff\xff\x7f", std::string("\2\2\0\0", 4)},
         through_all_doors},
    };
}

}  // namespace bruma::fuzz
