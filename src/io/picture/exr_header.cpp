#include "io/picture/exr_header.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

constexpr std::int64_t most_exr_along = 1 << 24;
constexpr std::size_t most_channels = 1024;

/// A text that a zero ends.
std::string_view ended_text(ByteReader& reader, std::string_view all) {
    constexpr std::size_t longest = 255;
    const std::string_view rest = all.substr(reader.at());
    const std::size_t length = rest.find('\0');
    if (length == std::string_view::npos && rest.size() <= longest) {
        throw BytesMissing{all.size(), 1};
    }
    if (length > longest) {
        throw BrokenPicture{fmt::format("at byte {} a name is longer than {}", reader.at(), longest)};
    }
    reader.skip(length + 1);
    return rest.substr(0, length);
}

std::vector<ExrChannel> read_channels(std::string_view content) {
    ByteReader reader(content);
    std::vector<ExrChannel> channels;
    while (true) {
        ExrChannel channel;
        channel.name = ended_text(reader, content);
        if (channel.name.empty()) {
            break;
        }
        const std::uint32_t sample = reader.le32();
        reader.skip(4);
        const std::int32_t across = reader.signed_le32();
        const std::int32_t down = reader.signed_le32();
        if (sample > 2 || channels.size() == most_channels) {
            throw BrokenPicture{"it has a channel of no known type, or more channels than 1024"};
        }
        if (across != 1 || down != 1) {
            throw UnreadPicture{"some of its channels have fewer pixels than others"};
        }
        channel.sample = ExrSample(sample);
        channels.push_back(channel);
    }
    if (channels.empty()) {
        throw BrokenPicture{"it has no channels"};
    }
    return channels;
}

ExrCompression read_compression(std::string_view content) {
    constexpr std::array<std::string_view, 10> names{"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                                     "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    const int found = ByteReader(content).u8();
    if (found > int(ExrCompression::piz)) {
        throw UnreadPicture{found < int(names.size()) ? fmt::format("it is packed by {}", names[std::size_t(found)])
                                                      : fmt::format("it is packed in a way of the number {}", found)};
    }
    return ExrCompression(found);
}

void read_window(std::string_view content, ExrHeader& header) {
    ByteReader reader(content);
    header.left = reader.signed_le32();
    header.top = reader.signed_le32();
    header.width = reader.signed_le32() - header.left + 1;
    header.height = reader.signed_le32() - header.top + 1;
    if (header.width < 1 || header.height < 1 || header.width > most_exr_along || header.height > most_exr_along) {
        throw BrokenPicture{fmt::format("its data window has {} x {} pixels", header.width, header.height)};
    }
}

void read_tiles(std::string_view content, ExrHeader& header) {
    ByteReader reader(content);
    header.tile_width = reader.le32();
    header.tile_height = reader.le32();
    if (header.tile_width < 1 || header.tile_height < 1 || header.tile_width > most_exr_along ||
        header.tile_height > most_exr_along) {
        throw BrokenPicture{fmt::format("its tiles have {} x {} pixels", header.tile_width, header.tile_height)};
    }
}

/// Magic and version; whether the picture stands in tiles.
bool read_version(ByteReader& reader) {
    constexpr std::uint32_t tiled = 0x200, long_names = 0x400, deep = 0x800, parts = 0x1000;
    reader.skip(4);
    const std::uint32_t version = reader.le32();
    if ((version & 0xFF) != 2 || (version & ~(0xFF | tiled | long_names | deep | parts)) != 0) {
        throw UnreadPicture{fmt::format("its version is {:#x}", version)};
    }
    if ((version & (deep | parts)) != 0) {
        throw UnreadPicture{(version & parts) != 0 ? "it has several parts" : "it is deep"};
    }
    return (version & tiled) != 0;
}

/// Single pictures may say what they are; those that do must say it right.
void check_type(std::string_view content, bool is_tiled) {
    const std::string_view expected = is_tiled ? "tiledimage" : "scanlineimage";
    const std::string_view found = content.substr(0, content.find('\0'));
    if (found != expected) {
        throw BrokenPicture{fmt::format("its attribute 'type' is not '{}'", expected)};
    }
}

}  // namespace

std::int64_t ExrHeader::rows_per_chunk() const {
    return compression == ExrCompression::zip ? 16 : compression == ExrCompression::piz ? 32 : 1;
}

std::size_t ExrHeader::pixel_bytes() const {
    std::size_t bytes = 0;
    for (const ExrChannel& channel : channels) {
        bytes += bytes_of(channel.sample);
    }
    return bytes;
}

ExrHeader read_exr_header(ByteReader& reader) {
    ExrHeader header;
    header.is_tiled = read_version(reader);
    bool has_compression = false;
    while (true) {
        const std::string_view name = ended_text(reader, reader.all());
        if (name.empty()) {
            break;
        }
        const std::string_view type = ended_text(reader, reader.all());
        const std::string_view content = reader.take(reader.le32());
        if (name == "channels" && type == "chlist") {
            header.channels = read_channels(content);
        } else if (name == "compression" && type == "compression") {
            header.compression = read_compression(content);
            has_compression = true;
        } else if (name == "dataWindow" && type == "box2i") {
            read_window(content, header);
        } else if (name == "tiles" && type == "tiledesc") {
            read_tiles(content, header);
        } else if (name == "type" && type == "string") {
            check_type(content, header.is_tiled);
        }
    }
    if (header.channels.empty() || !has_compression || header.width == 0 ||
        (header.is_tiled && header.tile_width == 0)) {
        throw BrokenPicture{fmt::format("it lacks the attribute '{}'", header.channels.empty() ? "channels"
                                                                       : !has_compression      ? "compression"
                                                                       : header.width == 0     ? "dataWindow"
                                                                                               : "tiles")};
    }
    return header;
}

}  // namespace bruma::io
