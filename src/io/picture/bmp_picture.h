#pragma once
#include <string_view>

#include "io/picture/raster_picture.h"

namespace bruma::io {

/// Windows bitmaps of 1, 4, 8 (palette), 16, 24 and 32 bits, with or without masks, either row first; a fourth channel
/// that is 0 everywhere is none. Throws BytesMissing, BrokenPicture and, for packed ones, UnreadPicture.
RasterPicture decode_bmp(std::string_view bytes, const PictureDoor& door);

}  // namespace bruma::io
