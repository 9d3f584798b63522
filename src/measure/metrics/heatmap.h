#pragma once
#include <array>
#include <string>

#include "base/image.h"

namespace bruma::measure {

/// Linear Rec.709 of a difference in [0, 1] (clamped): black over violet, red and orange to pale yellow. CIE lightness
/// rises evenly, so that what looks twice as bright is twice as far. NaN is shown as green, which no number is.
std::array<float, 3> heat_color(double share);

/// Each pixel's largest |a - b| over red, green and blue, divided by `full_scale`, as a heat colour; opaque.
/// Throws InputError for pictures of different size or a scale that is not above 0.
Image error_heatmap(const Image& a, const Image& b, double full_scale);

/// The difference for a terminal: `columns` characters wide, each the largest difference of its block of pixels on a
/// logarithmic scale, then the ten worst pixels with both values. Throws InputError for pictures of different size.
std::string character_picture(const Image& a, const Image& b, int columns);

}  // namespace bruma::measure
