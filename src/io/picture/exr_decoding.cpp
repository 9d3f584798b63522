#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <optional>

#include "base/error.h"
#include "base/memory.h"
#include "io/picture/byte_reader.h"
#include "io/picture/exr.h"
#include "io/picture/exr_header.h"
#include "io/picture/exr_unpacking.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

float float_of_half(std::uint16_t half) {
    const int exponent = half >> 10 & 31;
    const int mantissa = half & 1023;
    const std::uint32_t sign = std::uint32_t(half >> 15) << 31;
    float value = 0.0F;
    if (exponent == 0) {
        value = float(mantissa) / float(1 << 24);  // subnormal: mantissa * 2^-24
    } else {
        const std::uint32_t bits =
            (exponent == 31 ? 255U : std::uint32_t(exponent) + 112U) << 23 | std::uint32_t(mantissa) << 13;
        std::memcpy(&value, &bits, sizeof value);
    }
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    bits |= sign;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

float sample_value(std::span<const std::byte> bytes, ExrSample sort) {
    std::uint32_t bits = 0;
    for (std::size_t n = bytes_of(sort); n-- > 0;) {
        bits = bits << 8 | std::uint32_t(bytes[n]);
    }
    if (sort == ExrSample::half) {
        return float_of_half(std::uint16_t(bits));
    }
    if (sort == ExrSample::uint32) {
        return float(bits);
    }
    float value = 0.0F;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// Where the four parts of a pixel stand among the channels; grey pictures have their Y, or their only channel, thrice.
std::array<std::optional<std::size_t>, 4> find_channels(const ExrHeader& header) {
    const auto find = [&](std::string_view name) -> std::optional<std::size_t> {
        for (std::size_t n = 0; n < header.channels.size(); ++n) {
            if (header.channels[n].name == name) {
                return n;
            }
        }
        return std::nullopt;
    };
    std::array<std::optional<std::size_t>, 4> places{find("R"), find("G"), find("B"), find("A")};
    if (places[0] && places[1] && places[2]) {
        return places;
    }
    const std::optional<std::size_t> grey = header.channels.size() == 1 ? std::optional<std::size_t>(0) : find("Y");
    if (!grey || find("RY")) {
        std::string names;
        for (std::size_t n = 0; n < std::min<std::size_t>(8, header.channels.size()); ++n) {
            names += (n == 0 ? "" : ", ") + header.channels[n].name;
        }
        throw UnreadPicture{fmt::format("it has no channels R, G and B, or Y alone, but {}{}", names,
                                        header.channels.size() > 8 ? " and more" : "")};
    }
    return {grey, grey, grey, places[3]};
}

/// A part of the picture that was packed together, in pixels from its upper left corner.
struct ExrPart {
    std::size_t x, y, width, height;
};

class ExrDecoder {
  public:
    explicit ExrDecoder(std::string_view bytes) : reader_(bytes), header_(read_exr_header(reader_)) {
        channels_ = find_channels(header_);
        offset_of_.resize(header_.channels.size());
        for (std::size_t n = 1; n < offset_of_.size(); ++n) {
            offset_of_[n] = offset_of_[n - 1] + bytes_of(header_.channels[n - 1].sample);
        }
    }

    Image run() {
        const std::uint64_t across = header_.is_tiled ? parts_along(header_.width, header_.tile_width) : 1;
        const std::uint64_t down =
            parts_along(header_.height, header_.is_tiled ? header_.tile_height : header_.rows_per_chunk());
        check_room(across * down);
        const std::size_t table = reader_.at();
        std::vector<bool> is_read(across * down, false);
        image_ = Image(int(header_.width), int(header_.height));
        for (std::uint64_t n = 0; n < across * down; ++n) {
            reader_.go_to(table + 8 * n);
            reader_.go_to(std::size_t(reader_.le64()));
            const std::uint64_t index = header_.is_tiled ? read_tile(across, down) : read_rows();
            if (is_read[index]) {
                throw BrokenPicture{"a chunk is there twice"};
            }
            is_read[index] = true;
        }
        return std::move(image_);
    }

  private:
    static std::uint64_t parts_along(std::int64_t length, std::int64_t part) {
        return std::uint64_t((length + part - 1) / part);
    }

    /// Every chunk has an entry in a table, a place and a length, and packing makes data smaller by so much at best.
    void check_room(std::uint64_t chunks) const {
        const std::uint64_t pixels = std::uint64_t(header_.width) * std::uint64_t(header_.height);
        const std::uint64_t best_ratio = header_.compression == ExrCompression::none  ? 1
                                         : header_.compression == ExrCompression::piz ? 1 << 18
                                                                                      : 1032;
        const std::uint64_t left = reader_.left();
        if (16 * chunks > left || pixels > left * best_ratio / header_.pixel_bytes()) {
            throw BrokenPicture{fmt::format("{} x {} pixels need more than the {} bytes that are left", header_.width,
                                            header_.height, left)};
        }
        const std::uint64_t needed = pixels * (4 * sizeof(float) + header_.pixel_bytes());
        if (needed > available_memory() / 2) {
            throw UnreadPicture{fmt::format("{} x {} pixels need {} MiB of memory, but {} MiB are free", header_.width,
                                            header_.height, needed >> 20, available_memory() >> 20)};
        }
    }

    std::uint64_t read_rows() {
        const std::int64_t y = std::int64_t(reader_.signed_le32()) - header_.top;
        const std::int64_t rows = header_.rows_per_chunk();
        if (y < 0 || y >= header_.height || y % rows != 0) {
            throw BrokenPicture{"a chunk stands outside of the picture"};
        }
        unpack({0, std::size_t(y), std::size_t(header_.width), std::size_t(std::min(rows, header_.height - y))});
        return std::uint64_t(y / rows);
    }

    /// Tiles of the finest level stand first in the table.
    std::uint64_t read_tile(std::uint64_t across, std::uint64_t down) {
        const std::uint32_t column = reader_.le32();
        const std::uint32_t row = reader_.le32();
        const std::uint64_t level = reader_.le64();  // both numbers of it
        if (column >= across || row >= down || level != 0) {
            throw BrokenPicture{"a tile stands outside of the picture"};
        }
        const std::int64_t x = column * header_.tile_width;
        const std::int64_t y = row * header_.tile_height;
        unpack({std::size_t(x), std::size_t(y), std::size_t(std::min(header_.tile_width, header_.width - x)),
                std::size_t(std::min(header_.tile_height, header_.height - y))});
        return row * across + column;
    }

    void unpack(const ExrPart& part) {
        const std::string_view packed = reader_.take(reader_.le32());
        unpacked_.resize(part.width * part.height * header_.pixel_bytes());
        unpack_exr_chunk(header_, packed, part.width, part.height, unpacked_);
        for (std::size_t row = 0; row < part.height; ++row) {
            const std::size_t row_begin = row * part.width * header_.pixel_bytes();
            for (std::size_t c = 0; c < 4; ++c) {
                float* to = image_.pixel(int(part.x), int(part.y + row)) + c;
                if (!channels_[c]) {
                    for (std::size_t x = 0; x < part.width; ++x) {
                        to[4 * x] = 1.0F;
                    }
                    continue;
                }
                const ExrSample sort = header_.channels[*channels_[c]].sample;
                const std::span<const std::byte> from =
                    std::span(unpacked_).subspan(row_begin + part.width * offset_of_[*channels_[c]]);
                for (std::size_t x = 0; x < part.width; ++x) {
                    to[4 * x] = sample_value(from.subspan(x * bytes_of(sort)), sort);
                }
            }
        }
    }

    ByteReader reader_;
    ExrHeader header_;
    std::array<std::optional<std::size_t>, 4> channels_;
    std::vector<std::size_t> offset_of_;  ///< bytes of the channels before, for one pixel
    std::vector<std::byte> unpacked_;
    Image image_;
};

}  // namespace

Image decode_exr(const std::string& name, const std::string& bytes) {
    try {
        return ExrDecoder(bytes).run();
    } catch (const BytesMissing& missing) {
        throw InputError(
            fmt::format("{}: broken or unknown OpenEXR (it, or a part of it, ends at byte {}, at least {} "
                        "early); was it copied to its end?",
                        name, missing.at, missing.early));
    } catch (const BrokenPicture& fault) {
        throw InputError(fmt::format("{}: broken or unknown OpenEXR ({}); write it again", name, fault.why));
    } catch (const UnreadPicture& fault) {
        throw InputError(fmt::format("{}: this OpenEXR is not read, {}; save R, G and B in one part by ZIP or PIZ",
                                     name, fault.why));
    } catch (const std::bad_alloc&) {
        throw InputError(fmt::format("{}: too little memory is free for this picture; scale it down", name));
    }
}

}  // namespace bruma::io
