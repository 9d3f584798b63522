#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

void add_polygon(MeshParts& parts, std::initializer_list<std::size_t> vertices) {
    std::array<FaceCorner, 4> corners;
    std::size_t count = 0;
    for (const std::size_t vertex : vertices) {
        const auto index = std::int32_t(vertex);
        // Where normals are made, there is one for each position.
        corners[count++] = {index, -1, parts.normals.empty() ? -1 : index};
    }
    parts.add_face(std::span(corners.data(), count), 0);
}

/// A place on the middle line of a tube, with two unit vectors across it.
struct Section {
    glm::dvec3 middle, across, upward;
    double radius;
};

/// Joins rings of `sides` positions; the tube runs back into its beginning, or is closed by flat caps.
void add_tube(MeshParts& parts, int sections, int sides, bool is_loop, const std::function<Section(double)>& at) {
    const std::size_t first = parts.positions.size();
    for (int s = 0; s < sections; ++s) {
        const Section section = at(double(s) / (is_loop ? sections : sections - 1));
        for (int side = 0; side < sides; ++side) {
            const double angle = two_pi * side / sides;
            parts.positions.push_back(section.middle + section.radius * (std::cos(angle) * section.across +
                                                                         std::sin(angle) * section.upward));
        }
    }
    const auto vertex = [&](int s, int side) {
        return first + std::size_t(s % sections) * std::size_t(sides) + std::size_t(side % sides);
    };
    for (int s = 0; s < (is_loop ? sections : sections - 1); ++s) {
        for (int side = 0; side < sides; ++side) {
            add_polygon(parts, {vertex(s, side), vertex(s, side + 1), vertex(s + 1, side + 1), vertex(s + 1, side)});
        }
    }
    if (is_loop) {
        return;
    }
    std::vector<FaceCorner> front;
    std::vector<FaceCorner> back;
    for (int side = 0; side < sides; ++side) {
        front.push_back({std::int32_t(vertex(0, sides - 1 - side)), -1, -1});
        back.push_back({std::int32_t(vertex(sections - 1, side)), -1, -1});
    }
    parts.add_face(front, 0);
    parts.add_face(back, 0);
}

/// A tube in the plane z = 0 along a Bezier curve, its radius going from one end's to the other's.
void add_spline_tube(MeshParts& parts, const std::array<glm::dvec2, 4>& p, double radius_from, double radius_to) {
    add_tube(parts, 33, 32, false, [&](double t) {
        const double s = 1.0 - t;
        const glm::dvec2 middle = s * s * s * p[0] + 3.0 * s * s * t * p[1] + 3.0 * s * t * t * p[2] + t * t * t * p[3];
        const glm::dvec2 along =
            glm::normalize(s * s * (p[1] - p[0]) + 2.0 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
        return Section{glm::dvec3(middle, 0.0), glm::dvec3(-along.y, along.x, 0.0), glm::dvec3(0.0, 0.0, 1.0),
                       radius_from + t * (radius_to - radius_from)};
    });
}

/// Turns an outline (radius, height) about the y axis. It begins and ends on the axis and runs upwards.
void add_turned(MeshParts& parts, const std::vector<glm::dvec2>& outline, int sides) {
    const std::size_t bottom = parts.positions.size();
    parts.positions.emplace_back(0.0, outline.front().y, 0.0);
    const std::size_t rings = outline.size() - 2;
    for (std::size_t ring = 1; ring <= rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            const double angle = two_pi * side / sides;
            parts.positions.emplace_back(outline[ring].x * std::cos(angle), outline[ring].y,
                                         -outline[ring].x * std::sin(angle));
        }
    }
    const std::size_t top = parts.positions.size();
    parts.positions.emplace_back(0.0, outline.back().y, 0.0);
    const auto vertex = [&](std::size_t ring, int side) {
        return bottom + 1 + ring * std::size_t(sides) + std::size_t(side % sides);
    };
    for (int side = 0; side < sides; ++side) {
        add_polygon(parts, {bottom, vertex(0, side + 1), vertex(0, side)});
        for (std::size_t ring = 0; ring + 1 < rings; ++ring) {
            add_polygon(parts, {vertex(ring, side), vertex(ring, side + 1), vertex(ring + 1, side + 1),
                                vertex(ring + 1, side)});
        }
        add_polygon(parts, {vertex(rings - 1, side), vertex(rings - 1, side + 1), top});
    }
}

