#include "scene/tone_map.h"

#include <cmath>

namespace bruma::scene {
namespace {

/// Hable 2010, "Uncharted 2: HDR Lighting".
glm::dvec3 filmic_curve(const glm::dvec3& x) {
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
}

}  // namespace

glm::dvec3 tone_mapped(ToneMap tone_map, const glm::dvec3& exposed) {
    glm::dvec3 shown = exposed;
    switch (tone_map) {
        case ToneMap::none:
            break;
        case ToneMap::filmic:
            // Beyond 11.2 all is white, also where a square would overflow.
            shown = filmic_curve(glm::clamp(exposed, 0.0, 1e6)) / filmic_curve(glm::dvec3(11.2));
            break;
    }
    return glm::clamp(shown, 0.0, 1.0);
}

Image shown_image(const Image& linear, const Display& display) {
    const double factor = std::exp2(display.exposure_ev);
    Image shown = linear;
    for (std::size_t n = 0; n < shown.pixel_count(); ++n) {
        float* const rgba = &shown.rgba[4 * n];
        const glm::dvec3 color = tone_mapped(display.tone_map, factor * glm::dvec3(rgba[0], rgba[1], rgba[2]));
        for (int channel = 0; channel < 3; ++channel) {
            rgba[channel] = float(color[channel]);
        }
    }
    return shown;
}

}  // namespace bruma::scene
