#include "scene/volume/transfer_function.h"

#include <algorithm>
#include <cmath>

namespace bruma::scene {
namespace {

/// Piecewise linear in position, constant outside; `empty` when there is no point. Of several points at one position
/// the last one counts from there on, so two points may make a step.
template <class Point, class Get>
auto interpolate(const std::vector<Point>& points, double position, Get get, decltype(get(points[0])) empty) {
    if (points.empty()) {
        return empty;
    }
    const auto above = std::upper_bound(points.begin(), points.end(), position,
                                        [](double x, const Point& point) { return x < point.position; });
    if (above == points.begin()) {
        return get(points.front());
    }
    if (above == points.end()) {
        return get(points.back());
    }
    const Point& a = *(above - 1);
    const Point& b = *above;
    const double f = (position - a.position) / (b.position - a.position);
    return get(a) * (1.0 - f) + get(b) * f;
}

}  // namespace

double u_of_position(const TransferFunction& tf, double position) {
    const double width = tf.domain[1] - tf.domain[0];
    return width != 0.0 ? (position - tf.domain[0]) / width : 0.0;
}

double position_of_u(const TransferFunction& tf, double u) {
    return tf.domain[0] + u * (tf.domain[1] - tf.domain[0]);
}

double opacity_at(const TransferFunction& tf, double u) {
    return interpolate(
        tf.opacity, position_of_u(tf, std::clamp(u, 0.0, 1.0)), [](const OpacityPoint& point) { return point.opacity; },
        0.0);
}

glm::dvec3 color_at(const TransferFunction& tf, double u) {
    return interpolate(
        tf.color, position_of_u(tf, std::clamp(u, 0.0, 1.0)), [](const ColorPoint& point) { return point.color; },
        glm::dvec3(1.0));
}

double emission_at(const TransferFunction& tf, double u) {
    return interpolate(
        tf.emission, position_of_u(tf, std::clamp(u, 0.0, 1.0)),
        [](const EmissionPoint& point) { return point.emission; }, 0.0);
}

double extinction_of_opacity(double opacity, double reference_length) {
    const double clamped = std::clamp(opacity, 0.0, 1.0 - 0x1p-16);
    return -std::log1p(-clamped) / reference_length;
}

void normalise(TransferFunction& tf) {
    const auto by_position = [](const auto& a, const auto& b) { return a.position < b.position; };
    std::stable_sort(tf.opacity.begin(), tf.opacity.end(), by_position);
    std::stable_sort(tf.color.begin(), tf.color.end(), by_position);
    std::stable_sort(tf.emission.begin(), tf.emission.end(), by_position);
    for (OpacityPoint& point : tf.opacity) {
        point.opacity = std::clamp(point.opacity, 0.0, 1.0);
    }
}

}  // namespace bruma::scene
