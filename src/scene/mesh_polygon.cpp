#include "scene/mesh_polygon.h"

#include <fmt/core.h>

#include <cmath>

#include "base/error.h"

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

/// Ear clipping on a ring of corners (Meisters 1975). Only reflex corners can lie in an ear.
class EarClipper {
  public:
    explicit EarClipper(std::vector<glm::dvec2> points) : points_(std::move(points)) {
        const auto count = std::uint32_t(points_.size());
        for (std::uint32_t n = 0; n < count; ++n) {
            next_.push_back((n + 1) % count);
            previous_.push_back((n + count - 1) % count);
        }
        for (std::uint32_t n = 0; n < count; ++n) {
            if (corner_turn(n) <= 0.0) {
                reflex_.push_back(n);
            }
        }
    }
    std::size_t reflex_count() const { return reflex_.size(); }

    void clip(std::vector<std::array<std::uint32_t, 3>>& into) {
        std::uint32_t at = 0;
        std::size_t tried = 0;
        for (std::size_t left = points_.size(); left > 3;) {
            // After a round without an ear the polygon crosses itself or is flat: any cut is as good.
            if (tried <= left && !is_ear(at)) {
                at = next_[at];
                ++tried;
                continue;
            }
            into.push_back({previous_[at], at, next_[at]});
            const std::uint32_t before = previous_[at];
            const std::uint32_t after = next_[at];
            next_[before] = after;
            previous_[after] = before;
            std::erase_if(reflex_, [&](std::uint32_t n) {
                return n == at || ((n == before || n == after) && corner_turn(n) > 0.0);
            });
            // Cutting every second corner makes rounder triangles than a fan.
            at = next_[after];
            --left;
            tried = 0;
        }
        into.push_back({previous_[at], at, next_[at]});
    }

  private:
    double corner_turn(std::uint32_t n) const { return turn(points_[previous_[n]], points_[n], points_[next_[n]]); }

    bool is_ear(std::uint32_t n) const {
        const glm::dvec2& a = points_[previous_[n]];
        const glm::dvec2& b = points_[n];
        const glm::dvec2& c = points_[next_[n]];
        if (turn(a, b, c) <= 0.0) {
            return false;
        }
        for (const std::uint32_t other : reflex_) {
            const glm::dvec2& p = points_[other];
            // Rings joined by a bridge visit the same point twice: it is no obstacle to its own triangle.
            if (p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) {
                return false;
            }
        }
        return true;
    }

    std::vector<glm::dvec2> points_;
    std::vector<std::uint32_t> next_, previous_, reflex_;
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

void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& into) {
    constexpr std::size_t most_corners = 8192;
    if (corners.size() < 3) {
        return;
    }
    if (corners.size() == 3) {
        into.push_back({0, 1, 2});
        return;
    }
    std::vector<glm::dvec2> flat = flattened(corners);
    if (corners.size() == 4) {
        cut_quad(corners, flat, into);
        return;
    }
    EarClipper clipper(std::move(flat));
    if (corners.size() > most_corners && clipper.reflex_count() > 0) {
        throw InputError(fmt::format("a polygon of {} corners that is not convex, but at most {} are cut; split it",
                                     corners.size(), most_corners));
    }
    clipper.clip(into);
}

}  // namespace bruma::scene
