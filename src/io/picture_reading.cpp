#include <fmt/core.h>
#include <stb/stb_image.h>

#include <array>
#include <cmath>
#include <memory>

#include "base/error.h"
#include "io/exr.h"
#include "io/input_file.h"
#include "io/picture_file.h"

namespace bruma::io {
namespace {

constexpr std::int64_t most_bytes = std::int64_t(1) << 31;  // stb counts bytes in an int

template <class T>
using StbPixels = std::unique_ptr<T, decltype(&stbi_image_free)>;

[[noreturn]] void throw_broken(const std::filesystem::path& path) {
    const char* reason = stbi_failure_reason();
    throw InputError(fmt::format("{}: broken or unknown picture ({}); known are .png, .jpg, .bmp, .hdr and .exr",
                                 path.string(), reason != nullptr ? reason : "no reason given"));
}

/// Straight sRGB samples to linear premultiplied ones; `largest` is the sample that means 1.
template <class T>
Image linear_image(const T* samples, int width, int height, std::size_t largest) {
    std::vector<float> linear(largest + 1);
    for (std::size_t n = 0; n <= largest; ++n) {
        linear[n] = float(linear_of_srgb(double(n) / double(largest)));
    }
    Image image(width, height);
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float alpha = float(samples[4 * n + 3]) / float(largest);
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgba[4 * n + c] = linear[samples[4 * n + c]] * alpha;
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
    const std::string bytes = read_text_file(path, most_bytes - 1);
    constexpr std::string_view exr_magic("\x76\x2f\x31\x01", 4);
    if (bytes.starts_with(exr_magic)) {
        return decode_exr(path.string(), bytes);
    }
    const auto* memory = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int length = int(bytes.size());
    int width = 0;
    int height = 0;
    int channels = 0;
    if (stbi_is_hdr_from_memory(memory, length) != 0) {
        const StbPixels<float> pixels(stbi_loadf_from_memory(memory, length, &width, &height, &channels, 4),
                                      stbi_image_free);
        if (!pixels) {
            throw_broken(path);
        }
        Image image(width, height);
        std::copy(pixels.get(), pixels.get() + image.rgba.size(), image.rgba.begin());
        return image;
    }
    if (stbi_is_16_bit_from_memory(memory, length) != 0) {
        const StbPixels<stbi_us> pixels(stbi_load_16_from_memory(memory, length, &width, &height, &channels, 4),
                                        stbi_image_free);
        if (!pixels) {
            throw_broken(path);
        }
        return linear_image(pixels.get(), width, height, 65535);
    }
    const StbPixels<stbi_uc> pixels(stbi_load_from_memory(memory, length, &width, &height, &channels, 4),
                                    stbi_image_free);
    if (!pixels) {
        throw_broken(path);
    }
    return linear_image(pixels.get(), width, height, 255);
}

}  // namespace bruma::io
