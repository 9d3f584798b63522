#pragma once
#include <span>
#include <string_view>

#include "io/picture/raster_picture.h"

namespace bruma::io {

/// PNG of every depth and colour type; 16 bits stay 16. Throws BytesMissing and BrokenPicture.
RasterPicture decode_png(std::string_view bytes, const PictureDoor& door);

/// JPEG, baseline and progressive, 8 bits. Throws BytesMissing and BrokenPicture.
RasterPicture decode_jpeg(std::string_view bytes, const PictureDoor& door);

/// Unpacks zlib data that must fill `into` exactly; whether they did.
bool inflate_exactly(std::string_view packed, std::span<std::byte> into);

}  // namespace bruma::io