/// Points on a Catmull-Rom spline through `through`, which keeps them all and has no corner between them.
std::vector<glm::dvec2> smooth_outline(const std::vector<glm::dvec2>& through, int steps) {
    std::vector<glm::dvec2> points;
    const auto point = [&](std::size_t n) { return through[std::min(n, through.size() - 1)]; };
    for (std::size_t n = 0; n + 1 < through.size(); ++n) {
        const glm::dvec2 a = point(n == 0 ? 0 : n - 1);
        const glm::dvec2 b = point(n);
        const glm::dvec2 c = point(n + 1);
        const glm::dvec2 d = point(n + 2);
        for (int step = 0; step < steps; ++step) {
            const double t = double(step) / steps;
            glm::dvec2 p =
                b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * (b - c) + d - a)));
            p = glm::max(p, glm::dvec2(0.0));
            points.push_back(p);
        }
    }
    points.push_back(through.back());
    return points;
}

}  // namespace

MeshParts mesh_sphere_parts() {
    constexpr double radius = 10.0;
    constexpr int halvings = 5;
    const double g = std::numbers::phi;
    MeshParts parts;
    std::vector<glm::dvec3> directions{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                       {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::dvec3& direction : directions) {
        direction = glm::normalize(direction);
    }
    std::vector<glm::uvec3> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int n = 0; n < halvings; ++n) {
        std::map<std::pair<unsigned, unsigned>, unsigned> middles;
        const auto middle = [&](unsigned a, unsigned b) {
            const auto [found, is_new] = middles.try_emplace(std::minmax(a, b), unsigned(directions.size()));
            if (is_new) {
                directions.push_back(glm::normalize(directions[a] + directions[b]));
            }
            return found->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : triangles) {
            const unsigned xy = middle(t.x, t.y);
            const unsigned yz = middle(t.y, t.z);
            const unsigned zx = middle(t.z, t.x);
            finer.insert(finer.end(), {{t.x, xy, zx}, {t.y, yz, xy}, {t.z, zx, yz}, {xy, yz, zx}});
        }
        triangles = std::move(finer);
    }
    parts.normals = directions;
    for (const glm::dvec3& direction : directions) {
        parts.positions.push_back(radius * direction);
    }
    for (const glm::uvec3& t : triangles) {
        add_polygon(parts, {t.x, t.y, t.z});
    }
    return parts;
}

MeshParts mesh_knot_parts() {
    constexpr double scale = 8.0;
    constexpr double tube_radius = 5.0;
    MeshParts parts;
    add_tube(parts, 480, 32, true, [&](double share) {
        const double t = two_pi * share;
        const double ring = 2.0 + std::cos(3.0 * t);
        const glm::dvec3 outward(std::cos(2.0 * t), std::sin(2.0 * t), 0.0);
        const glm::dvec3 sideways(-std::sin(2.0 * t), std::cos(2.0 * t), 0.0);
        const glm::dvec3 middle = scale * (ring * outward + glm::dvec3(0.0, 0.0, 1.4 * std::sin(3.0 * t)));
        const glm::dvec3 along = glm::normalize(-3.0 * std::sin(3.0 * t) * outward + 2.0 * ring * sideways +
                                                glm::dvec3(0.0, 0.0, 4.2 * std::cos(3.0 * t)));
        // Away from the circle around which the knot is wound: never along the tube, and the same after one turn.
        const glm::dvec3 away = middle - 2.0 * scale * outward;
        const glm::dvec3 across = glm::normalize(away - glm::dot(away, along) * along);
        return Section{middle, across, glm::cross(along, across), tube_radius};
    });
    return parts;
}

MeshParts pot_parts() {
    // Belly, shoulder, rim, lid and knob, in millimetres from the table up.
    const std::vector<glm::dvec2> outline{{0, 0},   {24, 0},  {29, 2},  {40, 16}, {44, 30}, {40, 44},
                                          {30, 54}, {27, 57}, {28, 59}, {25, 61}, {14, 66}, {5, 68},
                                          {4, 71},  {8, 75},  {7, 80},  {0, 82}};
    MeshParts parts;
    add_turned(parts, smooth_outline(outline, 6), 96);
    add_spline_tube(parts, {{{36, 18}, {62, 18}, {50, 46}, {70, 56}}}, 9.0, 4.5);
    add_spline_tube(parts, {{{-30, 50}, {-72, 58}, {-74, 18}, {-37, 16}}}, 4.0, 4.0);
    return parts;
}

}  // namespace bruma::scene
