#include "io/picture/netpbm_picture.h"

#include <fmt/core.h>

#include <cstring>

#include "io/picture/byte_reader.h"

namespace bruma::io {
namespace {

bool is_netpbm_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/// The next number of the head, or of a text picture; comments go from '#' to the line's end.
std::uint32_t netpbm_number(ByteReader& reader, std::uint32_t most) {
    char c = char(reader.u8());
    while (is_netpbm_blank(c) || c == '#') {
        while (c == '#' && reader.u8() != '\n') {
        }
        c = char(reader.u8());
    }
    std::uint32_t value = 0;
    do {
        if (c < '0' || c > '9') {
            throw BrokenPicture{fmt::format("byte {} of a Netpbm picture is no digit", reader.at() - 1)};
        }
        value = 10 * value + std::uint32_t(c - '0');
        if (value > most) {
            throw BrokenPicture{
                fmt::format("a number before byte {} of a Netpbm picture is above {}", reader.at(), most)};
        }
        c = reader.left() > 0 ? char(reader.u8()) : ' ';
    } while (!is_netpbm_blank(c));
    return value;
}

/// Samples one by one, 0 to `largest`.
class NetpbmSamples {
  public:
    NetpbmSamples(ByteReader& reader, int sort, std::uint32_t largest)
        : reader_(reader), sort_(sort), largest_(largest) {}

    void begin_row() { bits_left_ = 0; }
    std::uint32_t next() {
        std::uint32_t value = 0;
        switch (sort_) {
            case 1: {
                char c = char(reader_.u8());  // zeros and ones need no blank between them
                while (is_netpbm_blank(c)) {
                    c = char(reader_.u8());
                }
                if (c != '0' && c != '1') {
                    throw BrokenPicture{fmt::format("byte {} of a Netpbm bitmap is no 0 or 1", reader_.at() - 1)};
                }
                value = c == '1' ? 0 : 1;
                break;
            }
            case 2:
            case 3:
                value = netpbm_number(reader_, 65535);
                break;
            case 4:
                if (bits_left_ == 0) {
                    bits_ = reader_.u8();
                    bits_left_ = 8;
                }
                value = 1U - (bits_ >> --bits_left_ & 1U);
                break;
            default:
                value = largest_ > 255 ? reader_.be16() : reader_.u8();
        }
        if (value > largest_) {
            throw BrokenPicture{
                fmt::format("a sample of a Netpbm picture is {}, but its largest is {}", value, largest_)};
        }
        return value;
    }

  private:
    ByteReader& reader_;
    int sort_;
    std::uint32_t largest_;
    unsigned bits_ = 0;
    unsigned bits_left_ = 0;
};

}  // namespace

RasterPicture decode_netpbm(std::string_view bytes, const PictureDoor& door) {
    constexpr std::uint32_t most_pixels_along = 1 << 24;
    ByteReader reader(bytes);
    const int sort = reader.take(2)[1] - '0';
    RasterPicture picture;
    picture.width = int(netpbm_number(reader, most_pixels_along));
    picture.height = int(netpbm_number(reader, most_pixels_along));
    const bool is_bitmap = sort == 1 || sort == 4;
    const std::uint32_t largest = is_bitmap ? 1 : netpbm_number(reader, 65535);
    if (largest == 0) {
        throw BrokenPicture{"the largest sample of a Netpbm picture is 0"};
    }
    const bool is_color = sort == 3 || sort == 6;
    picture.channels = is_color ? 3 : 1;
    picture.bits = largest > 255 ? 16 : 8;
    const std::uint64_t samples =
        std::uint64_t(picture.width) * std::uint64_t(picture.height) * std::uint64_t(picture.channels);
    const std::uint64_t binary_bytes = sort == 4 ? (std::uint64_t(picture.width) + 7) / 8 * picture.height
                                                 : samples * std::uint64_t(largest > 255 ? 2 : 1);
    const std::uint64_t text_bytes = sort == 1 ? samples : 2 * samples - std::min<std::uint64_t>(samples, 1);
    begin_raster(picture, door, sort <= 3 ? text_bytes : binary_bytes, reader.left());
    const std::uint32_t full = picture.bits == 16 ? 65535 : 255;
    NetpbmSamples in_file(reader, sort, largest);
    std::size_t at = 0;
    const auto put = [&](std::uint32_t sample) {
        if (picture.bits == 16) {
            const auto value = std::uint16_t(sample);
            std::memcpy(&picture.rgba[2 * at], &value, sizeof value);
        } else {
            picture.rgba[at] = std::byte(sample);
        }
        ++at;
    };
    for (int y = 0; y < picture.height; ++y) {
        in_file.begin_row();
        for (int x = 0; x < picture.width; ++x) {
            std::uint32_t sample = 0;
            for (int c = 0; c < 3; ++c) {
                if (c == 0 || is_color) {
                    sample = (in_file.next() * full + largest / 2) / largest;
                }
                put(sample);
            }
            put(full);
        }
    }
    return picture;
}

}  // namespace bruma::io
