#pragma once
#include <cstddef>
#include <glm/glm.hpp>

#include "base/image.h"

namespace bruma::measure {

/// How far a picture is from its reference, over the red, green and blue of all pixels, in linear light with a display
/// range of 1. If any pixel of either picture is not finite, every measure is its worst (infinite; PSNR minus infinity;
/// FLIP 1), so that no tolerance lets it pass.
struct ImageError {
    double rmse = 0.0;           ///< sqrt(mean of (a - b)^2)
    double relative_mse = 0.0;   ///< mean of (a - b)^2 / (b^2 + 0.01), b the reference
    double largest = 0.0;        ///< largest |a - b|
    double psnr_db = 0.0;        ///< 20 log10(1 / rmse); infinite for equal pictures
    double mean_flip = 0.0;      ///< mean of the FLIP map, [0, 1]
    glm::ivec2 worst_pixel{0};   ///< where `largest` is, or the first pixel that is not finite
    std::size_t non_finite = 0;  ///< pixels of which any of the three channels is not finite, in either picture
};

/// Throws InputError for pictures of different size, or without pixels.
ImageError compare_images(const Image& a, const Image& reference);

/// The largest |a - b| over red, green and blue of one pixel; NaN or infinite where a channel is.
double pixel_difference(const Image& a, const Image& b, int x, int y);

/// Throws InputError, naming both sizes, for pictures that cannot be compared.
void check_comparable(const Image& a, const Image& reference);

}  // namespace bruma::measure
