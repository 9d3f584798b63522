#pragma once
#include <algorithm>
#include <cmath>

namespace bruma::app {

/// How opacities are laid out along the height of the editor. The stretched ones make room near 0, where thin matter
/// lives: on the logarithmic one 0.001 stands at a quarter of the height. All of them map 0 to 0 and 1 to 1.
enum class OpacityScale { linear, square_root, logarithmic };

/// Opacity below which the logarithmic scale becomes linear.
constexpr double smallest_decade = 1e-4;

inline double height_of_opacity(OpacityScale scale, double opacity) {
    const double o = std::clamp(opacity, 0.0, 1.0);
    switch (scale) {
        case OpacityScale::square_root:
            return std::sqrt(o);
        case OpacityScale::logarithmic:
            return std::log1p(o / smallest_decade) / std::log1p(1.0 / smallest_decade);
        default:
            return o;
    }
}
inline double opacity_of_height(OpacityScale scale, double height) {
    const double h = std::clamp(height, 0.0, 1.0);
    switch (scale) {
        case OpacityScale::square_root:
            return h * h;
        case OpacityScale::logarithmic:
            return std::min(1.0, smallest_decade * std::expm1(h * std::log1p(1.0 / smallest_decade)));
        default:
            return h;
    }
}

}  // namespace bruma::app
