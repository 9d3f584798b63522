#include <fmt/core.h>

#include <array>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "io/input_file.h"
#include "io/picture/exr.h"
#include "io/picture/picture_file.h"
#include "io/picture/picture_kind.h"
#include "io/picture/radiance_picture.h"
#include "io/picture/raster_picture.h"

namespace bruma::io {
namespace {

/// Straight sRGB samples to linear premultiplied ones; `largest` is the sample that means 1.
template <class T>
Image linear_image(const RasterPicture& picture, std::size_t largest) {
    std::vector<float> linear(largest + 1);
    for (std::size_t n = 0; n <= largest; ++n) {
        linear[n] = float(linear_of_srgb(double(n) / double(largest)));
    }
    Image image(picture.width, picture.height);
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        std::array<T, 4> samples{};
        std::memcpy(samples.data(), &picture.rgba[n * sizeof samples], sizeof samples);
        const float alpha = float(samples[3]) / float(largest);
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgba[4 * n + c] = linear[samples[c]] * alpha;
        }
        image.rgba[4 * n + 3] = alpha;
    }
    return image;
}

}  // namespace

double linear_of_srgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

Image read_picture(const std::filesystem::path& path) {
    const std::string bytes = read_text_file(path, most_picture_bytes);
    const PictureKind kind = picture_kind(bytes);
    if (kind == PictureKind::open_exr) {
        return decode_exr(path.string(), bytes);
    }
    if (kind == PictureKind::radiance) {
        return decode_radiance(path.string(), bytes);
    }
    const PictureDoor door{"known are .png, .jpg, .bmp, .tga, .hdr and .exr", [](int, int) {}};
    const RasterPicture picture = decode_raster(path.string(), bytes, door);
    return picture.bits == 16 ? linear_image<std::uint16_t>(picture, 65535) : linear_image<std::uint8_t>(picture, 255);
}

}  // namespace bruma::io
