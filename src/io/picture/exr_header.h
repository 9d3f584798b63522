#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "io/picture/byte_reader.h"

namespace bruma::io {

/// The part of an OpenEXR file before its pixels ("OpenEXR File Layout", openexr.com): magic, version and attributes.

enum class ExrSample { uint32, half, float32 };
constexpr std::size_t bytes_of(ExrSample sample) {
    return sample == ExrSample::half ? 2 : 4;
}

enum class ExrCompression { none, rle, zips, zip, piz };

struct ExrChannel {
    std::string name;
    ExrSample sample = ExrSample::half;
};

struct ExrHeader {
    std::vector<ExrChannel> channels;  ///< in the order in which they are stored
    ExrCompression compression = ExrCompression::none;
    std::int64_t left = 0, top = 0;      ///< of the data window
    std::int64_t width = 0, height = 0;  ///< of the data window, each 1 to 2^24
    bool is_tiled = false;               ///< else chunks of whole rows
    std::int64_t tile_width = 0, tile_height = 0;

    /// Rows that a chunk of rows has at most.
    std::int64_t rows_per_chunk() const;
    /// Bytes of one pixel, all channels together, at least 2.
    std::size_t pixel_bytes() const;
};

/// Reads up to the table of chunks. Throws BytesMissing, BrokenPicture and, for what is no plain picture (several
/// parts, deep data, subsampled channels, other compressions), UnreadPicture.
ExrHeader read_exr_header(ByteReader& reader);

}  // namespace bruma::io
