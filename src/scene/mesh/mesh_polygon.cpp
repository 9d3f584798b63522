#include "scene/mesh/mesh_polygon.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace bruma::scene {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}
/// Twice the signed area of a triangle.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return cross(b - a, c - a);
}

/// The corners in the plane of the polygon, counter-clockwise; the largest coordinate of the normal is left out, which
/// keeps the others as they are.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t n = 1; n + 1 < corners.size(); ++n) {
        normal += glm::cross(corners[n] - corners[0], corners[n + 1] - corners[0]);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int out = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    const bool turned = normal[out] < 0.0;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 p = corner - corners[0];
        const glm::dvec2 q(p[(out + 1) % 3], p[(out + 2) % 3]);
        flat.push_back(turned ? glm::dvec2(q.y, q.x) : q);
    }
    return flat;
}

/// Points in the cells of a grid, about one to a cell, so that a triangle is held against those near it alone.
class PointGrid {
  public:
    PointGrid(const std::vector<glm::dvec2>& points, const std::vector<std::uint32_t>& members) : points_(points) {
        glm::dvec2 high(-1e300);
        for (const std::uint32_t n : members) {
            low_ = glm::min(low_, points[n]);
            high = glm::max(high, points[n]);
        }
        const glm::dvec2 sides = glm::max(high - low_, glm::dvec2(1e-12 * glm::length(high - low_) + 1e-300));
        const double edge = std::sqrt(sides.x / double(members.size())) * std::sqrt(sides.y);
        constexpr double most_cells = 1024.0;
        cells_ = glm::ivec2(glm::clamp(sides / edge, glm::dvec2(1.0), glm::dvec2(most_cells)));
        per_length_ = glm::dvec2(cells_) / sides;
        of_cell_.resize(std::size_t(cells_.x) * std::size_t(cells_.y));
        for (const std::uint32_t n : members) {
            at(cell_of(points[n])).push_back(n);
        }
    }
    void remove(std::uint32_t n) { std::erase(at(cell_of(points_[n])), n); }

    /// Whether `stop(point)` is true for a point of the cells that a triangle touches. Adds what was looked at to
    /// `steps`.
    template <class Stop>
    bool any_near(const std::array<glm::dvec2, 3>& triangle, std::uint64_t& steps, Stop&& stop) const {
        std::array<glm::dvec2, 3> t;
        for (std::size_t k = 0; k < 3; ++k) {
            t[k] = (triangle[k] - low_) * per_length_;
        }
        const int first = row_of(std::min({t[0].y, t[1].y, t[2].y}));
        const int last = row_of(std::max({t[0].y, t[1].y, t[2].y}));
        for (int row = first; row <= last; ++row) {
            const glm::dvec2 reach = reach_in_row(t, row);
            const int from = column_of(reach.x);
            const int to = column_of(reach.y);
            for (int column = from; column <= to; ++column) {
                const std::vector<std::uint32_t>& members = of_cell_[index({column, row})];
                steps += 1 + members.size();
                if (std::any_of(members.begin(), members.end(), stop)) {
                    return true;
                }
            }
        }
        return false;
    }

  private:
    int row_of(double y) const { return std::clamp(int(std::clamp(y, 0.0, 1e6)), 0, cells_.y - 1); }
    int column_of(double x) const { return std::clamp(int(std::clamp(x, 0.0, 1e6)), 0, cells_.x - 1); }
    std::size_t index(glm::ivec2 cell) const {
        return std::size_t(cell.y) * std::size_t(cells_.x) + std::size_t(cell.x);
    }
    glm::ivec2 cell_of(glm::dvec2 p) const {
        const glm::dvec2 place = (p - low_) * per_length_;
        return {column_of(place.x), row_of(place.y)};
    }
    std::vector<std::uint32_t>& at(glm::ivec2 cell) { return of_cell_[index(cell)]; }

    /// From where to where a triangle lies in a row, in cells, with room for rounding; the second before the first
    /// where it does not.
    glm::dvec2 reach_in_row(const std::array<glm::dvec2, 3>& t, int row) const {
        constexpr double room = 1e-6;
        const double bottom = row - room;
        const double top = row + 1 + room;
        glm::dvec2 reach(1e300, -1e300);
        const auto take = [&](double x) { reach = {std::min(reach.x, x - room), std::max(reach.y, x + room)}; };
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec2& a = t[k];
            const glm::dvec2& b = t[(k + 1) % 3];
            if (a.y >= bottom && a.y <= top) {
                take(a.x);
            }
            for (const double y : {bottom, top}) {
                if ((a.y < y) != (b.y < y)) {
                    take(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
                }
            }
        }
        return reach;
    }

    const std::vector<glm::dvec2>& points_;
    glm::dvec2 low_{1e300}, per_length_{1.0};
    glm::ivec2 cells_{1};
    std::vector<std::vector<std::uint32_t>> of_cell_;
};

