#include "reference/cubic.h"

#include <algorithm>
#include <cmath>

namespace bruma::reference {

MonotoneEnds monotone_ends(const Cubic<double>& cubic) {
    MonotoneEnds ends;
    ends.x[std::size_t(ends.count++)] = 0.0;
    const double a = 3.0 * cubic.c3;
    const double b = 2.0 * cubic.c2;
    const double c = cubic.c1;
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant > 0.0) {
        // Both roots without the difference of nearly equal numbers.
        const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
        double first = a != 0.0 ? q / a : -1.0;
        double second = q != 0.0 ? c / q : -1.0;
        if (first > second) {
            std::swap(first, second);
        }
        for (const double root : {first, second}) {
            if (root > ends.x[std::size_t(ends.count - 1)] && root < 1.0) {
                ends.x[std::size_t(ends.count++)] = root;
            }
        }
    }
    ends.x[std::size_t(ends.count++)] = 1.0;
    return ends;
}

double crossing(const Cubic<double>& cubic, double low, double high, double value) {
    const bool rising = cubic.at(high) > cubic.at(low);
    double x = 0.5 * (low + high);
    // Newton's step where it stays inside the bracket, else its middle; 64 halvings exhaust a double.
    for (int turn = 0; turn < 64 && high - low > 0x1p-52; ++turn) {
        const double f = cubic.at(x) - value;
        if (f == 0.0) {
            return x;
        }
        ((f > 0.0) == rising ? high : low) = x;
        const double slope = cubic.c1 + x * (2.0 * cubic.c2 + x * 3.0 * cubic.c3);
        const double newton = x - f / slope;
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - x) < 0x1p-54) {
            return next;
        }
        x = next;
    }
    return x;
}

}  // namespace bruma::reference
