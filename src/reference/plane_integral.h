#pragma once
#include <algorithm>
#include <numbers>

#include "reference/gauss_legendre.h"

namespace bruma::reference {

/// Integral of f(rho) 2 pi rho over the plane, or a disk, for f that decays like e^(-rate rho) and is smooth on the
/// scale of its distance from 0: Gauss-Legendre panels that widen by halves.
template <class Function>
double integrate_plane(double rate, double finest, const Function& f, double radius = 1e300) {
    static const GaussLegendre rule(12);
    const double end = std::min(radius, 60.0 / rate);
    double sum = 0.0;
    double from = 0.0;
    while (from < end) {
        const double to = std::min(end, std::max(finest, 1.5 * from));
        sum += rule.integrate(from, to, [&](double rho) { return 2.0 * std::numbers::pi * rho * f(rho); });
        from = to;
    }
    return sum;
}

}  // namespace bruma::reference