/// Ear clipping on a ring of corners (Meisters 1975). Only reflex corners can lie in an ear.
class EarClipper {
  public:
    explicit EarClipper(std::vector<glm::dvec2> points)
        : points_(std::move(points)), is_reflex_(points_.size(), 0), is_no_ear_(points_.size(), 0) {
        const auto count = std::uint32_t(points_.size());
        for (std::uint32_t n = 0; n < count; ++n) {
            next_.push_back((n + 1) % count);
            previous_.push_back((n + count - 1) % count);
        }
        std::vector<std::uint32_t> reflex;
        for (std::uint32_t n = 0; n < count; ++n) {
            if (corner_turn(n) <= 0.0) {
                is_reflex_[n] = 1;
                reflex.push_back(n);
            }
        }
        if (!reflex.empty()) {
            reflex_.emplace(points_, reflex);
        }
    }

    /// False when it takes too long: the polygon then crosses itself all over.
    bool clip(std::vector<std::array<std::uint32_t, 3>>& into) {
        constexpr std::uint64_t most_steps = 100'000'000;
        const bool many = points_.size() > 8192;
        std::uint32_t at = 0;
        std::size_t tried = 0;
        for (std::size_t left = points_.size(); left > 3;) {
            if (tried == left + 1) {
                // A round without an ear: what was none before may be one by rounding.
                std::fill(is_no_ear_.begin(), is_no_ear_.end(), 0);
            }
            // After another one the polygon crosses itself or is flat: any cut is as good.
            if (tried <= 2 * left + 1 && !is_ear(at)) {
                at = next_[at];
                ++tried;
                if (++steps_ > most_steps) {
                    return false;
                }
                continue;
            }
            into.push_back({previous_[at], at, next_[at]});
            const std::uint32_t before = previous_[at];
            const std::uint32_t after = next_[at];
            next_[before] = after;
            previous_[after] = before;
            settle(at, true);
            settle(before, corner_turn(before) > 0.0);
            settle(after, corner_turn(after) > 0.0);
            // Cutting every second corner makes rounder triangles than a fan. Of very many, the next ear is looked for
            // where the last one was: a spiral has ears at its ends alone.
            at = many ? before : next_[after];
            --left;
            tried = 0;
        }
        into.push_back({previous_[at], at, next_[at]});
        return true;
    }

  private:
    double corner_turn(std::uint32_t n) const { return turn(points_[previous_[n]], points_[n], points_[next_[n]]); }

    /// Of a corner whose neighbours changed.
    void settle(std::uint32_t n, bool convex) {
        is_no_ear_[n] = 0;
        if (is_reflex_[n] != 0 && convex) {
            is_reflex_[n] = 0;
            reflex_->remove(n);
        }
    }

    /// A corner that is none stays none until a neighbour is cut off.
    bool is_ear(std::uint32_t n) {
        if (is_no_ear_[n] != 0) {
            return false;
        }
        const glm::dvec2& a = points_[previous_[n]];
        const glm::dvec2& b = points_[n];
        const glm::dvec2& c = points_[next_[n]];
        const auto is_inside = [&](std::uint32_t other) {
            const glm::dvec2& p = points_[other];
            // Rings joined by a bridge visit the same point twice: it is no obstacle to its own triangle.
            return p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        };
        const bool ear = turn(a, b, c) > 0.0 && !(reflex_ && reflex_->any_near({a, b, c}, steps_, is_inside));
        is_no_ear_[n] = ear ? 0 : 1;
        return ear;
    }

    std::vector<glm::dvec2> points_;
    std::vector<std::uint32_t> next_, previous_;
    std::vector<char> is_reflex_, is_no_ear_;
    std::optional<PointGrid> reflex_;
    std::uint64_t steps_ = 0;
};

/// A quad is cut along its shorter diagonal, or along the one that lies inside.
void cut_quad(std::span<const glm::dvec3> corners, const std::vector<glm::dvec2>& p,
              std::vector<std::array<std::uint32_t, 3>>& into) {
    const double along_02 = std::min(turn(p[0], p[1], p[2]), turn(p[0], p[2], p[3]));
    const double along_13 = std::min(turn(p[0], p[1], p[3]), turn(p[1], p[2], p[3]));
    const glm::dvec3 diagonal_02 = corners[2] - corners[0];
    const glm::dvec3 diagonal_13 = corners[3] - corners[1];
    const bool both_inside = along_02 > 0.0 && along_13 > 0.0;
    if (both_inside ? glm::dot(diagonal_02, diagonal_02) <= glm::dot(diagonal_13, diagonal_13) : along_02 >= along_13) {
        into.insert(into.end(), {{0, 1, 2}, {0, 2, 3}});
    } else {
        into.insert(into.end(), {{0, 1, 3}, {1, 2, 3}});
    }
}

}  // namespace

bool triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& into) {
    if (corners.size() < 3) {
        return true;
    }
    if (corners.size() == 3) {
        into.push_back({0, 1, 2});
        return true;
    }
    std::vector<glm::dvec2> flat = flattened(corners);
    if (corners.size() == 4) {
        cut_quad(corners, flat, into);
        return true;
    }
    const std::size_t before = into.size();
    const bool cut = EarClipper(std::move(flat)).clip(into);
    if (!cut) {
        into.resize(before);
    }
    return cut;
}

}  // namespace bruma::scene
