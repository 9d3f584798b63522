#include "measure/metrics/heatmap.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "measure/metrics/image_error.h"

namespace bruma::measure {
namespace {

/// Hues along the way, in linear light of any strength; `heat_color` gives each the luminance that its place asks for.
constexpr std::array<std::array<double, 3>, 5> hues{
    {{0.25, 0.0, 1.0}, {0.6, 0.0, 0.8}, {1.0, 0.08, 0.12}, {1.0, 0.45, 0.05}, {1.0, 0.95, 0.55}}};

double luminance(const std::array<double, 3>& rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// Luminance of a CIE lightness in [0, 100].
double luminance_of_lightness(double lightness) {
    const double f = (lightness + 16.0) / 116.0;
    return lightness > 8.0 ? f * f * f : lightness * 27.0 / 24389.0;
}

/// One character per step of half a decade below the largest difference; blank: none at all.
constexpr std::string_view ramp = " .:-=+*#%@";

char character_of(double difference, double largest) {
    if (!std::isfinite(difference)) {
        return '!';
    }
    if (!(difference > 0.0)) {
        return ' ';
    }
    const double steps_below = -2.0 * std::log10(difference / largest);
    const int step = int(ramp.size()) - 1 - int(std::floor(steps_below));
    return ramp[std::size_t(std::clamp(step, 1, int(ramp.size()) - 1))];
}

struct PixelError {
    int x, y;
    double difference;
};

/// Worst first, what is not finite before all; among equals in reading order.
std::vector<PixelError> worst_pixels(const Image& a, const Image& b, std::size_t count) {
    std::vector<PixelError> all;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double difference = pixel_difference(a, b, x, y);
            if (difference != 0.0) {
                all.push_back({x, y, std::isfinite(difference) ? difference : HUGE_VAL});
            }
        }
    }
    const auto end = all.begin() + std::ptrdiff_t(std::min(count, all.size()));
    std::partial_sort(all.begin(), end, all.end(), [](const PixelError& p, const PixelError& q) {
        return p.difference != q.difference ? p.difference > q.difference : p.y != q.y ? p.y < q.y : p.x < q.x;
    });
    all.erase(end, all.end());
    return all;
}

}  // namespace

std::array<float, 3> heat_color(double share) {
    if (std::isnan(share)) {
        return {0.0F, 1.0F, 0.0F};
    }
    const double place = std::clamp(share, 0.0, 1.0);
    const double knot = place * double(hues.size() - 1);
    const auto below = std::min(std::size_t(knot), hues.size() - 2);
    const double f = knot - double(below);
    std::array<double, 3> hue;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        hue[channel] = hues[below][channel] * (1.0 - f) + hues[below + 1][channel] * f;
    }
    // The hue at full strength, darkened or mixed with white until it has the luminance of its place.
    const double wanted = luminance_of_lightness(96.0 * place);
    const double strength = luminance(hue);
    std::array<float, 3> color;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double value = wanted <= strength
                                 ? hue[channel] * wanted / strength
                                 : hue[channel] + (1.0 - hue[channel]) * (wanted - strength) / (1.0 - strength);
        color[channel] = float(value);
    }
    return color;
}

Image error_heatmap(const Image& a, const Image& b, double full_scale) {
    check_comparable(a, b);
    if (!(full_scale > 0.0)) {
        throw InputError(
            fmt::format("heatmap: a full scale of {} shows nothing; give a difference above 0", full_scale));
    }
    Image map(a.width, a.height);
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double difference = pixel_difference(a, b, x, y);
            const auto color = heat_color(std::isfinite(difference) ? difference / full_scale : std::nan(""));
            std::copy(color.begin(), color.end(), map.pixel(x, y));
            map.pixel(x, y)[3] = 1.0F;
        }
    }
    return map;
}

std::string character_picture(const Image& a, const Image& b, int columns) {
    check_comparable(a, b);
    const std::vector<PixelError> worst = worst_pixels(a, b, 10);
    if (worst.empty()) {
        return fmt::format("no difference in {} x {} pixels\n", a.width, a.height);
    }
    double largest = 0.0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            const double difference = pixel_difference(a, b, x, y);
            largest = std::isfinite(difference) ? std::max(largest, difference) : largest;
        }
    }
    columns = std::clamp(columns, 1, a.width);
    // Characters are about twice as high as wide.
    const int rows = std::clamp(int(std::lround(0.5 * columns * a.height / a.width)), 1, a.height);
    std::string text =
        fmt::format("'@' {:.3g}, each step to the left in '{}' a factor of 3.16 less, '!' not finite\n", largest, ramp);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            double block = 0.0;
            for (int y = row * a.height / rows; y < (row + 1) * a.height / rows; ++y) {
                for (int x = column * a.width / columns; x < (column + 1) * a.width / columns; ++x) {
                    const double difference = pixel_difference(a, b, x, y);
                    block = std::isfinite(difference) ? std::max(block, difference) : HUGE_VAL;
                    if (block == HUGE_VAL) {
                        break;
                    }
                }
                if (block == HUGE_VAL) {
                    break;
                }
            }
            text += character_of(block, largest);
        }
        text += '\n';
    }
    text += "worst pixels (x, y): difference, picture, reference\n";
    for (const PixelError& pixel : worst) {
        const float* p = a.pixel(pixel.x, pixel.y);
        const float* q = b.pixel(pixel.x, pixel.y);
        text += fmt::format("({}, {}): {:.3g}  ({:.6g}, {:.6g}, {:.6g})  ({:.6g}, {:.6g}, {:.6g})\n", pixel.x, pixel.y,
                            pixel_difference(a, b, pixel.x, pixel.y), p[0], p[1], p[2], q[0], q[1], q[2]);
    }
    return text;
}

}  // namespace bruma::measure
