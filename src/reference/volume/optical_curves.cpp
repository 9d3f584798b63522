#include "reference/volume/optical_curves.h"

#include <algorithm>
#include <limits>

namespace bruma::reference {
namespace {

/// Opacities above this count as this (see scene::extinction_of_opacity): a bend of the curve.
constexpr double saturated_opacity = 1.0 - 0x1p-16;

std::vector<double> knots_of(const scene::TransferFunction& tf) {
    std::vector<double> knots{0.0, 1.0};
    const auto add = [&](double position) {
        const double u = u_of_position(tf, position);
        if (u > 0.0 && u < 1.0) {
            knots.push_back(u);
        }
    };
    for (const auto& point : tf.opacity) {
        add(point.position);
    }
    for (const auto& point : tf.color) {
        add(point.position);
    }
    for (const auto& point : tf.emission) {
        add(point.position);
    }
    for (std::size_t n = 1; n < tf.opacity.size(); ++n) {
        const auto& a = tf.opacity[n - 1];
        const auto& b = tf.opacity[n];
        if ((a.opacity < saturated_opacity) != (b.opacity < saturated_opacity)) {
            add(a.position + (b.position - a.position) * (saturated_opacity - a.opacity) / (b.opacity - a.opacity));
        }
    }
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    return knots;
}

}  // namespace

OpticalCurves::OpticalCurves(scene::TransferFunction transfer_function, double density_scale, double emission)
    : transfer_function_(std::move(transfer_function)), density_scale_(density_scale), emission_(emission) {
    scene::normalise(transfer_function_);
    knots_ = knots_of(transfer_function_);
    between_.push_back(constant_stretch(0.0));
    for (std::size_t n = 1; n < knots_.size(); ++n) {
        between_.push_back(stretch_between(knots_[n - 1], knots_[n]));
    }
    between_.push_back(constant_stretch(1.0));
    for (const double knot : knots_) {
        on_knot_.push_back(constant_stretch(knot));
    }
    opaque_before_.push_back(0);
    for (const CurveStretch& stretch : between_) {
        opaque_before_.push_back(opaque_before_.back() + (stretch.transparent ? 0 : 1));
    }
}

CurveStretch OpticalCurves::constant_stretch(double u) const {
    CurveStretch stretch;
    stretch.u_low = u;
    stretch.opacity = opacity_at(transfer_function_, u);
    stretch.color = color_at(transfer_function_, u);
    stretch.emission = emission_ + emission_at(transfer_function_, u);
    stretch.transparent = stretch.opacity == 0.0 || density_scale_ == 0.0;
    return stretch;
}

CurveStretch OpticalCurves::stretch_between(double u_low, double u_high) const {
    // Two points inside, since the curves may jump at both ends.
    const double u_a = u_low + 0.25 * (u_high - u_low);
    const double u_b = u_low + 0.75 * (u_high - u_low);
    if (!(u_b > u_a)) {
        return constant_stretch(u_low);
    }
    const CurveStretch a = constant_stretch(u_a);
    const CurveStretch b = constant_stretch(u_b);
    const double width = u_b - u_a;
    const double back = u_a - u_low;
    CurveStretch stretch;
    stretch.u_low = u_low;
    stretch.opacity_slope = (b.opacity - a.opacity) / width;
    stretch.opacity = a.opacity - stretch.opacity_slope * back;
    stretch.color_slope = (b.color - a.color) / width;
    stretch.color = a.color - stretch.color_slope * back;
    stretch.emission_slope = (b.emission - a.emission) / width;
    stretch.emission = a.emission - stretch.emission_slope * back;
    stretch.transparent = a.transparent && b.transparent;
    return stretch;
}

const CurveStretch& OpticalCurves::stretch_at(double u) const {
    const auto above = std::upper_bound(knots_.begin(), knots_.end(), u);
    const auto n = std::size_t(above - knots_.begin());
    return n > 0 && knots_[n - 1] == u ? on_knot_[n - 1] : between_[n];
}

bool OpticalCurves::is_transparent(double u_low, double u_high) const {
    // Touching a knot counts both of its sides, so that a jump there is never missed.
    const auto first = std::lower_bound(knots_.begin(), knots_.end(), u_low) - knots_.begin();
    const auto last = std::upper_bound(knots_.begin(), knots_.end(), u_high) - knots_.begin();
    return opaque_before_[std::size_t(last + 1)] == opaque_before_[std::size_t(first)];
}

std::array<double, 2> OpticalCurves::extinction_range(double u_low, double u_high) const {
    std::array<double, 2> range{std::numeric_limits<double>::infinity(), 0.0};
    const auto include = [&](const CurveStretch& stretch, double u) {
        const double extinction = at(stretch, u).extinction;
        range = {std::min(range[0], extinction), std::max(range[1], extinction)};
    };
    // Opacity is monotone on a stretch, and so is every rounded step from it to the extinction.
    const auto first = std::size_t(std::lower_bound(knots_.begin(), knots_.end(), u_low) - knots_.begin());
    const auto last = std::size_t(std::upper_bound(knots_.begin(), knots_.end(), u_high) - knots_.begin());
    for (std::size_t n = first; n <= last; ++n) {
        include(between_[n], n > first ? knots_[n - 1] : u_low);
        include(between_[n], n < last ? knots_[n] : u_high);
        if (n < last) {
            include(on_knot_[n], knots_[n]);
        }
    }
    return range;
}

}  // namespace bruma::reference
