#pragma once
#include <string_view>

namespace bruma::io {

struct JpegFrame {
    int width = 0, height = 0;  ///< pixels, 0 where the file says so
};

/// Walks over the segments of a JPEG to its end and checks what a decoder relies on: lengths, tables that hold at most
/// 255 codes, scans whose components and tables were told before, and an end. Throws BytesMissing, BrokenPicture and
/// UnreadPicture.
JpegFrame check_jpeg_segments(std::string_view bytes);

}  // namespace bruma::io
