#pragma once
#include <optional>
#include <string>

#include "base/image.h"
#include "scene/scene.h"

namespace bruma::app {

/// Exposures that are proposed, EV: from light of a photometric unit (a sun of 1e5 lx) to a sky in which the sun stands
/// 10 degrees below the horizon. Darker scenes are meant to be dark.
constexpr double most_exposure_ev = 16.0;

struct SuitableExposure {
    double ev = 0.0;       ///< in steps of 0.01
    bool limited = false;  ///< the picture would need more, or less, than is proposed
};

/// The least exposure under which the display, through the scene's tone map, shows a hundredth of a linear picture with
/// a largest channel of 0.9 or above, in linear light, also after rounding to 8 bits and dither. Counts the pixels
/// where something is seen (opacity above 0; outdoors, or if there are none, all) and that are finite, of the hundredth
/// at least four or half of them; where less than that shines, a hundredth of what shines. Nothing for a black picture.
std::optional<SuitableExposure> suitable_exposure(const Image& picture, const scene::Scene& scene);

/// What is to be said of a limited one; empty for others.
std::string limit_words(const SuitableExposure& exposure);

}  // namespace bruma::app
