#pragma once
#include <optional>

#include "base/image.h"

namespace bruma::app {

/// Exposure, EV in steps of 0.01, under which the 99th percentile of a linear picture's largest channel is 0.9, which
/// leaves highlights room. Counts the pixels where something is seen (opacity above 0), or all if there are none.
/// Nothing for a black picture, or one whose percentile is no finite number.
std::optional<double> suitable_exposure_ev(const Image& picture);

}  // namespace bruma::app
