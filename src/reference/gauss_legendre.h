#pragma once
#include <cmath>
#include <numbers>
#include <vector>

namespace bruma::reference {

/// Nodes and weights of Gauss-Legendre quadrature on [0, 1]; exact for polynomials of degree 2 n - 1.
struct GaussLegendre {
    explicit GaussLegendre(int n) : node(std::size_t(n)), weight(std::size_t(n)) {
        for (int i = 0; i < n; ++i) {
            // Newton's method on the Legendre polynomial, from Tricomi's estimate of its roots.
            double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
            double slope = 1.0;
            for (int turn = 0; turn < 8; ++turn) {
                double before = 1.0;
                double p = x;
                for (int k = 2; k <= n; ++k) {
                    const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                    before = p;
                    p = next;
                }
                slope = n * (x * p - before) / (x * x - 1.0);
                x -= p / slope;
            }
            node[std::size_t(i)] = 0.5 * (1.0 - x);
            weight[std::size_t(i)] = 1.0 / ((1.0 - x * x) * slope * slope);
        }
    }

    /// Integral of f over [a, b].
    template <class Function>
    auto integrate(double a, double b, const Function& f) const {
        auto sum = weight[0] * f(a + (b - a) * node[0]);
        for (std::size_t i = 1; i < node.size(); ++i) {
            sum += weight[i] * f(a + (b - a) * node[i]);
        }
        return (b - a) * sum;
    }

    std::vector<double> node, weight;
};

}  // namespace bruma::reference
