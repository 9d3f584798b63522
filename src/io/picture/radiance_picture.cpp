#include "io/picture/radiance_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <new>
#include <vector>

#include "base/error.h"
#include "base/memory.h"
#include "io/picture/byte_reader.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

struct RadianceHeader {
    int width = 0, height = 0;
    bool top_first = true;
};

std::string_view header_line(ByteReader& reader, std::string_view bytes) {
    constexpr std::size_t longest = 4096;
    const std::size_t begin = reader.at();
    const std::size_t end = bytes.substr(begin, longest).find('\n');
    if (end == std::string_view::npos) {
        throw BytesMissing{bytes.size(), 1};
    }
    reader.skip(end + 1);
    std::string_view text = bytes.substr(begin, end);
    if (text.ends_with('\r')) {
        text.remove_suffix(1);
    }
    return text;
}

/// "-Y 480 +X 640": rows from the top down (+Y: up), each from the left.
RadianceHeader read_resolution(std::string_view text) {
    constexpr int most = 1 << 24;
    RadianceHeader header;
    const auto number = [&](std::string_view& rest) {
        int value = 0;
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
        if (error != std::errc() || value < 1 || value > most) {
            throw BrokenPicture{fmt::format("it tells its size as '{}'", text.substr(0, 40))};
        }
        rest.remove_prefix(std::size_t(end - rest.data()));
        return value;
    };
    std::string_view rest = text;
    header.top_first = rest.starts_with("-Y ");
    if (!header.top_first && !rest.starts_with("+Y ")) {
        throw UnreadPicture{fmt::format("its pixels go as '{}' says", text.substr(0, 40))};
    }
    rest.remove_prefix(3);
    header.height = number(rest);
    if (!rest.starts_with(" +X ")) {
        throw UnreadPicture{fmt::format("its pixels go as '{}' says", text.substr(0, 40))};
    }
    rest.remove_prefix(4);
    header.width = number(rest);
    return header;
}

RadianceHeader read_radiance_header(ByteReader& reader, std::string_view bytes) {
    header_line(reader, bytes);
    bool is_rgbe = true;
    for (std::string_view text = header_line(reader, bytes); !text.empty(); text = header_line(reader, bytes)) {
        if (text.starts_with("FORMAT=")) {
            is_rgbe = text == "FORMAT=32-bit_rle_rgbe";
        }
    }
    if (!is_rgbe) {
        throw UnreadPicture{"it is no RGBE"};
    }
    return read_resolution(header_line(reader, bytes));
}

Rgbe rgbe_pixel(ByteReader& reader) {
    const std::string_view bytes = reader.take(4);
    return {std::uint8_t(bytes[0]), std::uint8_t(bytes[1]), std::uint8_t(bytes[2]), std::uint8_t(bytes[3])};
}

/// Pixels as they are, in which 1, 1, 1, N means N times the one before; several in a row are digits of 256.
void read_flat(ByteReader& reader, std::vector<Rgbe>& row) {
    unsigned shift = 0;
    for (std::size_t x = 0; x < row.size();) {
        const Rgbe next = rgbe_pixel(reader);
        if (next[0] != 1 || next[1] != 1 || next[2] != 1) {
            row[x++] = next;
            shift = 0;
            continue;
        }
        const std::size_t count = shift > 16 ? row.size() + 1 : std::size_t(next[3]) << shift;
        if (x == 0 || count > row.size() - x) {
            throw BrokenPicture{"a run leaves its row"};
        }
        std::fill_n(row.begin() + std::ptrdiff_t(x), count, row[x - 1]);
        x += count;
        shift += 8;
    }
}

/// One component after another, each in packets: above 128 a run, else so many bytes as they are.
void read_packets(ByteReader& reader, std::vector<Rgbe>& row) {
    for (std::size_t component = 0; component < 4; ++component) {
        for (std::size_t x = 0; x < row.size();) {
            const std::size_t told = reader.u8();
            const bool is_run = told > 128;
            const std::size_t count = is_run ? told - 128 : told;
            if (count == 0 || count > row.size() - x) {
                throw BrokenPicture{"a run leaves its row"};
            }
            const std::string_view values = reader.take(is_run ? 1 : count);
            for (std::size_t n = 0; n < count; ++n) {
                row[x++][component] = std::uint8_t(values[is_run ? 0 : n]);
            }
        }
    }
}

void read_rgbe_row(ByteReader& reader, std::vector<Rgbe>& row) {
    const std::size_t begin = reader.at();
    const Rgbe first = rgbe_pixel(reader);
    const std::size_t told = std::size_t(first[2]) << 8 | first[3];
    if (row.size() >= 8 && row.size() < 32768 && first[0] == 2 && first[1] == 2 && told == row.size()) {
        read_packets(reader, row);
    } else {
        reader.go_to(begin);
        read_flat(reader, row);
    }
}

void check_rgbe_room(const RadianceHeader& header, std::uint64_t left) {
    const auto pixels = std::uint64_t(header.width) * std::uint64_t(header.height);
    // In packets a byte pair tells 127 values of one component; in old runs four bytes tell many pixels, but of one
    // row.
    const std::uint64_t fewest = std::uint64_t(header.height) * 4;
    if (fewest > left || pixels / 8192 > left) {
        throw BrokenPicture{
            fmt::format("{} x {} pixels need more than the {} bytes that are left", header.width, header.height, left)};
    }
    const std::uint64_t needed = pixels * 4 * sizeof(float);
    if (needed > available_memory() / 2) {
        throw UnreadPicture{fmt::format("{} x {} pixels need {} MiB of memory, but {} MiB are free", header.width,
                                        header.height, needed >> 20, available_memory() >> 20)};
    }
}

Image decode_rgbe(std::string_view bytes) {
    ByteReader reader(bytes);
    const RadianceHeader header = read_radiance_header(reader, bytes);
    check_rgbe_room(header, reader.left());
    Image image(header.width, header.height);
    std::vector<Rgbe> row(std::size_t(header.width), Rgbe{});
    for (int n = 0; n < header.height; ++n) {
        read_rgbe_row(reader, row);
        float* to = image.pixel(0, header.top_first ? n : header.height - 1 - n);
        for (const Rgbe& from : row) {
            // 2^(E - 128) / 256; an exponent of 0 is black.
            const float scale = from[3] == 0 ? 0.0F : std::ldexp(1.0F, int(from[3]) - 136);
            for (std::size_t c = 0; c < 3; ++c) {
                *to++ = float(from[c]) * scale;
            }
            *to++ = 1.0F;
        }
    }
    return image;
}

}  // namespace

Image decode_radiance(const std::string& name, std::string_view bytes) {
    try {
        return decode_rgbe(bytes);
    } catch (const BytesMissing& missing) {
        throw InputError(
            fmt::format("{}: broken Radiance picture (it ends at byte {}, at least {} early); was it copied "
                        "to its end?",
                        name, missing.at, missing.early));
    } catch (const BrokenPicture& fault) {
        throw InputError(fmt::format("{}: broken Radiance picture ({}); write it again", name, fault.why));
    } catch (const UnreadPicture& fault) {
        throw InputError(
            fmt::format("{}: this Radiance picture is not read, {}; convert it to .exr or .png", name, fault.why));
    } catch (const std::bad_alloc&) {
        throw InputError(fmt::format("{}: too little memory is free for this picture; scale it down", name));
    }
}

}  // namespace bruma::io
