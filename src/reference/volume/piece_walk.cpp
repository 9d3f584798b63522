#include "reference/volume/piece_walk.h"

#include <algorithm>
#include <cmath>

namespace bruma::reference {

PieceWalk::PieceWalk(const PreparedVolume& volume, const scene::Ray& ray, bool leap, double t_far)
    : leap_(leap), ray_(ray), in_volume_(volume, ray, t_far), volume_(&volume), t_(in_volume_.t_in) {
    if (!in_volume_.misses()) {
        cell_ = glm::clamp(in_volume_.cell_at(t_), glm::ivec3(-1), volume.field.grid().size - 1);
        advance();
    }
}

bool PieceWalk::leap_over_block() {
    constexpr int edge = BlockRanges::edge;
    const glm::ivec3 block = (cell_ + 1) / edge;
    if (!volume_->block_is_transparent(block)) {
        return false;
    }
    const glm::ivec3 first = block * edge - 1;
    const glm::ivec3 ahead = in_volume_.planes_ahead(first, edge);
    const VolumeRay::Plane exit = in_volume_.nearest_plane(ahead);
    cell_ = glm::clamp(in_volume_.cell_at(exit.t), first, glm::min(first + edge, volume_->field.grid().size) - 1);
    cell_[exit.axis] = in_volume_.direction_voxel[exit.axis] > 0.0 ? ahead[exit.axis] : ahead[exit.axis] - 1;
    t_ = std::max(t_, exit.t);
    return true;
}

void PieceWalk::advance() {
    if (current_ + 1 < pieces_.size()) {
        ++current_;
        return;
    }
    pieces_.clear();
    current_ = 0;
    while (pieces_.empty() && t_ < in_volume_.t_out && enter_next_cell()) {
    }
}

bool PieceWalk::enter_next_cell() {
    // Beyond the outermost cells lies nothing; the box ends half a cell before them, so only rounding leads here.
    const glm::ivec3 last = volume_->field.grid().size - 1;
    if (glm::any(glm::lessThan(cell_, glm::ivec3(-1))) || glm::any(glm::greaterThan(cell_, last))) {
        return false;
    }
    if (leap_ && leap_over_block()) {
        return true;
    }
    const VolumeRay::Plane exit = in_volume_.nearest_plane(in_volume_.planes_ahead(cell_, 1));
    const double t1 = std::min(exit.t, in_volume_.t_out);
    if (t1 > t_) {
        load_cell(t1);
        t_ = t1;
    }
    cell_[exit.axis] += in_volume_.direction_voxel[exit.axis] > 0.0 ? 1 : -1;
    return true;
}

void PieceWalk::load_cell(double t1) {
    if (volume_->field.is_hole(cell_)) {
        return;
    }
    std::array<double, 8> corners = volume_->field.corners(cell_);
    for (double& corner : corners) {
        corner = volume_->u_of_value(corner);
    }
    const auto [u_low, u_high] = std::minmax_element(corners.begin(), corners.end());
    if (leap_ && volume_->curves.is_transparent(*u_low, *u_high)) {
        return;
    }
    cell_t0_ = t_;
    per_cell_length_ = 1.0 / (t1 - t_);
    const glm::dvec3 enter = in_volume_.voxel_at(t_) - glm::dvec3(cell_);
    const glm::dvec3 through = (t1 - t_) * in_volume_.direction_voxel;
    u_ = cubic_along(corners, enter, through);
    if (volume_->shading) {
        std::array<glm::dvec3, 8> gradients = volume_->field.corner_gradients(cell_);
        // Covariant: texture gradients become world gradients by the transpose of texture_from_world.
        const glm::dmat3 world_from_gradient = glm::transpose(glm::dmat3(volume_->texture_from_world));
        for (glm::dvec3& gradient : gradients) {
            gradient = world_from_gradient * (gradient * volume_->size());
        }
        gradient_world_ = cubic_along(gradients, enter, through);
    }
    cut_at_knots(t1, *u_low, *u_high);
}

void PieceWalk::cut_at_knots(double t1, double u_low, double u_high) {
    const double length = t1 - t_;
    const std::vector<double>& knots = volume_->curves.knots();
    const auto in_reach = std::lower_bound(knots.begin(), knots.end(), u_low);
    if (in_reach == knots.end() || *in_reach > u_high) {
        push(0.0, 1.0, length, t1);
        return;
    }
    const MonotoneEnds ends = monotone_ends(u_);
    for (int n = 1; n < ends.count; ++n) {
        const double x0 = ends.x[std::size_t(n - 1)];
        const double x1 = ends.x[std::size_t(n)];
        const double u0 = u_.at(x0);
        const double u1 = u_.at(x1);
        const auto first = std::upper_bound(knots.begin(), knots.end(), std::min(u0, u1));
        const auto last = std::lower_bound(first, knots.end(), std::max(u0, u1));
        double x = x0;
        const auto cut = [&](double knot) {
            const double next = std::max(x, crossing(u_, x0, x1, knot));
            push(x, next, length, t1);
            x = next;
        };
        if (u0 < u1) {
            std::for_each(first, last, cut);
        } else {
            std::for_each(std::make_reverse_iterator(last), std::make_reverse_iterator(first), cut);
        }
        push(x, x1, length, t1);
    }
}

void PieceWalk::push(double x0, double x1, double length, double t1) {
    const double begin = x0 == 0.0 ? cell_t0_ : cell_t0_ + x0 * length;
    const double end = x1 == 1.0 ? t1 : cell_t0_ + x1 * length;
    const CurveStretch& stretch = volume_->curves.stretch_at(u_.at(0.5 * (x0 + x1)));
    if (end > begin && !(leap_ && stretch.transparent)) {
        cut_at_bends({begin, end, &stretch}, 0);
    }
}

void PieceWalk::cut_at_bends(RayPiece piece, int depth) {
    constexpr int deepest = 12;  // of a cell: where the gradient is exactly 0, the normal jumps at any scale
    if (volume_->shading && depth < deepest) {
        const double middle = piece.t0 + 0.5 * (piece.t1 - piece.t0);
        const double cut = volume_->shading->is_resolved(gradient_world_at(piece.t0), gradient_world_at(middle),
                                                         gradient_world_at(piece.t1))
                               ? bend_in(piece)
                               : middle;
        if (cut > piece.t0 && cut < piece.t1) {
            cut_at_bends({piece.t0, cut, piece.stretch}, depth + 1);
            cut_at_bends({cut, piece.t1, piece.stretch}, depth + 1);
            return;
        }
    }
    pieces_.push_back(piece);
}

double PieceWalk::bend_in(RayPiece piece) {
    const auto bends_at = [&](double t, std::vector<double>& bends) {
        bends.clear();
        volume_->shading->append_bends(gradient_world_at(t), ray_.origin_world + t * ray_.direction_world,
                                       ray_.direction_world, bends);
    };
    bends_at(piece.t0, bends_begin_);
    bends_at(piece.t1, bends_end_);
    const double slack = 1e-9 * (piece.t1 - piece.t0);
    for (std::size_t n = 0; n < bends_begin_.size(); ++n) {
        if (bends_begin_[n] * bends_end_[n] >= 0.0) {
            continue;
        }
        double low = piece.t0;
        double high = piece.t1;
        for (int turn = 0; turn < 50 && high - low > 0.0; ++turn) {
            const double t = 0.5 * (low + high);
            bends_at(t, bends_);
            ((bends_[n] < 0.0) == (bends_begin_[n] < 0.0) ? low : high) = t;
        }
        // A root found before and rounded to the wrong side of an end is no cut.
        if (low > piece.t0 + slack && low < piece.t1 - slack) {
            return low;
        }
    }
    return piece.t0;
}

}  // namespace bruma::reference
