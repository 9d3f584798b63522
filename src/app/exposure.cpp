#include "app/exposure.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/tone_map.h"

namespace bruma::app {
namespace {

using Colors = std::vector<glm::vec3>;

float largest_channel(const glm::vec3& color) {
    return std::max({color.r, color.g, color.b});
}

/// Finite pixels that count.
Colors seen_colors(const Image& picture, bool background_too) {
    Colors seen, all;
    for (std::size_t n = 0; n < picture.pixel_count(); ++n) {
        const float* rgba = &picture.rgba[4 * n];
        const glm::vec3 color(rgba[0], rgba[1], rgba[2]);
        if (!std::isfinite(color.r + color.g + color.b)) {
            continue;
        }
        all.push_back(color);
        if (rgba[3] > 0.0F) {
            seen.push_back(color);
        }
    }
    return seen.empty() || background_too ? all : seen;
}

std::size_t hundredth(std::size_t count) {
    return std::max((count + 99) / 100, std::min<std::size_t>(4, (count + 1) / 2));
}

}  // namespace

std::optional<SuitableExposure> suitable_exposure(const Image& picture, const scene::Scene& scene) {
    // 0.9 in 8 bits too: a step there is 0.008 at most.
    constexpr double brightness = 0.91;
    Colors colors = seen_colors(picture, scene.outdoors.has_value());
    const std::size_t wanted = hundredth(colors.size());
    std::erase_if(colors, [](const glm::vec3& color) { return !(largest_channel(color) > 0.0F); });
    if (colors.empty()) {
        return std::nullopt;
    }
    const std::size_t needed = colors.size() < wanted ? hundredth(colors.size()) : wanted;
    const auto is_bright = [&](int centi_ev) {
        const double factor = std::exp2(0.01 * centi_ev);
        std::size_t bright = 0;
        for (const glm::vec3& color : colors) {
            bright +=
                largest_channel(scene::tone_mapped(scene.display->tone_map, factor * glm::dvec3(color))) >= brightness;
            if (bright >= needed) {
                return true;
            }
        }
        return false;
    };
    const int most = int(std::lround(100.0 * most_exposure_ev));
    int dark = -most, bright = most;
    if (is_bright(dark)) {
        return SuitableExposure{-most_exposure_ev, true};
    }
    if (!is_bright(bright)) {
        return SuitableExposure{most_exposure_ev, true};
    }
    while (bright - dark > 1) {
        const int middle = (dark + bright) / 2;
        (is_bright(middle) ? bright : dark) = middle;
    }
    return SuitableExposure{0.01 * bright, false};
}

std::string limit_words(const SuitableExposure& exposure) {
    if (!exposure.limited) {
        return {};
    }
    return fmt::format("the picture is so {} that {:+g} EV, the last exposure that is proposed, leaves it {}",
                       exposure.ev > 0.0 ? "dark" : "bright", exposure.ev, exposure.ev > 0.0 ? "dark" : "white");
}

}  // namespace bruma::app
