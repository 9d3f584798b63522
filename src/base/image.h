#pragma once
#include <cstddef>
#include <vector>

namespace bruma {

/// A picture in memory: linear Rec.709 radiance and opacity, float RGBA, top row first, premultiplied by opacity.
struct Image {
    int width = 0;            ///< pixels
    int height = 0;           ///< pixels
    std::vector<float> rgba;  ///< 4 * width * height

    Image() = default;
    Image(int w, int h) : width(w), height(h), rgba(std::size_t(4) * w * h, 0.0F) {}

    float* pixel(int x, int y) { return &rgba[std::size_t(4) * (std::size_t(y) * width + x)]; }
    const float* pixel(int x, int y) const { return &rgba[std::size_t(4) * (std::size_t(y) * width + x)]; }
    std::size_t pixel_count() const { return std::size_t(width) * height; }
};

}  // namespace bruma
