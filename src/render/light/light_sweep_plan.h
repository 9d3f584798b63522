#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "scene/light.h"
#include "scene/volume/volume.h"

namespace bruma::render {

/// A grid of light cells over the shown part of a volume.
struct LightGrid {
    glm::ivec3 cells{1};
    glm::dmat4 world_from_cells{1.0};  ///< cell (i, j, k) spans [i, i + 1] x ...; its centre is at i + 1/2
    double length = 1.0;               ///< metres: longest edge of the grid, the unit of its optical depths
    bool operator==(const LightGrid&) const = default;
};

/// `coarsening`: data samples along the edge of a cell.
LightGrid light_grid(const scene::Volume& volume, const glm::dmat4& world_from_texture, int coarsening);

/// One pass through the slices of a light grid, away from the light.
struct SweepAxis {
    int axis = 0;
    int sign = 1;         ///< +1: the light stands towards larger indices
    int first = 0;        ///< slice nearest to the light
    int slices = 0;       ///< from there on away from the light
    double weight = 1.0;  ///< of directional light: its share of the result
    bool operator==(const SweepAxis&) const = default;
};

/// How one light is swept through a grid. Three axes with weights omega_k^2 (here: less 1/1024 and renormalised, so
/// that axes without influence cost nothing) are smooth under any motion of the light, where one or two axes jump. A
/// point light near by takes up to six half axes, each from the plane through the light, and weights for every cell.
struct SweepPlan {
    LightGrid grid;
    bool from_point = false;
    glm::dvec3 light_cells{0.0};      ///< cells: the way to the light per metre, or the point where it stands
    glm::dmat3 unit_from_cells{1.0};  ///< lengths in units of the grid's length
    glm::dmat3 normals{1.0};          ///< columns: unit normals of the slices of each axis, in world axes
    std::vector<SweepAxis> axes;
    bool operator==(const SweepPlan&) const = default;
};

/// `axis_count` most (3; 2 as Ropinski et al. 2010 have it; 1). Headlights need the camera.
SweepPlan plan_sweep(const LightGrid& grid, const scene::Light& light, glm::dvec3 camera_back_world,
                     int axis_count = 3);

}  // namespace bruma::render
