#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/image.h"
#include "io/picture_file.h"

namespace bruma::io {

/// OpenEXR, scan lines, ZIP, 32-bit float: channels R, G, B, A and `extra`. `name` opens the messages.
std::vector<std::byte> encode_exr(const std::string& name, const Image& linear, const NamedChannels& extra);

/// R, G, B and A of an OpenEXR file in memory; a missing A is 1. Throws InputError for a broken file.
Image decode_exr(const std::string& name, const std::string& bytes);

}  // namespace bruma::io
