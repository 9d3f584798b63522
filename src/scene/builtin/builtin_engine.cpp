#include <cmath>
#include <numbers>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

/// A four-cylinder engine from signed distances in mm, negative inside; the origin is the centre of the grid.
namespace bruma::scene {
namespace {

constexpr glm::ivec3 engine_size{160, 112, 96};
constexpr double aluminium = 0.45;
constexpr double steel = 0.92;
constexpr double bore_pitch = 32.0;
constexpr double crank_height = -31.0;
constexpr double crank_throw = 8.0;

double box(const glm::dvec3& p, const glm::dvec3& centre, const glm::dvec3& half, double rounding) {
    const glm::dvec3 q = glm::abs(p - centre) - half + rounding;
    return glm::length(glm::max(q, glm::dvec3(0.0))) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
}

/// std::hypot guards against overflow that cannot happen here, at several times the cost.
double length2(double a, double b) {
    return std::sqrt(a * a + b * b);
}

/// Cylinder along y between two heights.
double post(const glm::dvec3& p, double x, double z, double radius, double low, double high) {
    const double across = length2(p.x - x, p.z - z) - radius;
    return std::max(across, std::abs(p.y - 0.5 * (low + high)) - 0.5 * (high - low));
}

/// Cylinder along x.
double shaft(const glm::dvec3& p, double y, double z, double radius, double low, double high) {
    const double across = length2(p.y - y, p.z - z) - radius;
    return std::max(across, std::abs(p.x - 0.5 * (low + high)) - 0.5 * (high - low));
}

/// Rod of a radius between two points.
double rod(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double radius) {
    const glm::dvec3 ab = b - a;
    const double t = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
    return glm::length(p - a - t * ab) - radius;
}

double unite(double a, double b) {
    return std::min(a, b);
}
double cut(double from, double tool) {
    return std::max(from, -tool);
}

/// Middle of the nearest cylinder along x.
double nearest_bore(double x) {
    const double index = std::clamp(std::floor(x / bore_pitch + 2.0), 0.0, 3.0);
    return (index - 1.5) * bore_pitch;
}

/// Where the crank pin of a cylinder stands: outer cylinders up while inner ones are down, half a turn apart, the
/// whole shaft turned by 35 degrees so that no piston hides a valve.
glm::dvec3 crank_pin(double bore_x) {
    const double angle = (std::abs(bore_x) > bore_pitch ? 35.0 : 215.0) * std::numbers::pi / 180.0;
    return {bore_x, crank_height + crank_throw * std::cos(angle), crank_throw * std::sin(angle)};
}

/// Block, head and sump flange.
double aluminium_distance(const glm::dvec3& p) {
    const double x0 = nearest_bore(p.x);
    double body =
        unite(box(p, {0.0, -8.0, 0.0}, {70.0, 32.0, 28.0}, 4.0), box(p, {0.0, -41.0, 0.0}, {74.0, 2.5, 34.0}, 1.0));
    body = cut(body, box(p, {0.0, -36.0, 0.0}, {65.0, 18.0, 23.0}, 5.0));  // crankcase, open below
    body = cut(body, post(p, x0, 0.0, 14.0, -60.0, 60.0));                 // bores, before the liners go in
    const double jacket = std::max(post(p, x0, 0.0, 21.5, -12.0, 17.0), -post(p, x0, 0.0, 17.0, -60.0, 60.0));
    body = cut(body, jacket);                                 // cooling water around the bores
    for (const double x : {-62.0, -32.0, 0.0, 32.0, 62.0}) {  // bearing walls across the crankcase
        const double wall = box(p, {x, -26.0, 0.0}, {2.5, 9.0, 25.0}, 0.5);
        body = unite(body, wall);
    }

    double head = box(p, {0.0, 33.5, 0.0}, {70.0, 9.0, 28.0}, 3.0);
    head = cut(head, box(p, {0.0, 40.0, 0.0}, {66.0, 6.0, 24.0}, 2.0));  // tray of the valve springs
    head = cut(head, post(p, x0, 0.0, 12.0, 20.0, 28.5));                // combustion chamber
    for (const double side : {-1.0, 1.0}) {
        // A port turns from the valve outwards.
        head = cut(head, rod(p, {x0 + side * 5.5, 26.0, 0.0}, {x0 + side * 5.5, 31.0, side * 8.0}, 3.2));
        head = cut(head, rod(p, {x0 + side * 5.5, 31.0, side * 8.0}, {x0 + side * 5.5, 31.5, side * 40.0}, 3.2));
    }
    // Ribs stiffen the outer walls of the block.
    const double rib_x = std::abs(p.x - 16.0 * std::floor(p.x / 16.0 + 0.5));
    const double ribs = std::max(
        {rib_x - 1.2, std::abs(p.z) - 30.5, 26.0 - std::abs(p.z), std::abs(p.y + 8.0) - 24.0, std::abs(p.x) - 66.0});
    return unite(unite(body, ribs), head);
}

/// Liners, pistons, rods, crankshaft, valves and bolts.
double steel_distance(const glm::dvec3& p) {
    const double x0 = nearest_bore(p.x);
    const glm::dvec3 pin = crank_pin(x0);
    const double wrist_y = pin.y + std::sqrt(30.0 * 30.0 - pin.z * pin.z);
    double steel_parts = std::max(post(p, x0, 0.0, 14.0, -20.0, 24.0), -post(p, x0, 0.0, 11.5, -60.0, 60.0));

    double piston = post(p, x0, 0.0, 10.6, wrist_y - 5.0, wrist_y + 7.0);
    piston = cut(piston, post(p, x0, 0.0, 8.0, wrist_y - 9.0, wrist_y + 4.0));
    steel_parts = unite(steel_parts, piston);
    steel_parts = unite(steel_parts, rod(p, {x0, wrist_y, 0.0}, pin, 2.2));
    steel_parts = unite(steel_parts, shaft(p, wrist_y, 0.0, 2.5, x0 - 9.0, x0 + 9.0));

    steel_parts = unite(steel_parts, shaft(p, pin.y, pin.z, 4.0, x0 - 6.0, x0 + 6.0));
    for (const double side : {-1.0, 1.0}) {  // webs with their counterweights opposite to the pin
        const double x = x0 + side * 7.5;
        const glm::dvec3 axis(x, crank_height, 0.0);
        const glm::dvec3 in_web(x, pin.y, pin.z);
        const double web = std::max(
            unite(rod({x, p.y, p.z}, axis, in_web, 5.0), rod({x, p.y, p.z}, axis, axis - 0.6 * (in_web - axis), 8.0)),
            std::abs(p.x - x) - 1.7);
        steel_parts = unite(steel_parts, web);
    }
    const double main_bearing = std::max(shaft(p, crank_height, 0.0, 4.5, -76.0, 76.0), 9.0 - std::abs(p.x - x0));
    steel_parts = unite(steel_parts, main_bearing);
    steel_parts = unite(steel_parts, shaft(p, crank_height, 0.0, 15.0, 72.5, 76.5));  // flywheel flange

    for (const double side : {-1.0, 1.0}) {
        const double x = x0 + side * 5.5;
        const double seat = std::max(post(p, x, 0.0, 5.2, 27.0, 30.0), -post(p, x, 0.0, 3.0, 20.0, 40.0));
        const double valve = unite(post(p, x, 0.0, 4.4, 25.0, 26.8), post(p, x, 0.0, 1.2, 26.0, 47.0));
        const double spring_plate = post(p, x, 0.0, 4.0, 44.0, 46.0);
        steel_parts = unite(steel_parts, unite(unite(seat, valve), spring_plate));
    }
    // Head bolts in two rows between the bores.
    const double bolt_x =
        std::clamp(bore_pitch * std::floor(p.x / bore_pitch + 0.5), -2.0 * bore_pitch, 2.0 * bore_pitch);
    for (const double z : {-23.5, 23.5}) {
        const double x = bolt_x;
        const double bolt = unite(post(p, x, z, 1.8, 4.0, 44.0), post(p, x, z, 3.4, 42.5, 46.0));
        steel_parts = unite(steel_parts, bolt);
    }
    return steel_parts;
}

/// Share of a voxel inside a surface at this signed distance: an edge one voxel wide.
double coverage(double distance_mm) {
    return std::clamp(0.5 - distance_mm, 0.0, 1.0);
}

}  // namespace

std::shared_ptr<const VolumeGrid> make_engine() {
    return sample_builtin("engine", engine_size, VoxelType::uint8, 1e-3, [](int i, int j, int k) {
        const glm::dvec3 p(centre_in_samples(i, engine_size.x), centre_in_samples(j, engine_size.y),
                           centre_in_samples(k, engine_size.z));
        const double in_steel = coverage(steel_distance(p));
        return aluminium * coverage(aluminium_distance(p)) * (1.0 - in_steel) + steel * in_steel;
    });
}

}  // namespace bruma::scene
