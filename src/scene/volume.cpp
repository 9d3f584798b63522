#include "scene/volume.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {

std::array<double, 2> effective_window(const Volume& volume) {
    const VolumeGrid& grid = **volume.grid;
    std::array<double, 2> window = volume.transfer_function->window.value_or(std::array{grid.smallest, grid.largest});
    if (std::abs(window[1] - window[0]) < 1e-300) {
        // A constant volume, or a window of no width: a step at the value, which then sits at u = 1. Beside 1e30 a
        // width of 1 would be none, and the inverse of a denormal width has no number.
        window[0] = window[1] - std::max(1.0, 1e-3 * std::abs(window[1]));
    }
    return window;
}

}  // namespace bruma::scene
