#include "app/viewer/quality.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::app {
namespace {

/// Few scales, so that the textures drawn into are not made anew at each frame.
constexpr std::array<double, 6> scales{1.0, 0.75, 0.5, 0.375, 0.3, 0.25};
constexpr double largest_step_scale = 4.0;

glm::ivec2 scaled(glm::ivec2 area, double scale) {
    return glm::max(glm::ivec2(1), glm::ivec2(glm::ceil(glm::dvec2(area) * scale)));
}

}  // namespace

render::View QualityController::moving(glm::ivec2 area) const {
    if (ms_per_pixel_ < 0.0) {
        return {scaled(area, scales.back()), largest_step_scale};
    }
    // The march gets what the other passes leave, but not less than a third, else it would become a blur.
    const double budget_ms = std::max(target_ms - other_ms_, target_ms / 3.0);
    for (const double scale : scales) {
        const glm::ivec2 pixels = scaled(area, scale);
        const double ms = ms_per_pixel_ * pixels.x * pixels.y;
        if (ms <= budget_ms) {
            return {pixels, 1.0};
        }
        if (scale == scales.back()) {
            return {pixels, std::min(largest_step_scale, ms / budget_ms)};
        }
    }
    return refined(area);
}

void QualityController::measured(const render::View& view, double march_ms, double other_ms) {
    const double pixels = double(view.pixels.x) * view.pixels.y;
    if (pixels > 0.0 && march_ms > 0.0) {
        ms_per_pixel_ = march_ms * view.step_scale / pixels;
    }
    other_ms_ = other_ms;
}

}  // namespace bruma::app
