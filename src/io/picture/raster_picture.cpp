#include "io/picture/raster_picture.h"

#include <fmt/core.h>

#include <new>

#include "base/error.h"
#include "base/memory.h"
#include "io/picture/bmp_picture.h"
#include "io/picture/byte_reader.h"
#include "io/picture/netpbm_picture.h"
#include "io/picture/picture_kind.h"
#include "io/picture/png_jpeg_picture.h"
#include "io/picture/tga_picture.h"

namespace bruma::io {
namespace {

RasterPicture decode_of_kind(PictureKind kind, std::string_view bytes, const PictureDoor& door) {
    switch (kind) {
        case PictureKind::png:
            return decode_png(bytes, door);
        case PictureKind::jpeg:
            return decode_jpeg(bytes, door);
        case PictureKind::bmp:
            return decode_bmp(bytes, door);
        case PictureKind::tga:
            return decode_tga(bytes, door);
        case PictureKind::netpbm:
            return decode_netpbm(bytes, door);
        case PictureKind::radiance:
        case PictureKind::open_exr:
            throw UnreadPicture{"it holds floating-point light, but 8 or 16 bits are wanted here"};
        case PictureKind::foreign:
            throw UnreadPicture{"it is " + foreign_kind(bytes)};
        case PictureKind::unknown:
            break;
    }
    throw BrokenPicture{"its first bytes are of no kind that is known"};
}

}  // namespace

void begin_raster(RasterPicture& picture, const PictureDoor& door, std::uint64_t fewest_bytes, std::uint64_t left) {
    if (picture.width < 1 || picture.height < 1) {
        throw BrokenPicture{fmt::format("it has {} x {} pixels", picture.width, picture.height)};
    }
    door.accept_size(picture.width, picture.height);
    if (fewest_bytes > left) {
        throw BrokenPicture{fmt::format("{} x {} pixels need {} bytes or more, but {} are left", picture.width,
                                        picture.height, fewest_bytes, left)};
    }
    const std::uint64_t needed = std::uint64_t(picture.sample_count()) * std::uint64_t(picture.bits / 8);
    if (2 * needed > available_memory()) {
        throw UnreadPicture{fmt::format("{} x {} pixels need {} MiB of memory, but {} MiB are free", picture.width,
                                        picture.height, needed >> 19, available_memory() >> 20)};
    }
    picture.rgba.resize(needed);
}

RasterPicture decode_raster(const std::string& name, std::string_view bytes, const PictureDoor& door) {
    const auto broken = [&](const std::string& why) {
        return InputError(fmt::format("{}: broken or unknown picture ({}); {}", name, why, door.known));
    };
    try {
        return decode_of_kind(picture_kind(bytes), bytes, door);
    } catch (const BytesMissing& missing) {
        throw broken(fmt::format("it ends at byte {}, at least {} early", missing.at, missing.early));
    } catch (const BrokenPicture& fault) {
        throw broken(fault.why);
    } catch (const UnreadPicture& fault) {
        throw InputError(
            fmt::format("{}: this picture is not read, {}; convert it to .png ({})", name, fault.why, door.known));
    } catch (const std::bad_alloc&) {
        throw InputError(fmt::format("{}: too little memory is free for this picture; scale it down", name));
    }
}

}  // namespace bruma::io
