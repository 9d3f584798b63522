#pragma once
#include <string_view>

#include "io/picture/raster_picture.h"

namespace bruma::io {

/// Whether the bytes begin with a header of a Truevision TGA that makes sense; these files have no mark.
bool looks_like_tga(std::string_view bytes);

/// TGA of 8 (grey or palette), 15, 16 (colour, palette, or grey and alpha), 24 and 32 bits, plain or in run lengths,
/// from any corner. Throws BytesMissing and BrokenPicture.
RasterPicture decode_tga(std::string_view bytes, const PictureDoor& door);

}  // namespace bruma::io
