#pragma once
#include <array>
#include <glm/glm.hpp>

namespace bruma::reference {

/// c0 + c1 x + c2 x^2 + c3 x^3, of numbers or of vectors. A trilinear field along a straight ray inside one cell.
template <class Value>
struct Cubic {
    Value c0{}, c1{}, c2{}, c3{};
    Value at(double x) const { return c0 + x * (c1 + x * (c2 + x * c3)); }
};

/// The trilinear field of a cell along the line from cell coordinate `a` to `a + b`, for x in [0, 1]; corner index is
/// x + 2 y + 4 z. Where the corners agree along an axis, that axis drops out exactly.
template <class Value>
Cubic<Value> cubic_along(const std::array<Value, 8>& s, glm::dvec3 a, glm::dvec3 b) {
    const Value kx = s[1] - s[0];
    const Value ky = s[2] - s[0];
    const Value kz = s[4] - s[0];
    const Value kxy = (s[3] - s[2]) - kx;
    const Value kxz = (s[5] - s[4]) - kx;
    const Value kyz = (s[6] - s[4]) - ky;
    const Value kxyz = ((s[7] - s[6]) - (s[5] - s[4])) - kxy;
    return {
        s[0] + kx * a.x + ky * a.y + kz * a.z + kxy * (a.x * a.y) + kxz * (a.x * a.z) + kyz * (a.y * a.z) +
            kxyz * (a.x * a.y * a.z),
        kx * b.x + ky * b.y + kz * b.z + kxy * (a.x * b.y + b.x * a.y) + kxz * (a.x * b.z + b.x * a.z) +
            kyz * (a.y * b.z + b.y * a.z) + kxyz * (b.x * a.y * a.z + a.x * b.y * a.z + a.x * a.y * b.z),
        kxy * (b.x * b.y) + kxz * (b.x * b.z) + kyz * (b.y * b.z) +
            kxyz * (a.x * b.y * b.z + b.x * a.y * b.z + b.x * b.y * a.z),
        kxyz * (b.x * b.y * b.z),
    };
}

/// The ends of the stretches of [0, 1] on which the cubic is monotone: 0, up to two turning points, 1.
struct MonotoneEnds {
    std::array<double, 4> x{};
    int count = 0;
};
MonotoneEnds monotone_ends(const Cubic<double>& cubic);

/// Where the cubic, monotone on [low, high], takes a value that lies between its values at both ends.
double crossing(const Cubic<double>& cubic, double low, double high, double value);

}  // namespace bruma::reference
