#include "app/exposure.h"

#include <algorithm>
#include <cmath>

namespace bruma::app {

std::optional<double> suitable_exposure_ev(const Image& picture) {
    constexpr double percentile = 0.99;
    constexpr double brightness = 0.9;
    constexpr double largest_ev = 32.0;  // of scene::Display
    std::vector<float> seen, all;
    for (std::size_t n = 0; n < picture.pixel_count(); ++n) {
        const float* rgba = &picture.rgba[4 * n];
        const float largest = std::max({rgba[0], rgba[1], rgba[2]});
        all.push_back(largest);
        if (rgba[3] > 0.0F) {
            seen.push_back(largest);
        }
    }
    std::vector<float>& values = seen.empty() ? all : seen;
    if (values.empty()) {
        return std::nullopt;
    }
    const auto at = values.begin() + std::lround(percentile * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    if (!(*at > 0.0F) || !std::isfinite(*at)) {
        return std::nullopt;
    }
    return std::clamp(std::round(100.0 * std::log2(brightness / double(*at))) / 100.0, -largest_ev, largest_ev);
}

}  // namespace bruma::app
