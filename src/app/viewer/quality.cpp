#include "app/viewer/quality.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::app {
namespace {

/// Few scales, so that the textures drawn into are not made anew at each frame.
constexpr std::array<double, 6> scales{1.0, 0.75, 0.5, 0.375, 0.3, 0.25};
constexpr double largest_step_scale = 4.0;
/// Of a march, what one that takes clouds from the last picture is thought to cost before one was measured.
constexpr double guessed_share_from_last = 0.2;

glm::ivec2 scaled(glm::ivec2 area, double scale) {
    return glm::max(glm::ivec2(1), glm::ivec2(glm::ceil(glm::dvec2(area) * scale)));
}

}  // namespace

render::View QualityController::moving(glm::ivec2 area, bool from_last) const {
    const auto view = [&](double scale, double step_scale) {
        return render::View{.pixels = scaled(area, scale), .step_scale = step_scale, .in_window = true};
    };
    if (ms_per_pixel_ < 0.0) {
        return view(scales.back(), largest_step_scale);
    }
    const double ms_per_pixel = !from_last                      ? ms_per_pixel_
                                : ms_per_pixel_from_last_ < 0.0 ? guessed_share_from_last * ms_per_pixel_
                                                                : ms_per_pixel_from_last_;
    // The march gets what the other passes leave, but not less than a third, else it would become a blur.
    const double budget_ms = std::max(target_ms - other_ms_, target_ms / 3.0);
    for (const double scale : scales) {
        const glm::ivec2 pixels = scaled(area, scale);
        const double ms = ms_per_pixel * pixels.x * pixels.y;
        if (ms <= budget_ms) {
            return view(scale, 1.0);
        }
        if (scale == scales.back()) {
            return view(scale, std::min(largest_step_scale, ms / budget_ms));
        }
    }
    return refined(area);
}

void QualityController::measured(const render::View& view, double march_ms, double other_ms, bool from_last) {
    const double pixels = double(view.pixels.x) * view.pixels.y;
    if (pixels > 0.0 && march_ms > 0.0) {
        (from_last ? ms_per_pixel_from_last_ : ms_per_pixel_) = march_ms * view.step_scale / pixels;
    }
    other_ms_ = other_ms;
}

}  // namespace bruma::app
