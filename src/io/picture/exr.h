#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "base/image.h"
#include "io/picture/picture_file.h"

namespace bruma::io {

/// OpenEXR, scan lines, ZIP, 32-bit float: channels R, G, B, A and `extra`. `name` opens the messages.
std::vector<std::byte> encode_exr(const std::string& name, const Image& linear, const NamedChannels& extra);

/// R, G, B and A of an OpenEXR file in memory, of its data window; a missing A is 1. Read are pictures of one part in
/// rows or tiles (their finest level), of whole numbers, halves or floats, not packed or by RLE, ZIP, ZIPS or PIZ, with
/// R, G and B, with Y, or with one channel. Throws InputError for others and for broken files. The library that writes
/// them is not asked to read: what is wrong in a file ends it by an assertion, or worse.
Image decode_exr(const std::string& name, const std::string& bytes);

}  // namespace bruma::io
