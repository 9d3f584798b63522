#include "reference/subsurface/subsurface_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bruma::reference {
namespace {

/// Radon's rule of degree 5: the centroid and two orbits of three points (1 - 2 b, b, b).
constexpr std::array<double, 7> weights{0.225,
                                        0.13239415278850618,
                                        0.13239415278850618,
                                        0.13239415278850618,
                                        0.12593918054482715,
                                        0.12593918054482715,
                                        0.12593918054482715};
constexpr double middle = 0.47014206410511509;
constexpr double corner = 0.10128650732345634;
/// A rule of degree 2 on the centroid and the outer orbit alone: 12 w (1 - 3 b)^2 = 1.
constexpr double coarse_orbit = 1.0 / (12.0 * (1.0 - 3.0 * corner) * (1.0 - 3.0 * corner));
constexpr double coarse_centre = 1.0 - 3.0 * coarse_orbit;

using Cell = SubsurfaceQuadrature::Cell;

std::array<glm::dvec2, 7> nodes(const Cell& cell) {
    const auto at = [&](double a, double b, double c) { return a * cell.a + b * cell.b + c * cell.c; };
    constexpr double m = middle;
    constexpr double m1 = 1.0 - 2.0 * middle;
    constexpr double e = corner;
    constexpr double e1 = 1.0 - 2.0 * corner;
    return {at(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
            at(m1, m, m),
            at(m, m1, m),
            at(m, m, m1),
            at(e1, e, e),
            at(e, e1, e),
            at(e, e, e1)};
}

std::array<Cell, 4> quarters(const Cell& cell) {
    const glm::dvec2 ab = 0.5 * (cell.a + cell.b);
    const glm::dvec2 bc = 0.5 * (cell.b + cell.c);
    const glm::dvec2 ca = 0.5 * (cell.c + cell.a);
    return {{{cell.light, cell.triangle, cell.a, ab, ca},
             {cell.light, cell.triangle, ab, cell.b, bc},
             {cell.light, cell.triangle, ca, bc, cell.c},
             {cell.light, cell.triangle, ab, bc, ca}}};
}

struct CellShape {
    double area, diameter;
    glm::dvec3 centre;
};

CellShape shape(const RayMesh& mesh, const Cell& cell) {
    const glm::dvec3 a = mesh.position_at(cell.triangle, cell.a);
    const glm::dvec3 b = mesh.position_at(cell.triangle, cell.b);
    const glm::dvec3 c = mesh.position_at(cell.triangle, cell.c);
    return {0.5 * glm::length(glm::cross(b - a, c - a)),
            std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)}), (a + b + c) / 3.0};
}

/// The worst channel's error in units of what it is compared with.
double relative(glm::dvec3 error, glm::dvec3 scale) {
    const glm::dvec3 e = error / scale;
    return std::max({e.x, e.y, e.z});
}

}  // namespace

double share_towards(const BodyLight& light, glm::dvec3 to_light) {
    return light.spot ? scene::spot_share(*light.spot, glm::dot(glm::normalize(light.spot->direction_world), to_light))
                      : 1.0;
}

SubsurfaceQuadrature::SubsurfaceQuadrature(const RayMesh& mesh, const Bssrdf& bssrdf, std::vector<BodyLight> lights,
                                           const QuadratureOptions& options)
    : mesh_(mesh),
      bssrdf_(bssrdf),
      lights_(std::move(lights)),
      options_(options),
      core_(bssrdf.shortest_transport_length()) {
    for (std::uint32_t light = 0; light < lights_.size(); ++light) {
        for (std::uint32_t triangle = 0; triangle < mesh_.mesh().triangles.size(); ++triangle) {
            add_base_cells({light, triangle});
        }
    }
}

SubsurfaceQuadrature::Entry SubsurfaceQuadrature::entry_at(const Cell& cell, glm::dvec2 barycentric) const {
    const BodyLight& light = lights_[cell.light];
    Entry entry;
    entry.point = {mesh_.position_at(cell.triangle, barycentric), mesh_.normal_at(cell.triangle, barycentric)};
    glm::dvec3 to_light = light.to_light;
    glm::dvec3 irradiance = light.strength;
    double distance = 1e300;
    if (!light.directional) {
        const glm::dvec3 way = light.position - entry.point.position;
        distance = glm::length(way);
        if (distance == 0.0) {
            return entry;
        }
        to_light = way / distance;
        irradiance *= share_towards(light, to_light) / (distance * distance);
    }
    const glm::dvec3 area = mesh_.area_vector(cell.triangle);
    const double cosine = glm::dot(to_light, area) / glm::length(area);
    const double shading_cosine = glm::dot(to_light, entry.point.normal);
    if (!(cosine > 0.0) || shading_cosine <= 0.0 || mesh_.blocked(entry.point.position, to_light, distance)) {
        return entry;
    }
    const double eta = bssrdf_.medium().eta;
    entry.omega_12 = refract_into(to_light, entry.point.normal, eta);
    entry.irradiance = cosine * fresnel_transmittance(shading_cosine, eta) * irradiance;
    return entry;
}

