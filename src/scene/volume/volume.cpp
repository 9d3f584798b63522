#include "scene/volume/volume.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {

std::array<double, 2> effective_window(const Volume& volume) {
    const VolumeGrid& grid = **volume.grid;
    std::array<double, 2> window = volume.transfer_function->window.value_or(grid.core);
    if (std::abs(window[1] - window[0]) < 1e-300) {
        // A constant volume, or a window of no width: a step at the value, which then sits at u = 1. Beside 1e30 a
        // width of 1 would be none, and the inverse of a denormal width has no number.
        window[0] = window[1] - std::max(1.0, 1e-3 * std::abs(window[1]));
    }
    return window;
}

double shading_range(const Volume& volume) {
    const std::array<double, 2> core = (*volume.grid)->core;
    const std::array<double, 2> window = volume.transfer_function->window.value_or(core);
    constexpr double narrowest = 1e-12;  // floats cannot tell samples from one another any more, long before
    const double width = std::abs(window[1] - window[0]);
    const double widest = core[1] - core[0];
    return width > 0.0 ? std::clamp(width, narrowest * widest, widest) : widest;
}

}  // namespace bruma::scene
