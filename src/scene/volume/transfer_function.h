#pragma once
#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/field.h"

namespace bruma::scene {

struct OpacityPoint {
    double position;  ///< in the transfer function's domain
    double opacity;   ///< [0, 1]: share of light lost over `reference_length`
    bool operator==(const OpacityPoint&) const = default;
};
struct ColorPoint {
    double position;   ///< in the transfer function's domain
    glm::dvec3 color;  ///< linear Rec.709
    bool operator==(const ColorPoint&) const = default;
};
struct EmissionPoint {
    double position;  ///< in the transfer function's domain
    double emission;  ///< >= 0: light added of its own, in units of the colour at this position
    bool operator==(const EmissionPoint&) const = default;
};

/// Maps a data value to optical properties. All curves are piecewise linear between their points and constant outside.
///
/// A data value v becomes u = (v - window[0]) / (window[1] - window[0]), clamped to [0,1]; a control point at position
/// p sits at u = (p - domain[0]) / (domain[1] - domain[0]). Without a window the data's own range is used, without
/// fill values and outliers, so that a preset with domain [0,1] fits any data, while a file may speak of values with
/// domain equal to window.
///
/// Extinction is sigma_t = -ln(1 - opacity) / reference_length with opacity clamped to 1 - 2^-16.
struct TransferFunction {
    std::array<double, 2> domain{0.0, 1.0};
    std::optional<std::array<double, 2>> window;
    std::vector<OpacityPoint> opacity{{0.0, 0.0}, {1.0, 0.5}};
    std::vector<ColorPoint> color{{0.0, glm::dvec3(1.0)}};
    std::vector<EmissionPoint> emission;
    double reference_length = 1e-3;  ///< metres

    bool operator==(const TransferFunction&) const = default;
};

/// Curves at u in [0,1] (clamped). Exact: no table in between.
double opacity_at(const TransferFunction& tf, double u);
glm::dvec3 color_at(const TransferFunction& tf, double u);
double emission_at(const TransferFunction& tf, double u);

/// Extinction in 1/m of an opacity over the reference length, finite for every input.
double extinction_of_opacity(double opacity, double reference_length);

/// u of a position in the domain; total: an empty domain maps to 0.
double u_of_position(const TransferFunction& tf, double position);
/// Position in the domain of a u.
double position_of_u(const TransferFunction& tf, double u);

/// Sorts points by position and clamps opacities to [0,1]; the form that all readers rely on.
void normalise(TransferFunction& tf);

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, TransferFunction>
void visit_fields(Self& tf, Visitor&& visit) {
    visit(Field{.name = "domain", .sentence = "the two positions that the ends of the window map to"}, tf.domain);
    visit(Field{.name = "window",
                .sentence = "the two data values between which the curves are stretched; null takes the data's range"},
          tf.window);
    visit(Field{.name = "reference_length",
                .unit = "m",
                .sentence = "the length of path that the opacities are meant for",
                .min = 1e-12,
                .max = 1e12,
                .panel_min = 1e-5,
                .panel_max = 1e-1,
                .logarithmic = true},
          tf.reference_length);
    visit(Field{.name = "opacity", .sentence = "control points [position, opacity 0..1]"}, tf.opacity);
    visit(Field{.name = "color", .sentence = "control points [position, red, green, blue], linear"}, tf.color);
    visit(Field{.name = "emission",
                .sentence = "control points [position, strength]: own light in units of the colour, lit or not"},
          tf.emission);
}

}  // namespace bruma::scene
