#pragma once
#include <string_view>

#include "io/picture/raster_picture.h"

namespace bruma::io {

/// Netpbm P1 to P6 of up to 16 bits; samples are scaled so that the file's largest one is full. Throws BytesMissing and
/// BrokenPicture.
RasterPicture decode_netpbm(std::string_view bytes, const PictureDoor& door);

}  // namespace bruma::io
