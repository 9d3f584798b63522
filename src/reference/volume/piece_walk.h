#pragma once
#include <limits>
#include <vector>

#include "reference/cubic.h"
#include "reference/volume/volume_ray.h"

namespace bruma::reference {

/// A part of a ray inside one cell of one volume and one stretch of its transfer function: what lies on it is smooth.
struct RayPiece {
    double t0 = 0.0, t1 = 0.0;  ///< distances along the ray, metres
    const CurveStretch* stretch = nullptr;
};

/// All pieces of a ray through one volume, front to back. Cells are found by stepping over the planes through the
/// sample centres.
class PieceWalk {
  public:
    /// With `leap`, pieces without extinction are passed over; without, every cell is handed out. Ends at `t_far`.
    PieceWalk(const PreparedVolume& volume, const scene::Ray& ray, bool leap,
              double t_far = std::numeric_limits<double>::infinity());

    const PreparedVolume& volume() const { return *volume_; }
    bool finished() const { return current_ == pieces_.size(); }
    const RayPiece& piece() const { return pieces_[current_]; }
    void advance();

    /// Transfer function argument at t, which must lie in the current piece's cell.
    double u_at(double t) const { return u_.at((t - cell_t0_) * per_cell_length_); }
    /// Gradient in data units per metre of the world; 0 for volumes that are not shaded.
    glm::dvec3 gradient_world_at(double t) const { return gradient_world_.at((t - cell_t0_) * per_cell_length_); }

    double t_in() const { return in_volume_.t_in; }
    double t_out() const { return in_volume_.t_out; }

  private:
    bool leap_over_block();
    bool enter_next_cell();
    void load_cell(double t1);
    void cut_at_knots(double t1, double u_low, double u_high);
    void push(double x0, double x1, double length, double t1);
    void cut_at_bends(RayPiece piece, int depth);
    double bend_in(RayPiece piece);

    bool leap_;
    scene::Ray ray_;
    VolumeRay in_volume_;
    const PreparedVolume* volume_;
    glm::ivec3 cell_{0};
    double t_ = 0.0;

    std::vector<RayPiece> pieces_;  ///< of the current cell
    std::size_t current_ = 0;
    double cell_t0_ = 0.0, per_cell_length_ = 0.0;
    Cubic<double> u_;
    Cubic<glm::dvec3> gradient_world_;
    std::vector<double> bends_begin_, bends_end_, bends_;  ///< scratch
};

}  // namespace bruma::reference
