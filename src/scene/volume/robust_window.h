#pragma once
#include <array>
#include <vector>

#include "scene/volume/sample_ranks.h"

namespace bruma::scene {

/// What the samples tell of their own range: fill values, outliers, and a window for the first look.
struct RobustWindow {
    std::vector<FillValue> fills;
    double smallest = 0.0, largest = 0.0;     ///< of all but the fills
    std::array<double, 2> core{0.0, 0.0};     ///< see VolumeGrid
    std::array<double, 2> window{-0.5, 0.5};  ///< never empty
};

/// With R the distance between the 0.1 and 99.9 % ranks of all other samples, the smallest or the largest value is a
/// fill where
///
///     it is one of those in use as fills, and further than R from the next value, or
///     at least 1 % of the samples hold it, and it is further than 10 R from the next value
///
/// so that the background of a real measurement is none. Samples of 8 bits, data of less than four values and of less
/// than a thousand samples have none. The window is the nearest ranks at 0.1 and 99.9 % of the rest; all of its range
/// where both are one value; a half on both sides of a constant. Outliers are the values, of fewer than 0.1 % of the
/// samples, beyond a gap wider than R.
///
/// Leaves the fills out of `ranks`.
RobustWindow robust_window(SampleRanks& ranks, Fills fills);

}  // namespace bruma::scene
