#include "io/picture/bmp_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>

#include "io/picture/byte_reader.h"

namespace bruma::io {
namespace {

struct BmpHeader {
    std::uint32_t pixels_at = 0;
    std::uint32_t header_size = 0;
    int bits = 0;
    bool top_first = false;
    std::array<std::uint32_t, 4> masks{};  ///< red, green, blue, alpha
};

/// A channel's bits, moved down and spread over 0 to 255.
std::uint8_t spread_channel(std::uint32_t pixel, std::uint32_t mask) {
    const std::uint64_t largest = mask >> std::countr_zero(mask);
    const std::uint64_t value = (pixel & mask) >> std::countr_zero(mask);
    return std::uint8_t((value * 255 + largest / 2) / largest);
}

bool is_one_run(std::uint32_t mask) {
    const std::uint32_t low = mask == 0 ? 0 : mask >> std::countr_zero(mask);
    return mask != 0 && (low & (low + 1)) == 0;
}

void read_masks(ByteReader& reader, std::uint32_t compression, BmpHeader& header) {
    const bool is_masked = compression == 3 || compression == 6;
    if (compression == 1 || compression == 2 || compression == 4 || compression == 5) {
        throw UnreadPicture{"its pixels are packed, as few BMP files are"};
    }
    if (compression != 0 && !is_masked) {
        throw BrokenPicture{fmt::format("a BMP of compression {}", compression)};
    }
    if (header.bits != 16 && header.bits != 32) {
        return;
    }
    header.masks = header.bits == 16 ? std::array<std::uint32_t, 4>{0x7C00, 0x3E0, 0x1F, 0}
                                     : std::array<std::uint32_t, 4>{0xFF0000, 0xFF00, 0xFF, 0xFF000000};
    if (!is_masked) {
        return;
    }
    // Behind the 40 bytes that all have: inside longer headers, after the shortest.
    const bool has_alpha = header.header_size >= 56 || compression == 6;
    for (std::size_t n = 0; n < 4; ++n) {
        header.masks[n] = n < 3 || has_alpha ? reader.le32() : 0;
        if (!is_one_run(header.masks[n]) && (n < 3 || header.masks[n] != 0)) {
            throw BrokenPicture{fmt::format("a BMP whose channel {} has the bits {:x}", n, header.masks[n])};
        }
    }
}

BmpHeader read_bmp_header(ByteReader& reader, RasterPicture& picture) {
    BmpHeader header;
    reader.skip(10);
    header.pixels_at = reader.le32();
    header.header_size = reader.le32();
    std::int64_t height = 0;
    std::uint32_t compression = 0;
    if (header.header_size == 12) {
        picture.width = reader.le16();
        height = reader.le16();
        reader.skip(2);
        header.bits = reader.le16();
    } else {
        picture.width = std::max(0, reader.signed_le32());
        height = reader.signed_le32();
        reader.skip(2);
        header.bits = reader.le16();
        compression = reader.le32();
        reader.skip(20);
    }
    header.top_first = height < 0;
    picture.height = int(std::min<std::int64_t>(std::abs(height), std::numeric_limits<int>::max()));
    constexpr std::array known_bits{1, 4, 8, 16, 24, 32};
    if (std::find(known_bits.begin(), known_bits.end(), header.bits) == known_bits.end()) {
        throw BrokenPicture{fmt::format("a BMP of {} bits a pixel", header.bits)};
    }
    read_masks(reader, compression, header);
    return header;
}

using BmpPalette = std::array<std::array<std::uint8_t, 3>, 256>;

/// The colours between the header and the pixels; those that are missing are black.
BmpPalette read_bmp_palette(ByteReader& reader, const BmpHeader& header) {
    BmpPalette palette{};
    const std::size_t entry = header.header_size == 12 ? 3 : 4;
    const std::size_t begin = std::size_t(14) + header.header_size;
    reader.go_to(begin);
    const std::size_t between = header.pixels_at > begin ? header.pixels_at - begin : 0;
    const std::size_t count = std::min<std::size_t>(between / entry, std::size_t(1) << header.bits);
    for (std::size_t n = 0; n < count; ++n) {
        const std::string_view bytes = reader.take(entry);
        palette[n] = {std::uint8_t(bytes[2]), std::uint8_t(bytes[1]), std::uint8_t(bytes[0])};
    }
    return palette;
}

void unpack_bmp_row(std::string_view row, const BmpHeader& header, const BmpPalette& palette, int width,
                    std::byte* into) {
    const auto byte = [&](std::size_t n) { return std::uint32_t(std::uint8_t(row[n])); };
    for (std::size_t x = 0; x < std::size_t(width); ++x, into += 4) {
        std::array<std::uint8_t, 4> rgba{0, 0, 0, 255};
        if (header.bits <= 8) {
            const std::size_t per_byte = 8 / std::size_t(header.bits);
            const std::size_t shift = std::size_t(header.bits) * (per_byte - 1 - x % per_byte);
            const auto index = byte(x / per_byte) >> shift & ((1U << header.bits) - 1);
            std::copy(palette[index].begin(), palette[index].end(), rgba.begin());
        } else if (header.bits == 24) {
            rgba = {std::uint8_t(byte(3 * x + 2)), std::uint8_t(byte(3 * x + 1)), std::uint8_t(byte(3 * x)), 255};
        } else {
            std::uint32_t pixel = byte(header.bits / 8 * x) | byte(header.bits / 8 * x + 1) << 8;
            if (header.bits == 32) {
                pixel |= byte(4 * x + 2) << 16 | byte(4 * x + 3) << 24;
            }
            for (std::size_t c = 0; c < 4; ++c) {
                rgba[c] = header.masks[c] == 0 ? std::uint8_t(255) : spread_channel(pixel, header.masks[c]);
            }
        }
        std::transform(rgba.begin(), rgba.end(), into, [](std::uint8_t value) { return std::byte(value); });
    }
}

}  // namespace

RasterPicture decode_bmp(std::string_view bytes, const PictureDoor& door) {
    ByteReader reader(bytes);
    RasterPicture picture;
    const BmpHeader header = read_bmp_header(reader, picture);
    const std::uint64_t row_bytes = (std::uint64_t(picture.width) * std::uint64_t(header.bits) + 31) / 32 * 4;
    const std::uint64_t left = bytes.size() > header.pixels_at ? bytes.size() - header.pixels_at : 0;
    // The last row may lack the bytes that fill it up to a multiple of four.
    const std::uint64_t needed = row_bytes * std::uint64_t(picture.height);
    begin_raster(picture, door, needed < 4 ? needed : needed - 3, left);
    const BmpPalette palette = header.bits <= 8 ? read_bmp_palette(reader, header) : BmpPalette{};
    reader.go_to(header.pixels_at);
    for (int n = 0; n < picture.height; ++n) {
        const int y = header.top_first ? n : picture.height - 1 - n;
        const std::string_view row = reader.take(std::min<std::size_t>(row_bytes, reader.left()));
        if (row.size() * 8 < std::uint64_t(picture.width) * std::uint64_t(header.bits)) {
            throw BytesMissing{bytes.size(), row_bytes - row.size()};
        }
        unpack_bmp_row(row, header, palette, picture.width, &picture.rgba[std::size_t(4) * picture.width * y]);
    }
    picture.channels = header.masks[3] != 0 ? 4 : 3;
    bool has_alpha = false;
    for (std::size_t n = 3; n < picture.rgba.size(); n += 4) {
        has_alpha = has_alpha || picture.rgba[n] != std::byte{0};
    }
    for (std::size_t n = 3; !has_alpha && n < picture.rgba.size(); n += 4) {
        picture.rgba[n] = std::byte{255};
    }
    return picture;
}

}  // namespace bruma::io
