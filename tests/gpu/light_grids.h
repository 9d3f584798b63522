#pragma once
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render/light/light_sweep.h"

/// Light grids of given extinction, swept and read back: what the tests of light share. Grids are centred on the
/// origin.
namespace bruma::render {

struct LightCase {
    glm::ivec3 cells{16};
    glm::dvec3 extent{1.0};                   ///< metres
    std::function<double(glm::ivec3)> sigma;  ///< 1/m
    glm::dvec3 albedo{1.0};
    std::function<glm::dvec3(glm::ivec3)> albedo_at = {};  ///< in place of `albedo`
    SweepSettings settings{.precision = scene::LightPrecision::single};
    int axis_count = 3;
};

struct Swept {
    std::vector<float> direct;
    std::vector<glm::vec4> beside;
    int dispatches = 0;
};

std::function<double(glm::ivec3)> uniform(double sigma);
/// Smooth blobs of extinction, fixed.
LightCase blobs(int edge, glm::dvec3 extent = glm::dvec3(1.0));
scene::Light sunlight(glm::dvec3 toward_world);
scene::Light lamp_at(glm::dvec3 position_world);

SweepPlan plan_of(const LightCase& c, const scene::Light& light);
Swept sweep(gl::ShaderLibrary& shaders, const LightCase& c, const scene::Light& light, const EmptySpace& empty = {});

/// Length of the way from x to the border of a box of this extent around the origin.
double way_out(glm::dvec3 extent, glm::dvec3 x, glm::dvec3 direction);

void for_each_cell(glm::ivec3 cells, const std::function<void(glm::ivec3 at, std::size_t index)>& visit);
glm::dvec3 centre_of(const LightCase& c, glm::ivec3 at);
double largest_error(const LightCase& c, const Swept& swept, const std::function<double(glm::dvec3 x)>& exact);
double mean_error(const LightCase& c, const Swept& swept, const std::function<double(glm::dvec3 x)>& exact);

using CubeTurn = glm::dmat3;
/// The 24 turns that map a cube onto itself.
std::vector<CubeTurn> turns_of_a_cube();
glm::dmat3 turn_between(glm::dvec3 from, glm::dvec3 to);
/// Value at x in [-1/2, 1/2]^3 of a field given at cell centres.
double trilinear(glm::ivec3 cells, const std::vector<float>& values, glm::dvec3 x);

}  // namespace bruma::render
