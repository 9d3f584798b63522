#include "io/picture/exr_unpacking.h"

#include <algorithm>
#include <cstring>

#include "io/picture/png_jpeg_picture.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

/// Run lengths of bytes: -N is followed by N bytes as they are, N by one that stands N + 1 times.
void unpack_runs(std::string_view packed, std::span<std::byte> into) {
    ByteReader reader(packed);
    std::size_t at = 0;
    while (at < into.size()) {
        const int byte = reader.u8();
        const int told = byte < 128 ? byte : byte - 256;
        const std::size_t count = told < 0 ? std::size_t(-told) : std::size_t(told) + 1;
        if (count > into.size() - at) {
            throw BrokenPicture{"a run leaves its chunk"};
        }
        const std::string_view bytes = reader.take(told < 0 ? count : 1);
        for (std::size_t n = 0; n < count; ++n) {
            into[at++] = std::byte(bytes[told < 0 ? n : 0]);
        }
    }
}

/// Bytes were told by their differences, the even ones before the odd ones.
void undo_differences(std::span<std::byte> bytes) {
    std::vector<std::byte> summed(bytes.begin(), bytes.end());
    for (std::size_t n = 1; n < summed.size(); ++n) {
        summed[n] = std::byte((unsigned(summed[n - 1]) + unsigned(summed[n]) + 128U) & 255U);
    }
    const std::size_t half = (bytes.size() + 1) / 2;
    for (std::size_t n = 0; n < bytes.size(); ++n) {
        bytes[n] = summed[n % 2 == 0 ? n / 2 : half + n / 2];
    }
}

}  // namespace

void unpack_exr_chunk(const ExrHeader& header, std::string_view packed, std::size_t width, std::size_t rows,
                      std::span<std::byte> into) {
    // What does not get smaller by packing is stored as it is.
    if (header.compression == ExrCompression::none || packed.size() >= into.size()) {
        if (packed.size() != into.size()) {
            throw BrokenPicture{"a chunk has not the length of its pixels"};
        }
        std::memcpy(into.data(), packed.data(), into.size());
        return;
    }
    switch (header.compression) {
        case ExrCompression::piz:
            unpack_exr_piz(header, packed, width, rows, into);
            return;
        case ExrCompression::rle:
            unpack_runs(packed, into);
            break;
        default:
            if (!inflate_exactly(packed, into)) {
                throw BrokenPicture{"a chunk cannot be unpacked"};
            }
    }
    undo_differences(into);
}

}  // namespace bruma::io
