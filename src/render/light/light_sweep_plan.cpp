#include "render/light/light_sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace bruma::render {
namespace {

/// Light from this many grid lengths away is parallel to better than floats can tell.
constexpr double parallel_beyond = 1e6;
/// Taken off each weight; a hard cut would let light jump.
constexpr double weight_floor = 1.0 / 1024.0;

void plan_parallel(SweepPlan& plan, glm::dvec3 toward_world, int axis_count) {
    plan.light_cells = glm::dmat3(glm::inverse(plan.grid.world_from_cells)) * toward_world;
    for (int k = 0; k < 3; ++k) {
        const double along = glm::dot(plan.normals[k], toward_world);
        const int last = plan.grid.cells[k] - 1;
        const bool ahead = plan.light_cells[k] > 0.0;
        plan.axes.push_back({k, ahead ? 1 : -1, ahead ? last : 0, last + 1, along * along});
    }
    std::sort(plan.axes.begin(), plan.axes.end(), [](const auto& a, const auto& b) { return a.weight > b.weight; });
    plan.axes.resize(std::size_t(axis_count));
    double sum = 0.0;
    for (SweepAxis& axis : plan.axes) {
        axis.weight = std::max(0.0, axis.weight - weight_floor);
        sum += axis.weight;
    }
    std::erase_if(plan.axes, [](const SweepAxis& axis) { return axis.weight == 0.0; });
    for (SweepAxis& axis : plan.axes) {
        axis.weight /= sum;
    }
}

void plan_from_point(SweepPlan& plan, glm::dvec3 position_world) {
    plan.from_point = true;
    plan.light_cells = glm::inverse(plan.grid.world_from_cells) * glm::dvec4(position_world, 1.0);
    for (int k = 0; k < 3; ++k) {
        const int count = plan.grid.cells[k];
        const double place = plan.light_cells[k];
        // Cells whose centre lies below the light's plane, and those above it.
        const int below = int(std::clamp(std::ceil(place - 0.5), 0.0, double(count)));
        const int above = count - int(std::clamp(std::floor(place - 0.5) + 1.0, 0.0, double(count)));
        if (below > 0) {
            plan.axes.push_back({k, 1, below - 1, below, 1.0});
        }
        if (above > 0) {
            plan.axes.push_back({k, -1, count - above, above, 1.0});
        }
    }
}

}  // namespace

LightGrid light_grid(const scene::Volume& volume, const glm::dmat4& world_from_texture, int coarsening) {
    LightGrid grid;
    const glm::dvec3 low = volume.clip->low;
    const glm::dvec3 extent = volume.clip->high - low;
    for (int k = 0; k < 3; ++k) {
        const double samples = extent[k] * (*volume.grid)->size[k];
        grid.cells[k] = std::max(1, int(std::ceil(samples / coarsening - 1e-6)));
    }
    grid.world_from_cells =
        world_from_texture * glm::scale(glm::translate(glm::dmat4(1.0), low), extent / glm::dvec3(grid.cells));
    grid.length = 0.0;
    for (int k = 0; k < 3; ++k) {
        grid.length = std::max(grid.length, glm::length(glm::dvec3(grid.world_from_cells[k])) * grid.cells[k]);
    }
    return grid;
}

SweepPlan plan_sweep(const LightGrid& grid, const scene::Light& light, glm::dvec3 camera_back_world, int axis_count) {
    SweepPlan plan;
    plan.grid = grid;
    plan.unit_from_cells = glm::dmat3(grid.world_from_cells) / grid.length;
    const glm::dmat3 cells_from_world(glm::inverse(grid.world_from_cells));
    for (int k = 0; k < 3; ++k) {
        plan.normals[k] =
            glm::normalize(glm::dvec3(cells_from_world[0][k], cells_from_world[1][k], cells_from_world[2][k]));
    }
    const glm::dvec3 centre = grid.world_from_cells * glm::dvec4(0.5 * glm::dvec3(grid.cells), 1.0);
    const scene::Incident incident = scene::incident_light(light, centre, camera_back_world);
    if (scene::has_position(light) && incident.distance < parallel_beyond * grid.length) {
        plan_from_point(plan, light.position_world);
    } else {
        plan_parallel(plan, incident.toward_world, axis_count);
    }
    return plan;
}

}  // namespace bruma::render
