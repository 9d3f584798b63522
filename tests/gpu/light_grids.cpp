#include "light_grids.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace bruma::render {

std::function<double(glm::ivec3)> uniform(double sigma) {
    return [sigma](glm::ivec3) { return sigma; };
}

LightCase blobs(int edge, glm::dvec3 extent) {
    return {.cells = glm::ivec3(edge), .extent = extent, .sigma = [edge](glm::ivec3 at) {
                const glm::dvec3 x = (glm::dvec3(at) + 0.5) / double(edge);
                double sum = 0.0;
                for (const glm::dvec4 blob : {glm::dvec4(0.3, 0.4, 0.6, 30.0), glm::dvec4(0.7, 0.6, 0.3, 50.0),
                                              glm::dvec4(0.5, 0.2, 0.3, 20.0)}) {
                    const glm::dvec3 way = x - glm::dvec3(blob);
                    sum += blob.w * std::exp(-glm::dot(way, way) / 0.015);
                }
                return sum;
            }};
}

scene::Light sunlight(glm::dvec3 toward_world) {
    return {.direction_world = toward_world};
}

scene::Light lamp_at(glm::dvec3 position_world) {
    return {.kind = scene::LightKind::point, .position_world = position_world};
}

SweepPlan plan_of(const LightCase& c, const scene::Light& light) {
    LightGrid grid;
    grid.cells = c.cells;
    grid.world_from_cells =
        glm::scale(glm::translate(glm::dmat4(1.0), -0.5 * c.extent), c.extent / glm::dvec3(c.cells));
    grid.length = std::max({c.extent.x, c.extent.y, c.extent.z});
    return plan_sweep(grid, light, {0.0, 0.0, 1.0}, c.axis_count);
}

Swept sweep(gl::ShaderLibrary& shaders, const LightCase& c, const scene::Light& light, const EmptySpace& empty) {
    const SweepPlan plan = plan_of(c, light);
    std::vector<float> sigma;
    std::vector<glm::vec4> albedo;
    for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t) {
        sigma.push_back(float(c.sigma(at) * plan.grid.length));
        albedo.emplace_back(c.albedo_at ? c.albedo_at(at) : c.albedo, 0.0);
    });
    gl::Texture extinction = gl::Texture::make_3d("extinction", GL_R32F, c.cells);
    extinction.upload({GL_RED, GL_FLOAT}, sigma.data());
    gl::Texture colour = gl::Texture::make_3d("albedo", GL_RGBA32F, c.cells);
    colour.upload({GL_RGBA, GL_FLOAT}, albedo.data());
    const SweptLight light_of = sweep_light(shaders, extinction, colour, plan, c.settings, empty);
    Swept swept;
    swept.dispatches = light_of.dispatches;
    if (light_of.direct) {
        swept.direct.resize(sigma.size());
        light_of.direct.download({GL_RED, GL_FLOAT}, sigma.size() * sizeof(float), swept.direct.data());
    }
    if (light_of.beside) {
        swept.beside.resize(sigma.size());
        light_of.beside.download({GL_RGBA, GL_FLOAT}, sigma.size() * sizeof(glm::vec4), swept.beside.data());
    }
    return swept;
}

double way_out(glm::dvec3 extent, glm::dvec3 x, glm::dvec3 direction) {
    double t = 1e300;
    for (int k = 0; k < 3; ++k) {
        if (direction[k] != 0.0) {
            t = std::min(t, (std::copysign(0.5 * extent[k], direction[k]) - x[k]) / direction[k]);
        }
    }
    return t;
}

void for_each_cell(glm::ivec3 cells, const std::function<void(glm::ivec3, std::size_t)>& visit) {
    std::size_t index = 0;
    for (int z = 0; z < cells.z; ++z) {
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x) {
                visit({x, y, z}, index++);
            }
        }
    }
}

glm::dvec3 centre_of(const LightCase& c, glm::ivec3 at) {
    return ((glm::dvec3(at) + 0.5) / glm::dvec3(c.cells) - 0.5) * c.extent;
}

double largest_error(const LightCase& c, const Swept& swept, const std::function<double(glm::dvec3)>& exact) {
    double most = 0.0;
    for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t index) {
        const double error = std::abs(swept.direct[index] - exact(centre_of(c, at)));
        most = std::isfinite(error) ? std::max(most, error) : 1e300;
    });
    return most;
}

double mean_error(const LightCase& c, const Swept& swept, const std::function<double(glm::dvec3)>& exact) {
    double sum = 0.0;
    for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t index) {
        sum += std::abs(swept.direct[index] - exact(centre_of(c, at)));
    });
    return sum / double(swept.direct.size());
}

std::vector<CubeTurn> turns_of_a_cube() {
    std::vector<CubeTurn> turns;
    for (int x = 0; x < 3; ++x) {
        for (int y = 0; y < 3; ++y) {
            if (x == y) {
                continue;
            }
            for (int signs = 0; signs < 4; ++signs) {
                glm::dvec3 a(0.0), b(0.0);
                a[x] = (signs & 1) != 0 ? -1.0 : 1.0;
                b[y] = (signs & 2) != 0 ? -1.0 : 1.0;
                turns.emplace_back(a, b, glm::cross(a, b));
            }
        }
    }
    return turns;
}

glm::dmat3 turn_between(glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 axis = glm::normalize(glm::cross(from, to));
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), std::acos(glm::dot(from, to)), axis));
}

double trilinear(glm::ivec3 cells, const std::vector<float>& values, glm::dvec3 x) {
    const glm::dvec3 p = glm::clamp((x + 0.5) * glm::dvec3(cells) - 0.5, glm::dvec3(0.0), glm::dvec3(cells) - 1.001);
    const glm::ivec3 at(glm::floor(p));
    const glm::dvec3 f = p - glm::dvec3(at);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::ivec3 d(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
        const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(d));
        const glm::ivec3 c = at + d;
        sum += w.x * w.y * w.z * values[(std::size_t(c.z) * cells.y + c.y) * cells.x + c.x];
    }
    return sum;
}

}  // namespace bruma::render
