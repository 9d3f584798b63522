#include "measure/metrics/flip.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "measure/metrics/flip_color.h"
#include "measure/metrics/image_error.h"

namespace bruma::measure {
namespace {

constexpr double pi = std::numbers::pi;

/// One value per pixel; outside, the border pixels go on.
struct Plane {
    int width, height;
    std::vector<double> values;

    Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * h) {}
    double& at(int x, int y) { return values[std::size_t(y) * width + x]; }
    double at(int x, int y) const { return values[std::size_t(y) * width + x]; }
};

/// Odd number of taps, centred.
using Kernel = std::vector<double>;

template <class Tap>
Kernel kernel_of(int radius, Tap tap) {
    Kernel kernel;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(tap(double(x)));
    }
    return kernel;
}

Kernel with_sum_one(Kernel kernel) {
    double sum = 0.0;
    for (const double tap : kernel) {
        sum += tap;
    }
    for (double& tap : kernel) {
        tap /= sum;
    }
    return kernel;
}

/// Positive taps sum to 1, negative ones to -1.
Kernel with_balanced_signs(Kernel kernel) {
    double positive = 0.0;
    double negative = 0.0;
    for (const double tap : kernel) {
        (tap > 0.0 ? positive : negative) += std::abs(tap);
    }
    for (double& tap : kernel) {
        tap /= tap > 0.0 ? positive : negative > 0.0 ? negative : 1.0;
    }
    return kernel;
}

/// Along rows with one kernel, then along columns with another.
Plane convolve(const Plane& plane, const Kernel& along_x, const Kernel& along_y) {
    const int radius_x = int(along_x.size() / 2);
    const int radius_y = int(along_y.size() / 2);
    Plane rows(plane.width, plane.height);
    tbb::parallel_for(0, plane.height, [&](int y) {
        for (int x = 0; x < plane.width; ++x) {
            double sum = 0.0;
            for (int k = -radius_x; k <= radius_x; ++k) {
                sum += along_x[k + radius_x] * plane.at(std::clamp(x + k, 0, plane.width - 1), y);
            }
            rows.at(x, y) = sum;
        }
    });
    Plane result(plane.width, plane.height);
    tbb::parallel_for(0, plane.height, [&](int y) {
        for (int k = -radius_y; k <= radius_y; ++k) {
            const int from = std::clamp(y + k, 0, plane.height - 1);
            for (int x = 0; x < plane.width; ++x) {
                result.at(x, y) += along_y[k + radius_y] * rows.at(x, from);
            }
        }
    });
    return result;
}

