#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

/// Small picture files made by code, byte by byte, for tests of what reads them.
namespace bruma::io::samples {

inline std::string little(std::uint64_t value, int bytes) {
    std::string text;
    for (int n = 0; n < bytes; ++n) {
        text += char(value >> (8 * n) & 255);
    }
    return text;
}
inline std::string big(std::uint64_t value, int bytes) {
    const std::string text = little(value, bytes);
    return {text.rbegin(), text.rend()};
}
inline std::string zeros(std::size_t count) {
    return std::string(count, '\0');
}
/// Bytes that differ from their neighbours.
inline std::string noise(std::size_t count) {
    std::string text;
    for (std::size_t n = 0; n < count; ++n) {
        text += char(n * 37 % 251);
    }
    return text;
}

inline std::string png_chunk(const std::string& type, const std::string& content) {
    return big(content.size(), 4) + type + content + zeros(4);
}
/// zlib data of stored, that is uncompressed, bytes, in one block of at most 65535.
inline std::string stored(const std::string& bytes) {
    return std::string("\x78\x01\x01", 3) + little(bytes.size(), 2) + little(~bytes.size(), 2) + bytes + zeros(4);
}
/// Each row of `rows` begins with its filter.
inline std::string png(std::uint32_t width, std::uint32_t height, int bits, int color_type, const std::string& rows,
                       const std::string& palette = {}, const std::string& more_chunks = {}) {
    return "\x89PNG\r\n\x1a\n" +
           png_chunk("IHDR", big(width, 4) + big(height, 4) + char(bits) + char(color_type) + zeros(3)) +
           (palette.empty() ? "" : png_chunk("PLTE", palette)) + more_chunks + png_chunk("IDAT", stored(rows)) +
           png_chunk("IEND", "");
}
/// Rows of noise behind a filter of their own.
inline std::string png_rows(std::size_t height, std::size_t row_bytes) {
    std::string rows;
    for (std::size_t y = 0; y < height; ++y) {
        rows += char(y % 5) + noise(row_bytes);
    }
    return rows;
}

inline std::string bmp(std::uint32_t width, std::uint32_t height, int bits, const std::string& palette,
                       const std::string& pixels, std::uint32_t compression = 0) {
    const std::size_t begin = 54 + palette.size();
    return "BM" + little(begin + pixels.size(), 4) + zeros(4) + little(begin, 4) + little(40, 4) + little(width, 4) +
           little(height, 4) + little(1, 2) + little(std::uint64_t(bits), 2) + little(compression, 4) +
           little(pixels.size(), 4) + zeros(16) + palette + pixels;
}

/// Type 1 palette, 2 colour, 3 grey, 8 more in run lengths; rows from the top.
inline std::string tga(int type, int width, int height, int bits, const std::string& pixels,
                       const std::string& palette_bgr = {}) {
    return zeros(1) + char(palette_bgr.empty() ? 0 : 1) + char(type) + zeros(2) + little(palette_bgr.size() / 3, 2) +
           char(palette_bgr.empty() ? 0 : 24) + zeros(4) + little(std::uint64_t(width), 2) +
           little(std::uint64_t(height), 2) + char(bits) + char(0x20) + palette_bgr + pixels;
}

inline std::string radiance(int width, int height, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) +
           "\n" + pixels;
}
/// Rows in packets: four components, each a run over the whole row.
inline std::string radiance_runs(int width, int height) {
    std::string pixels;
    for (int y = 0; y < height; ++y) {
        pixels += std::string("\2\2", 2) + big(std::uint64_t(width), 2);
        for (int component = 0; component < 4; ++component) {
            pixels += char(128 + width);
            pixels += char(component == 3 ? 129 : 16 * y + component);
        }
    }
    return radiance(width, height, pixels);
}

inline std::string exr_attribute(const std::string& name, const std::string& type, const std::string& content) {
    return name + '\0' + type + '\0' + little(content.size(), 4) + content;
}
/// OpenEXR without packing, of 32-bit floats that are all 1: rows one by one, or tiles.
inline std::string exr(std::uint32_t width, std::uint32_t height, std::uint32_t tile = 0,
                       const std::vector<std::string>& channels = {"B", "G", "R"}) {
    std::string list;
    for (const std::string& channel : channels) {
        list += channel + '\0' + little(2, 4) + zeros(4) + little(1, 4) + little(1, 4);
    }
    const std::string window = zeros(8) + little(width - 1, 4) + little(height - 1, 4);
    std::string file("\x76\x2f\x31\x01\2", 5);
    file += char(tile > 0 ? 2 : 0) + zeros(2);
    file += exr_attribute("channels", "chlist", list + '\0') + exr_attribute("compression", "compression", zeros(1)) +
            exr_attribute("dataWindow", "box2i", window) + exr_attribute("displayWindow", "box2i", window) +
            exr_attribute("lineOrder", "lineOrder", zeros(1)) +
            exr_attribute("type", "string", tile > 0 ? "tiledimage" : "scanlineimage");
    if (tile > 0) {
        file += exr_attribute("tiles", "tiledesc", little(tile, 4) + little(tile, 4) + zeros(1));
    }
    file += '\0';
    std::vector<std::string> chunks;
    const auto floats = [&](std::uint32_t count) {
        std::string bytes;
        for (std::size_t n = 0; n < count * channels.size(); ++n) {
            bytes += little(0x3f800000, 4);
        }
        return little(bytes.size(), 4) + bytes;
    };
    const std::uint32_t step = tile > 0 ? tile : 1;
    for (std::uint32_t y = 0; y < height; y += step) {
        for (std::uint32_t x = 0; x < (tile > 0 ? width : 1); x += step) {
            const std::uint32_t columns = tile > 0 ? std::min(tile, width - x) : width;
            const std::string place = tile > 0 ? little(x / step, 4) + little(y / step, 4) + zeros(8) : little(y, 4);
            chunks.push_back(place + floats(columns * std::min(step, height - y)));
        }
    }
    std::size_t at = file.size() + 8 * chunks.size();
    std::string pixels;
    for (const std::string& chunk : chunks) {
        file += little(at, 8);
        at += chunk.size();
        pixels += chunk;
    }
    return file + pixels;
}

}  // namespace bruma::io::samples
