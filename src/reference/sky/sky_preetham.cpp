#include "reference/sky/sky_preetham.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::reference {
namespace {

/// A to E of the distribution, each as slope and offset over the turbidity; rows Y, x, y.
constexpr double distribution[3][5][2] = {
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}},
    {{-0.0193, -0.2592}, {-0.0665, 0.0008}, {-0.0004, 0.2125}, {-0.0641, -0.8989}, {-0.0033, 0.0452}},
    {{-0.0167, -0.2608}, {-0.0950, 0.0092}, {-0.0079, 0.2102}, {-0.0441, -1.6537}, {-0.0109, 0.0529}}};

/// Rows T^2, T, 1; columns third to zeroth power of the sun's zenith angle.
constexpr double zenith_x[3][4] = {
    {0.00166, -0.00375, 0.00209, 0.0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}};
constexpr double zenith_y[3][4] = {
    {0.00275, -0.00610, 0.00317, 0.0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}};

double zenith_chromaticity(const double (&rows)[3][4], double turbidity, double angle) {
    const auto row = [angle](const double(&c)[4]) { return ((c[0] * angle + c[1]) * angle + c[2]) * angle + c[3]; };
    return (row(rows[0]) * turbidity + row(rows[1])) * turbidity + row(rows[2]);
}

double spread(int channel, double turbidity, double zenith_cosine, double gamma) {
    double c[5];
    for (int n = 0; n < 5; ++n) {
        c[n] = distribution[channel][n][0] * turbidity + distribution[channel][n][1];
    }
    const double cosine = std::cos(gamma);
    return (1.0 + c[0] * std::exp(c[1] / std::max(zenith_cosine, 0.01))) *
           (1.0 + c[2] * std::exp(c[3] * gamma) + c[4] * cosine * cosine);
}

}  // namespace

glm::dvec3 preetham_zenith_Yxy(double turbidity, double sun_zenith_angle) {
    const double chi = (4.0 / 9.0 - turbidity / 120.0) * (std::numbers::pi - 2.0 * sun_zenith_angle);
    return {(4.0453 * turbidity - 4.9710) * std::tan(chi) - 0.2155 * turbidity + 2.4192,
            zenith_chromaticity(zenith_x, turbidity, sun_zenith_angle),
            zenith_chromaticity(zenith_y, turbidity, sun_zenith_angle)};
}

glm::dvec3 preetham_Yxy(double turbidity, double view_zenith_angle, double sun_zenith_angle, double gamma) {
    glm::dvec3 result = preetham_zenith_Yxy(turbidity, sun_zenith_angle);
    for (int channel = 0; channel < 3; ++channel) {
        result[channel] *= spread(channel, turbidity, std::cos(view_zenith_angle), gamma) /
                           spread(channel, turbidity, 1.0, sun_zenith_angle);
    }
    return result;
}

glm::dvec3 rec709_from_Yxy(const glm::dvec3& Yxy) {
    const double scale = Yxy.x / Yxy.z;
    const double X = Yxy.y * scale, Y = Yxy.x, Z = (1.0 - Yxy.y - Yxy.z) * scale;
    return {3.2404542 * X - 1.5371385 * Y - 0.4985314 * Z, -0.9692660 * X + 1.8760108 * Y + 0.0415560 * Z,
            0.0556434 * X - 0.2040259 * Y + 1.0572252 * Z};
}

}  // namespace bruma::reference
