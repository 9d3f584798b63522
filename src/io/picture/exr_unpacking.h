#pragma once
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "io/picture/exr_header.h"

namespace bruma::io {

/// The samples of one chunk of an OpenEXR file: row by row, in each row channel by channel, little endian. `into` has
/// width * rows * header.pixel_bytes() bytes. Throws BytesMissing and BrokenPicture.
void unpack_exr_chunk(const ExrHeader& header, std::string_view packed, std::size_t width, std::size_t rows,
                      std::span<std::byte> into);

/// The same for PIZ alone: a Huffman code, a Haar-like wavelet in two dimensions and a table of the values that occur.
void unpack_exr_piz(const ExrHeader& header, std::string_view packed, std::size_t width, std::size_t rows,
                    std::span<std::byte> into);

}  // namespace bruma::io
