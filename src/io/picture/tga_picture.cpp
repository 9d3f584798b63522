#include "io/picture/tga_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/picture/byte_reader.h"

namespace bruma::io {
namespace {

constexpr std::size_t tga_header_bytes = 18;

struct TgaHeader {
    int name_bytes = 0;
    int has_palette = 0;
    int type = 0;  ///< 1 palette, 2 colour, 3 grey; 8 more in run lengths
    int palette_first = 0, palette_count = 0, palette_bits = 0;
    int width = 0, height = 0;
    int bits = 0;
    int flags = 0;

    bool in_runs() const { return type >= 8; }
    int sort() const { return type & 7; }
    bool top_first() const { return (flags & 0x20) != 0; }
    bool right_first() const { return (flags & 0x10) != 0; }
    std::size_t pixel_bytes() const { return std::size_t(bits + 7) / 8; }
};

TgaHeader read_tga_header(ByteReader& reader) {
    TgaHeader header;
    header.name_bytes = reader.u8();
    header.has_palette = reader.u8();
    header.type = reader.u8();
    header.palette_first = reader.le16();
    header.palette_count = reader.le16();
    header.palette_bits = reader.u8();
    reader.skip(4);
    header.width = reader.le16();
    header.height = reader.le16();
    header.bits = reader.u8();
    header.flags = reader.u8();
    return header;
}

bool is_color_depth(int bits) {
    return bits == 15 || bits == 16 || bits == 24 || bits == 32;
}

bool is_tga_header(const TgaHeader& header) {
    const bool is_type = header.type <= 11 && header.sort() >= 1 && header.sort() <= 3;
    const bool is_mapped = header.sort() == 1;
    const bool is_palette = header.has_palette == 0 || is_color_depth(header.palette_bits);
    const bool is_depth = header.sort() == 2 ? is_color_depth(header.bits) : header.bits == 8 || header.bits == 16;
    return is_type && header.has_palette <= 1 && is_palette && is_depth && (!is_mapped || header.has_palette == 1) &&
           (header.flags & 0xC0) == 0;
}

using TgaColor = std::array<std::uint8_t, 4>;

/// A colour of 15 to 32 bits: blue first, and of 16 bits the uppermost one says nothing that is to be relied on.
TgaColor color_of(std::string_view bytes) {
    const auto byte = [&](std::size_t n) { return std::uint8_t(bytes[n]); };
    if (bytes.size() > 2) {
        return {byte(2), byte(1), byte(0), bytes.size() > 3 ? byte(3) : std::uint8_t(255)};
    }
    const unsigned packed = byte(0) | unsigned(byte(1)) << 8;
    const auto spread = [&](int shift) { return std::uint8_t((packed >> shift & 31) * 255 / 31); };
    return {spread(10), spread(5), spread(0), 255};
}

class TgaPixels {
  public:
    TgaPixels(ByteReader& reader, const TgaHeader& header) : reader_(reader), header_(header) {
        if (header.has_palette == 1) {
            const std::size_t entry = std::size_t(header.palette_bits + 7) / 8;
            for (int n = 0; n < header.palette_count; ++n) {
                palette_.push_back(color_of(reader.take(entry)));
            }
        }
    }

    TgaColor next() {
        if (!header_.in_runs()) {
            return read();
        }
        if (left_ == 0) {
            const unsigned packet = reader_.u8();
            left_ = 1 + (packet & 127);
            repeats_ = packet > 127;
            color_ = read();
        } else if (!repeats_) {
            color_ = read();
        }
        --left_;
        return color_;
    }

  private:
    TgaColor read() {
        const std::string_view bytes = reader_.take(header_.pixel_bytes());
        if (header_.sort() == 2) {
            return color_of(bytes);
        }
        const auto low = std::uint8_t(bytes[0]);
        const auto high = std::uint8_t(bytes.size() > 1 ? bytes[1] : 0);
        if (header_.sort() == 3) {
            return {low, low, low, bytes.size() > 1 ? high : std::uint8_t(255)};
        }
        const int index = (low | high << 8) - header_.palette_first;
        if (index < 0 || std::size_t(index) >= palette_.size()) {
            throw BrokenPicture{fmt::format("a TGA pixel has colour {} of {}", index, palette_.size())};
        }
        return palette_[std::size_t(index)];
    }

    ByteReader& reader_;
    const TgaHeader& header_;
    std::vector<TgaColor> palette_;
    TgaColor color_{};
    unsigned left_ = 0;
    bool repeats_ = false;
};

}  // namespace

bool looks_like_tga(std::string_view bytes) {
    if (bytes.size() < tga_header_bytes) {
        return false;
    }
    ByteReader reader(bytes);
    return is_tga_header(read_tga_header(reader));
}

RasterPicture decode_tga(std::string_view bytes, const PictureDoor& door) {
    ByteReader reader(bytes);
    const TgaHeader header = read_tga_header(reader);
    RasterPicture picture;
    picture.width = header.width;
    picture.height = header.height;
    const int color_bits = header.sort() == 1 ? header.palette_bits : header.bits;
    picture.channels = header.sort() == 3 ? header.bits / 8 : color_bits == 32 ? 4 : 3;
    reader.skip(std::size_t(header.name_bytes));
    const std::uint64_t pixels = std::uint64_t(header.width) * std::uint64_t(header.height);
    // A packet of a run tells at most 128 pixels.
    const std::uint64_t fewest =
        header.in_runs() ? (pixels + 127) / 128 * (1 + header.pixel_bytes()) : pixels * header.pixel_bytes();
    begin_raster(picture, door, fewest, reader.left());
    TgaPixels in_file(reader, header);
    for (int row = 0; row < picture.height; ++row) {
        const int y = header.top_first() ? row : picture.height - 1 - row;
        for (int column = 0; column < picture.width; ++column) {
            const int x = header.right_first() ? picture.width - 1 - column : column;
            const TgaColor color = in_file.next();
            std::byte* pixel = &picture.rgba[4 * (std::size_t(y) * picture.width + x)];
            std::transform(color.begin(), color.end(), pixel, [](std::uint8_t value) { return std::byte(value); });
        }
    }
    return picture;
}

}  // namespace bruma::io
