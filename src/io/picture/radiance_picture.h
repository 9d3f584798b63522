#pragma once
#include <string>
#include <string_view>

#include "base/image.h"

namespace bruma::io {

/// Radiance RGBE (.hdr): flat, in run lengths of either age, rows from the top or from the bottom; opacity is 1. `name`
/// opens the messages of InputError: for XYZE, other orientations and files that end early.
Image decode_radiance(const std::string& name, std::string_view bytes);

}  // namespace bruma::io
