#include "scene/volume.h"

namespace bruma::scene {

std::array<double, 2> effective_window(const Volume& volume) {
    const VolumeGrid& grid = **volume.grid;
    std::array<double, 2> window = volume.transfer_function->window.value_or(std::array{grid.smallest, grid.largest});
    if (window[0] == window[1]) {
        // A constant volume, or a window of no width: a step at the value, which then sits at u = 1.
        window[0] -= 1.0;
    }
    return window;
}

}  // namespace bruma::scene
