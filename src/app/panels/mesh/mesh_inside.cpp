#include "app/panels/mesh/mesh_inside.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace bruma::app {
namespace {

std::string lengths_mm(glm::dvec3 per_mm) {
    const auto one = [](double rate) {
        return rate > 0.0 ? fmt::format("{:.3g}", 1.0 / rate) : std::string("endless");
    };
    return fmt::format("{} / {} / {} mm", one(per_mm.x), one(per_mm.y), one(per_mm.z));
}

}  // namespace

std::string light_inside_words(const scene::Scene& scene, const std::string& node_name, const scene::Mesh& mesh) {
    const scene::SubsurfaceMedium medium = scene::medium_of(*mesh.surface);
    const glm::dmat3 linear(scene::world_from_model(scene, node_name));
    const scene::TriangleMesh& triangles = **mesh.triangles;
    double longest_mm = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        glm::dvec3 across = triangles.high - triangles.low;
        across.y *= corner & 1 ? -1.0 : 1.0;
        across.z *= corner & 2 ? -1.0 : 1.0;
        longest_mm = std::max(longest_mm, 1e3 * glm::length(linear * across));
    }
    return fmt::format(
        "Light spreads over {} (1/sigma_tr) and turns every {} (1/sigma_t'), in "
        "red / green / blue. "
        "Texels: up to {:.3g} mm where it leaves, {:.3g} mm where it enters.",
        lengths_mm(medium.effective_transport()), lengths_mm(medium.reduced_extinction()),
        longest_mm / double(mesh.subsurface->map_size), longest_mm / double(mesh.subsurface->light_map_size));
}

}  // namespace bruma::app
