#include "render/light/cone_kernel.h"

#include <cmath>

namespace bruma::render {

std::array<double, 9> cone_kernel(double g, double cone_angle_rad, glm::dvec3 cell, glm::dvec2 shift_cells) {
    // The phase function is narrower than a cell for large g, so it is integrated over each of them.
    constexpr int fine = 15;
    const glm::dvec3 crossing(shift_cells * glm::dvec2(cell), cell.z);
    const glm::dvec3 omega = glm::normalize(crossing);
    std::array<double, 9> weights{};
    double sum = 0.0;
    for (int n = 0; n < 9; ++n) {
        const int row = n / 3 - 1;
        for (int j = 0; j < fine; ++j) {
            for (int i = 0; i < fine; ++i) {
                const glm::dvec3 way = crossing + glm::dvec3(cell.x * (n % 3 - 1 + (i + 0.5) / fine - 0.5),
                                                             cell.y * (row + (j + 0.5) / fine - 0.5), 0.0);
                const double distance = glm::length(way);
                const double cosine = glm::dot(omega, way) / distance;
                if (cosine < std::cos(cone_angle_rad)) {
                    continue;
                }
                const double spread = 1.0 + g * g - 2.0 * g * cosine;
                const double solid_angle = cell.z / (distance * distance * distance);
                weights[std::size_t(n)] += (1.0 - g * g) / (spread * std::sqrt(spread)) * solid_angle;
            }
        }
        sum += weights[std::size_t(n)];
    }
    if (!(sum > 0.0)) {  // a cone narrower than a fifteenth of a cell
        weights[4] = sum = 1.0;
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

}  // namespace bruma::render
