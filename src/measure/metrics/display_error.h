#pragma once
#include "base/image.h"

namespace bruma::measure {

/// Signed differences to a reference in units of its display range.
struct DisplayError {
    double rmse = 0.0;
    double bias = 0.0;  ///< mean over pixels and channels
};

/// Radiance that is display range: that of the brightest channel that 99.5 % of all pixels keep below; 1 for black.
double display_white(const Image& reference);

/// Over all pixels, or over those of which `counts` is true.
DisplayError display_error(const Image& picture, const Image& reference, double white,
                           const std::vector<bool>& counts = {});

}  // namespace bruma::measure
