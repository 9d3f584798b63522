#pragma once
#include <algorithm>

/// GLSL's functions of the same names, in double.
namespace bruma::reference {

inline double saturate(double v) {
    return std::clamp(v, 0.0, 1.0);
}

inline double mix(double a, double b, double t) {
    return (1.0 - t) * a + t * b;
}

/// 0 below `from`, 1 above `to`, 3 f^2 - 2 f^3 between; a step where both are equal.
inline double smoothstep(double from, double to, double x) {
    if (from == to) {
        return x >= from ? 1.0 : 0.0;
    }
    const double f = saturate((x - from) / (to - from));
    return f * f * (3.0 - 2.0 * f);
}

}  // namespace bruma::reference
