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
        // Another size costs a picture the sharpness of the last: stay unless another is clearly right.
        const double slack = !from_last || pixels.x < last_pixels_.x ? 1.0 : pixels.x > last_pixels_.x ? 0.6 : 1.3;
        if (ms <= slack * budget_ms) {
            return view(scale, 1.0);
        }
        if (scale == scales.back()) {
            // Longer steps save little where most pixels are not marched, and steps that change are seen.
            return view(scale, from_last ? 1.0 : std::min(largest_step_scale, ms / budget_ms));
        }
    }
    return refined(area);
}

void QualityController::measured(const render::View& view, double march_ms, double other_ms, bool from_last) {
    const double pixels = double(view.pixels.x) * view.pixels.y;
    if (pixels > 0.0 && march_ms > 0.0) {
        const double ms_per_pixel = march_ms * view.step_scale / pixels;
        if (!from_last) {
            ms_per_pixel_ = ms_per_pixel;
        } else {
            // It follows the motion, so two in a row count half each; and a first one that compiled shaders is no cost.
            const double bounded = std::min(ms_per_pixel, std::max(ms_per_pixel_, 0.0));
            const double before = ms_per_pixel_from_last_ < 0.0 ? bounded : ms_per_pixel_from_last_;
            ms_per_pixel_from_last_ = 0.5 * (before + bounded);
        }
    }
    other_ms_ = other_ms;
    last_pixels_ = view.pixels;
}

}  // namespace bruma::app
