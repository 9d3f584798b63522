#include "measure/metrics/image_error.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "measure/metrics/flip.h"

namespace bruma::measure {

void check_comparable(const Image& a, const Image& reference) {
    if (a.width != reference.width || a.height != reference.height) {
        throw InputError(fmt::format(
            "compare: the picture has {} x {} pixels, its reference {} x {}; render both at the same --size", a.width,
            a.height, reference.width, reference.height));
    }
    if (a.pixel_count() == 0) {
        throw InputError("compare: both pictures have 0 pixels, so there is nothing to compare; check the two files");
    }
}

double pixel_difference(const Image& a, const Image& b, int x, int y) {
    double largest = 0.0;
    for (int channel = 0; channel < 3; ++channel) {
        const double difference = std::abs(double(a.pixel(x, y)[channel]) - double(b.pixel(x, y)[channel]));
        if (!std::isfinite(difference)) {
            return difference;
        }
        largest = std::max(largest, difference);
    }
    return largest;
}

ImageError compare_images(const Image& a, const Image& reference) {
    check_comparable(a, reference);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    ImageError error;
    double squares = 0.0;
    double relative_squares = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double difference = pixel_difference(a, reference, x, y);
            if (!std::isfinite(difference)) {
                if (error.non_finite++ == 0) {
                    error.worst_pixel = {x, y};
                }
                continue;
            }
            if (error.non_finite == 0 && difference > error.largest) {
                error.largest = difference;
                error.worst_pixel = {x, y};
            }
            for (int channel = 0; channel < 3; ++channel) {
                const double b = reference.pixel(x, y)[channel];
                const double square = (a.pixel(x, y)[channel] - b) * (a.pixel(x, y)[channel] - b);
                squares += square;
                relative_squares += square / (b * b + 0.01);
            }
        }
    }
    if (error.non_finite > 0) {
        error.rmse = error.relative_mse = error.largest = infinity;
        error.psnr_db = -infinity;
        error.mean_flip = 1.0;
        return error;
    }
    const double count = 3.0 * double(a.pixel_count());
    error.rmse = std::sqrt(squares / count);
    error.relative_mse = relative_squares / count;
    error.psnr_db = error.rmse > 0.0 ? -20.0 * std::log10(error.rmse) : infinity;
    error.mean_flip = mean_flip(a, reference);
    return error;
}

}  // namespace bruma::measure
