#include "io/picture/png_jpeg_picture.h"

#include <fmt/core.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>

#include "io/picture/byte_reader.h"
#include "io/picture/jpeg_segments.h"

namespace bruma::io {
namespace {

/// Thrown for what the library takes for impossible; its own way would be to abort the program.
struct LibraryFault {};
void require_of_library(bool holds) {
    if (!holds) {
        throw LibraryFault{};
    }
}

}  // namespace
}  // namespace bruma::io

// The decoders are compiled here rather than linked: without the sorts of pictures that are read by this folder's own
// code, with faults that can be caught, and with whatever a debug build checks.
#define STB_IMAGE_STATIC
#ifndef __clang_analyzer__  // it looks for faults in what is not ours
#define STB_IMAGE_IMPLEMENTATION
#endif
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_LINEAR
#define STBI_NO_HDR
#define STBI_ASSERT(x) bruma::io::require_of_library(x)
#include <stb/stb_image.h>

namespace bruma::io {
namespace {

using namespace std::string_view_literals;

const stbi_uc* library_bytes(std::string_view bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

/// Unpacks with the library what has been checked before; `sort` names it in messages.
void decode_by_library(std::string_view bytes, RasterPicture& picture, const char* sort) {
    int width = 0;
    int height = 0;
    int channels = 0;
    void* pixels = nullptr;
    try {
        pixels = picture.bits == 16 ? static_cast<void*>(stbi_load_16_from_memory(
                                          library_bytes(bytes), int(bytes.size()), &width, &height, &channels, 4))
                                    : static_cast<void*>(stbi_load_from_memory(library_bytes(bytes), int(bytes.size()),
                                                                               &width, &height, &channels, 4));
    } catch (const LibraryFault&) {
        pixels = nullptr;
    }
    const std::unique_ptr<void, void (*)(void*)> owner(pixels, std::free);
    if (pixels == nullptr || width != picture.width || height != picture.height) {
        throw BrokenPicture{fmt::format("a {} that cannot be unpacked", sort)};
    }
    picture.channels = channels;
    std::memcpy(picture.rgba.data(), pixels, picture.rgba.size());
}

std::string four_bytes(std::size_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

struct PngParts {
    std::string_view header, transparency, palette;
    std::string packed;
};

/// The chunks that a still picture is made of; all others are left out. Checksums are not asked for.
PngParts png_parts(std::string_view bytes) {
    PngParts parts;
    ByteReader reader(bytes);
    reader.skip(8);
    for (bool ended = false; !ended;) {
        const std::uint32_t length = reader.be32();
        const std::string_view type = reader.take(4);
        const std::string_view content = reader.take(length);
        ended = type == "IEND"sv;
        reader.skip(std::min<std::size_t>(4, ended ? reader.left() : 4));
        if (parts.header.empty() != (type == "IHDR"sv) && type != "CgBI"sv) {
            throw BrokenPicture{"a PNG with no header at its beginning, or with two"};
        }
        if (type == "CgBI"sv) {
            throw UnreadPicture{"it is a PNG in the form that one maker of telephones uses"};
        }
        if (type == "IHDR"sv) {
            parts.header = content;
        } else if (type == "PLTE"sv) {
            parts.palette = content;
        } else if (type == "tRNS"sv) {
            parts.transparency = content;
        } else if (type == "IDAT"sv) {
            parts.packed += content;
        } else if (!ended && (type[0] & 0x20) == 0) {
            throw BrokenPicture{"a PNG with a part that nobody knows and that is needed"};
        }
    }
    if (parts.header.size() != 13 || parts.packed.empty()) {
        throw BrokenPicture{"a PNG without header or pixels"};
    }
    return parts;
}

std::string png_chunk(std::string_view type, std::string_view content) {
    return four_bytes(content.size()).append(type).append(content).append(4, '\0');
}

/// The same picture with no more than the decoder needs: a palette is filled up to the 256 colours that pixels can
/// name, so that a missing one is black.
std::string plain_png(const PngParts& parts, int color_type) {
    std::string plain("\x89PNG\r\n\x1a\n");
    plain += png_chunk("IHDR", parts.header);
    if (color_type == 3) {
        std::string palette(parts.palette.substr(0, 768));
        palette.resize(768, '\0');
        plain += png_chunk("PLTE", palette);
    }
    const bool has_alpha_already = (color_type & 4) != 0;
    if (!parts.transparency.empty() && !has_alpha_already) {
        plain += png_chunk("tRNS", parts.transparency);
    }
    return plain + png_chunk("IDAT", parts.packed) + png_chunk("IEND", "");
}

/// No smaller than the smallest that deflate makes of `unpacked` bytes: 258 of them in two bits.
std::uint64_t fewest_deflated(std::uint64_t unpacked) {
    return unpacked / 1032;
}

}  // namespace

RasterPicture decode_png(std::string_view bytes, const PictureDoor& door) {
    const PngParts parts = png_parts(bytes);
    ByteReader header(parts.header);
    RasterPicture picture;
    const std::uint32_t width = header.be32();
    const std::uint32_t height = header.be32();
    const int depth = header.u8();
    const int color_type = header.u8();
    constexpr std::uint32_t most = std::numeric_limits<int>::max();
    picture.width = int(std::min(width, most));
    picture.height = int(std::min(height, most));
    picture.bits = depth == 16 ? 16 : 8;
    if (color_type == 3 && parts.palette.empty()) {
        throw BrokenPicture{"a PNG of a palette without one"};
    }
    const std::uint64_t samples = color_type == 2 ? 3 : color_type == 4 ? 2 : color_type == 6 ? 4 : 1;
    // Divided first: a width of 2^31 times a depth of 64 bits fits, times a height it may not.
    const std::uint64_t row_bytes = (std::uint64_t(width) * samples * std::uint64_t(depth) + 7) / 8 + 1;
    const bool fits = row_bytes <= std::numeric_limits<std::uint64_t>::max() / std::max<std::uint64_t>(height, 1);
    begin_raster(picture, door, fits ? fewest_deflated(row_bytes * height) : std::numeric_limits<std::uint64_t>::max(),
                 parts.packed.size());
    decode_by_library(plain_png(parts, color_type), picture, "PNG");
    return picture;
}

RasterPicture decode_jpeg(std::string_view bytes, const PictureDoor& door) {
    const JpegFrame frame = check_jpeg_segments(bytes);
    RasterPicture picture;
    picture.width = frame.width;
    picture.height = frame.height;
    // Two bits tell 64 grey pixels of one component at best, and in a progressive one runs of blocks do with less.
    const std::uint64_t pixels = std::uint64_t(picture.width) * std::uint64_t(picture.height);
    begin_raster(picture, door, pixels / 1024, bytes.size());
    decode_by_library(bytes, picture, "JPEG");
    return picture;
}

bool inflate_exactly(std::string_view packed, std::span<std::byte> into) {
    if (packed.size() > std::numeric_limits<int>::max() || into.size() > std::numeric_limits<int>::max()) {
        return false;
    }
    try {
        const int got = stbi_zlib_decode_buffer(reinterpret_cast<char*>(into.data()), int(into.size()), packed.data(),
                                                int(packed.size()));
        return got == int(into.size());
    } catch (const LibraryFault&) {
        return false;
    }
}

}  // namespace bruma::io
