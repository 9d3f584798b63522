#include <algorithm>
#include <cmath>

#include "measure/bench/clouds/bench_clouds.h"

namespace bruma::measure {
namespace {

/// At most 1; NaN stays, so that no error that it tells lets it pass.
double displayed(float value) {
    return value > 1.0F ? 1.0 : double(value);
}

}  // namespace

std::vector<std::size_t> spread_pixels(glm::ivec2 pixels, int count) {
    // Multiples of 1 / p and 1 / p^2, p the real root of p^3 = p + 1.
    constexpr double p = 1.32471795724474602596;
    const auto fraction = [](double v) { return v - std::floor(v); };
    const std::size_t all = std::size_t(pixels.x) * pixels.y;
    std::vector<std::uint8_t> taken(all, 0);
    std::vector<std::size_t> places;
    for (int n = 0; places.size() < std::min(all, std::size_t(std::max(0, count))); ++n) {
        const auto x = std::size_t(fraction(0.5 + n / p) * pixels.x),
                   y = std::size_t(fraction(0.5 + n / (p * p)) * pixels.y);
        std::size_t place = y * std::size_t(pixels.x) + x;
        while (taken[place] != 0) {
            place = (place + 1) % all;
        }
        taken[place] = 1;
        places.push_back(place);
    }
    return places;
}

SpreadError error_at(const std::vector<std::size_t>& places, const Image& found, const Image& truth) {
    double squares = 0.0, fourths = 0.0, sum = 0.0, level = 0.0;
    for (const std::size_t place : places) {
        double square = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double exact = displayed(truth.rgba[4 * place + k]);
            const double apart = displayed(found.rgba[4 * place + k]) - exact;
            square += apart * apart / 3.0;
            sum += apart / 3.0;
            level += exact * exact / 3.0;
        }
        squares += square;
        fourths += square * square;
    }
    const double count = std::max(1.0, double(places.size()));
    SpreadError error;
    error.rmse = std::sqrt(squares / count);
    const double variance =
        std::max(0.0, fourths / count - squares * squares / (count * count)) / std::max(1.0, count - 1.0);
    error.standard_error = error.rmse > 0.0 ? std::sqrt(variance) / (2.0 * error.rmse) : 0.0;
    error.relative_rmse = std::sqrt(squares / std::max(1e-12, level));
    error.bias = sum / count;
    return error;
}

}  // namespace bruma::measure