/// Contrast sensitivity of the eye for one opponent channel: a sum of Gaussians, table 1 of the paper.
struct Sensitivity {
    double a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity red_green{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity blue_yellow{34.1, 0.04, 13.5, 0.025};

/// a sqrt(pi / b) exp(-pi^2 d^2 / b), d in degrees, is a Gaussian and so the product of one along x and one along y;
/// the two terms share the sum of all their weights.
Plane filter_as_seen(const Plane& plane, const Sensitivity& sensitivity, double pixels_per_degree) {
    const double widest = 0.04;  // the largest b of the table
    const int radius = int(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
    const auto gaussian = [&](double b) {
        return kernel_of(radius, [&](double x) {
            const double degrees = x / pixels_per_degree;
            return std::exp(-pi * pi * degrees * degrees / b);
        });
    };
    const auto weight = [](double a, double b, const Kernel& kernel) {
        double sum = 0.0;
        for (const double tap : kernel) {
            sum += tap;
        }
        return a * std::sqrt(pi / b) * sum * sum;
    };
    const Kernel first = gaussian(sensitivity.b1);
    Plane result = convolve(plane, with_sum_one(first), with_sum_one(first));
    if (sensitivity.a2 > 0.0) {
        const Kernel second = gaussian(sensitivity.b2);
        const Plane other = convolve(plane, with_sum_one(second), with_sum_one(second));
        const double first_weight = weight(sensitivity.a1, sensitivity.b1, first);
        const double second_weight = weight(sensitivity.a2, sensitivity.b2, second);
        const double share = second_weight / (first_weight + second_weight);
        for (std::size_t n = 0; n < result.values.size(); ++n) {
            result.values[n] += share * (other.values[n] - result.values[n]);
        }
    }
    return result;
}

/// What is compared: perceived colours, and edges and points of the lightness.
struct Perceived {
    std::vector<glm::dvec3> hunt_lab;
    std::vector<double> edges, points;
};

std::vector<double> lengths(const Plane& x, const Plane& y) {
    std::vector<double> result(x.values.size());
    for (std::size_t n = 0; n < result.size(); ++n) {
        result[n] = std::hypot(x.values[n], y.values[n]);
    }
    return result;
}

Perceived perceive(const Image& image, double pixels_per_degree) {
    Plane y(image.width, image.height);
    Plane cx = y;
    Plane cz = y;
    Plane lightness = y;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        glm::dvec3 rgb;
        for (int channel = 0; channel < 3; ++channel) {
            const double value = image.rgba[4 * n + std::size_t(channel)];
            rgb[channel] = value > 0.0 ? std::min(value, 1.0) : 0.0;  // NaN: 0
        }
        const glm::dvec3 ycxcz = ycxcz_of_rgb(rgb);
        y.values[n] = ycxcz.x;
        cx.values[n] = ycxcz.y;
        cz.values[n] = ycxcz.z;
        lightness.values[n] = (ycxcz.x + 16.0) / 116.0;
    }
    Perceived result;
    const Plane seen_y = filter_as_seen(y, achromatic, pixels_per_degree);
    const Plane seen_cx = filter_as_seen(cx, red_green, pixels_per_degree);
    const Plane seen_cz = filter_as_seen(cz, blue_yellow, pixels_per_degree);
    result.hunt_lab.resize(image.pixel_count());
    tbb::parallel_for(std::size_t(0), image.pixel_count(), [&](std::size_t n) {
        const glm::dvec3 rgb = rgb_of_ycxcz({seen_y.values[n], seen_cx.values[n], seen_cz.values[n]});
        result.hunt_lab[n] = hunt_lab_of_rgb(glm::clamp(rgb, 0.0, 1.0));
    });
    // Feature detectors as wide as an edge appears to the eye: 0.082 degrees.
    const double deviation = 0.5 * 0.082 * pixels_per_degree;
    const int radius = int(std::ceil(3.0 * deviation));
    const auto gaussian = [&](double x) { return std::exp(-x * x / (2.0 * deviation * deviation)); };
    const Kernel smooth = with_sum_one(kernel_of(radius, gaussian));
    const Kernel edge = with_balanced_signs(kernel_of(radius, [&](double x) { return -x * gaussian(x); }));
    const Kernel point = with_balanced_signs(
        kernel_of(radius, [&](double x) { return (x * x / (deviation * deviation) - 1.0) * gaussian(x); }));
    result.edges = lengths(convolve(lightness, edge, smooth), convolve(lightness, smooth, edge));
    result.points = lengths(convolve(lightness, point, smooth), convolve(lightness, smooth, point));
    return result;
}

/// Colour difference in [0, 1]: HyAB to the power 0.7, most of the range given to small differences.
double color_difference(glm::dvec3 lab_a, glm::dvec3 lab_b) {
    constexpr double exponent = 0.7;
    constexpr double knee = 0.4;         // share of the largest difference ...
    constexpr double knee_value = 0.95;  // ... that is mapped to this
    static const double largest =
        std::pow(hyab(hunt_lab_of_rgb({0.0, 1.0, 0.0}), hunt_lab_of_rgb({0.0, 0.0, 1.0})), exponent);
    const double difference = std::pow(hyab(lab_a, lab_b), exponent);
    if (difference < knee * largest) {
        return knee_value / (knee * largest) * difference;
    }
    return std::min(1.0, knee_value + (difference - knee * largest) / (largest - knee * largest) * (1.0 - knee_value));
}

}  // namespace

std::vector<float> flip_map(const Image& a, const Image& reference, double pixels_per_degree) {
    check_comparable(a, reference);
    const Perceived seen_a = perceive(a, pixels_per_degree);
    const Perceived seen_b = perceive(reference, pixels_per_degree);
    std::vector<float> map(a.pixel_count());
    for (std::size_t n = 0; n < map.size(); ++n) {
        const double color = color_difference(seen_a.hunt_lab[n], seen_b.hunt_lab[n]);
        const double structure =
            std::max(std::abs(seen_a.edges[n] - seen_b.edges[n]), std::abs(seen_a.points[n] - seen_b.points[n]));
        const double feature = std::min(1.0, std::sqrt(structure / std::numbers::sqrt2));
        const int x = int(n % std::size_t(a.width));
        const int y = int(n / std::size_t(a.width));
        const bool finite = std::isfinite(pixel_difference(a, reference, x, y));
        map[n] = finite ? float(std::pow(color, 1.0 - feature)) : 1.0F;
    }
    return map;
}

double mean_flip(const Image& a, const Image& reference, double pixels_per_degree) {
    double sum = 0.0;
    const std::vector<float> map = flip_map(a, reference, pixels_per_degree);
    for (const float value : map) {
        sum += value;
    }
    return sum / double(map.size());
}

}  // namespace bruma::measure