void SubsurfaceQuadrature::add_base_cells(const Cell& cell) {
    const CellShape s = shape(mesh_, cell);
    // A lit spot or a shadow much smaller than the body must not slip between the nodes of a large triangle.
    if (s.diameter > 0.125 * mesh_.bounding_radius()) {
        for (const Cell& quarter : quarters(cell)) {
            add_base_cells(quarter);
        }
        return;
    }
    BaseCell base;
    base.cell = cell;
    base.area = s.area;
    base.diameter = s.diameter;
    base.centre = s.centre;
    bool lit = false;
    const auto at = nodes(cell);
    for (std::size_t n = 0; n < at.size(); ++n) {
        base.entries[n] = entry_at(cell, at[n]);
        lit = lit || base.entries[n].irradiance != glm::dvec3(0.0);
    }
    if (lit) {
        base_.push_back(base);
    }
}

SubsurfaceQuadrature::Integral SubsurfaceQuadrature::integral(const Entry* entries, double area,
                                                              const SurfacePoint& exit) const {
    glm::dvec3 fine(0.0);
    glm::dvec3 coarse(0.0);
    for (std::size_t n = 0; n < weights.size(); ++n) {
        const Entry& entry = entries[n];
        if (entry.irradiance == glm::dvec3(0.0)) {
            continue;
        }
        const glm::dvec3 f = entry.irradiance * bssrdf_.s_d(entry.point, entry.omega_12, exit);
        fine += weights[n] * f;
        coarse += (n == 0 ? coarse_centre : n > 3 ? coarse_orbit : 0.0) * f;
    }
    return {area * fine, area * glm::abs(fine - coarse)};
}

SubsurfaceQuadrature::Integral SubsurfaceQuadrature::integral(const Cell& cell, const SurfacePoint& exit) const {
    std::array<Entry, 7> entries;
    const auto at = nodes(cell);
    for (std::size_t n = 0; n < at.size(); ++n) {
        entries[n] = entry_at(cell, at[n]);
    }
    return integral(entries.data(), shape(mesh_, cell).area, exit);
}

bool SubsurfaceQuadrature::is_too_coarse(double diameter, glm::dvec3 centre, const SurfacePoint& exit) const {
    return diameter > std::max(glm::length(centre - exit.position), 0.5 * core_);
}

QuadratureResult SubsurfaceQuadrature::at(const SurfacePoint& exit) const {
    struct Open {
        Cell cell;
        Integral integral;
        double priority;
        bool operator<(const Open& other) const { return priority < other.priority; }
    };
    QuadratureResult result;
    std::vector<Open> open;
    std::vector<std::uint32_t> base_index;
    std::vector<Integral> base_integrals;
    base_index.reserve(base_.size());
    base_integrals.reserve(base_.size());
    std::vector<Cell> too_coarse;
    for (std::uint32_t n = 0; n < base_.size(); ++n) {
        const BaseCell& base = base_[n];
        if (is_too_coarse(base.diameter, base.centre, exit)) {
            too_coarse.push_back(base.cell);
        } else {
            base_index.push_back(n);
            base_integrals.push_back(integral(base.entries, base.area, exit));
            result.value += base_integrals.back().value;
            result.error += base_integrals.back().error;
            result.evaluations += 7;
        }
    }
    // Close to x_o cells are graded before anything is believed: S_d has its peak there.
    while (!too_coarse.empty()) {
        const Cell cell = too_coarse.back();
        too_coarse.pop_back();
        for (const Cell& quarter : quarters(cell)) {
            const CellShape s = shape(mesh_, quarter);
            if (is_too_coarse(s.diameter, s.centre, exit)) {
                too_coarse.push_back(quarter);
                continue;
            }
            const Integral part = integral(quarter, exit);
            open.push_back({quarter, part, 0.0});
            result.value += part.value;
            result.error += part.error;
            result.evaluations += 7;
        }
    }
    const double brightest = std::max({result.value.x, result.value.y, result.value.z});
    if (!(brightest > 0.0)) {
        return result;
    }
    // Fixed from here on. A channel that is dark beside the others is not refined for its own sake.
    const glm::dvec3 scale = glm::max(result.value, glm::dvec3(1e-9 * brightest));
    const double negligible = options_.tolerance / (8.0 * double(base_.size() + open.size()));
    for (std::size_t n = 0; n < base_index.size(); ++n) {
        const double priority = relative(base_integrals[n].error, scale);
        if (priority > negligible) {
            open.push_back({base_[base_index[n]].cell, base_integrals[n], priority});
        }
    }
    for (Open& cell : open) {
        cell.priority = relative(cell.integral.error, scale);
    }
    std::make_heap(open.begin(), open.end());
    while (!open.empty() && relative(result.error, scale) > options_.tolerance &&
           result.evaluations < options_.max_evaluations) {
        std::pop_heap(open.begin(), open.end());
        const Open worst = open.back();
        open.pop_back();
        result.value -= worst.integral.value;
        result.error -= worst.integral.error;
        for (const Cell& quarter : quarters(worst.cell)) {
            const Integral part = integral(quarter, exit);
            result.value += part.value;
            result.error += part.error;
            result.evaluations += 7;
            open.push_back({quarter, part, relative(part.error, scale)});
            std::push_heap(open.begin(), open.end());
        }
    }
    result.error = glm::max(result.error, glm::dvec3(0.0));
    return result;
}

}  // namespace bruma::reference
