#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/image.h"
#include "io/file_content.h"

namespace bruma::io {

/// A picture as a display wants it: sRGB-encoded red, green, blue and opacity, 8 bits each, top row first, colour not
/// multiplied by opacity.
struct Picture8 {
    int width = 0, height = 0;       ///< pixels
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height
};

/// Further channels of an .exr by name, such as "error": width * height floats each, top row first.
using NamedChannels = std::map<std::string, std::vector<float>>;

/// The picture file endings that can be written.
enum class PictureFormat { png, hdr, exr };
/// Format by the ending of a path; "-", and a device or a pipe without ending, take PNG. Throws InputError with the
/// known endings.
PictureFormat picture_format(const std::string& path);

/// What a picture of this path's format is as a file.
FileContent picture_content(const std::string& path);

/// All writers leave either the whole file or what was there before; they throw InputError when it cannot be written
/// and for pictures without pixels.
void write_png(const std::string& path, const Picture8& picture);
/// Linear radiance, 32-bit float RGBA premultiplied by opacity, and the extra channels.
void write_exr(const std::string& path, const Image& linear, const NamedChannels& extra = {});
/// Radiance RGBE: no opacity, values below 0 become 0, relative precision 1/256.
void write_hdr(const std::string& path, const Image& linear);

/// Writes by the path's ending: `display` for .png, `linear` for .hdr and .exr.
void write_picture(const std::string& path, const Image& linear, const Picture8& display);

/// Reads .png, .jpg, .bmp, .tga and Netpbm (8 or 16 bits, taken as sRGB), .hdr and .exr to linear radiance,
/// premultiplied. Throws InputError for a missing, broken or unknown file.
Image read_picture(const std::filesystem::path& path);

/// The sRGB curve of IEC 61966-2-1: linear value in [0, 1] of an encoded one.
double linear_of_srgb(double encoded);

}  // namespace bruma::io
