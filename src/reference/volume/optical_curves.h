#pragma once
#include <array>
#include <vector>

#include "scene/volume/transfer_function.h"

namespace bruma::reference {

/// What the transfer function says at one value.
struct OpticalPoint {
    double extinction;  ///< 1/m
    glm::dvec3 color;   ///< linear Rec.709
    double emission;    ///< in units of the colour
};

/// A stretch of the transfer function between neighbouring knots of any of its curves. All curves are linear on it,
/// so that everything derived from them is smooth and high-order quadrature keeps its order.
struct CurveStretch {
    double u_low = 0.0;
    double opacity = 0.0, opacity_slope = 0.0;  ///< at u_low, and per unit of u
    glm::dvec3 color{0.0}, color_slope{0.0};
    double emission = 0.0, emission_slope = 0.0;
    bool transparent = true;  ///< the extinction is 0 everywhere on it

    /// Defined for every u; outside the stretch the lines go on and opacity is clamped as the model says.
    OpticalPoint at(double u, double reference_length, double density_scale) const {
        const double x = u - u_low;
        return {density_scale * scene::extinction_of_opacity(opacity + opacity_slope * x, reference_length),
                color + color_slope * x, emission + emission_slope * x};
    }
};

/// A transfer function cut into stretches. The argument u is not clamped: below 0 and above 1 lie two constant
/// stretches of their own.
class OpticalCurves {
  public:
    /// `emission` is added to that of the transfer function.
    OpticalCurves(scene::TransferFunction transfer_function, double density_scale, double emission = 0.0);

    /// All places in [0, 1], ascending, where a curve may bend or jump; 0 and 1 are among them.
    const std::vector<double>& knots() const { return knots_; }

    /// The stretch that holds u; exactly on a knot, a constant with the value there (curves may jump at a knot, and
    /// measured data holds whole regions of one value).
    const CurveStretch& stretch_at(double u) const;

    /// Whether the extinction is 0 for every value between the two, ends included.
    bool is_transparent(double u_low, double u_high) const;

    /// The smallest and the largest extinction that `at` gives for any value between the two, ends included.
    std::array<double, 2> extinction_range(double u_low, double u_high) const;

    OpticalPoint at(double u) const { return at(stretch_at(u), u); }
    OpticalPoint at(const CurveStretch& stretch, double u) const {
        return stretch.at(u, transfer_function_.reference_length, density_scale_);
    }

  private:
    CurveStretch constant_stretch(double u) const;
    CurveStretch stretch_between(double u_low, double u_high) const;

    scene::TransferFunction transfer_function_;
    double density_scale_;
    double emission_;
    std::vector<double> knots_;
    std::vector<CurveStretch> between_;  ///< [k] lies below knots_[k], the last one above all
    std::vector<CurveStretch> on_knot_;
    std::vector<int> opaque_before_;  ///< [k]: how many of between_[0..k-1] are not transparent
};

}  // namespace bruma::reference
