#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "measure/bench/bench_machine.h"
#include "measure/stress/stress_light.h"
#include "render/light/light_sweep.h"

namespace bruma::measure {
namespace {

constexpr int edge = 12;

/// Smooth lumps of matter: extinction of each cell times the grid's length.
gl::Texture lumps() {
    std::vector<float> values;
    for (int n = 0; n < edge * edge * edge; ++n) {
        const glm::dvec3 x = (glm::dvec3(n % edge, n / edge % edge, n / (edge * edge)) + 0.5) / double(edge);
        double sum = 0.0;
        for (const glm::dvec4 lump :
             {glm::dvec4(0.3, 0.4, 0.6, 30.0), glm::dvec4(0.7, 0.6, 0.3, 50.0), glm::dvec4(0.5, 0.2, 0.3, 20.0)}) {
            const glm::dvec3 way = x - glm::dvec3(lump);
            sum += lump.w * std::exp(-glm::dot(way, way) / 0.015);
        }
        values.push_back(float(sum));
    }
    gl::Texture texture = gl::Texture::make_3d("extinction", GL_R32F, glm::ivec3(edge));
    texture.upload({GL_RED, GL_FLOAT}, values.data());
    return texture;
}

gl::Texture uniform_albedo() {
    const std::vector<glm::vec4> values(std::size_t(edge) * edge * edge, glm::vec4(0.7F));
    gl::Texture texture = gl::Texture::make_3d("albedo", GL_RGBA32F, glm::ivec3(edge));
    texture.upload({GL_RGBA, GL_FLOAT}, values.data());
    return texture;
}

/// Where a light goes: from `a` towards `b`, which is square to it.
struct Path {
    glm::dvec3 a, b;
    double from_deg, step_deg;
    int steps;
};

/// Through no axis and no diagonal exactly, so that it meets the changes of axes as lights do.
Path once_around() {
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.9, 0.3, 0.2));
    return {a, glm::normalize(glm::cross(a, glm::dvec3(0.1, -0.4, 0.8))), 0.0, 0.5, 720};
}

/// Through the place where the two largest components of its direction swap.
Path through_a_swap() {
    const glm::dvec3 a = glm::normalize(glm::dvec3(0.65, 0.35, 0.65));
    return {a, glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), a)), -0.095, 0.01, 19};
}

/// The largest change of any cell in one step of the light, over the median of all steps.
double jump_over_median(gl::ShaderLibrary& shaders, const Path& path, render::SweptState state, int axis_count) {
    render::LightGrid grid;
    grid.cells = glm::ivec3(edge);
    const glm::dvec3 extent(1.0, 1.0, 2.0);  // on cubes even one axis moves smoothly
    grid.world_from_cells = glm::scale(glm::translate(glm::dmat4(1.0), -0.5 * extent), extent / double(edge));
    grid.length = extent.z;
    const gl::Texture extinction = lumps(), albedo = uniform_albedo();
    render::SweepSettings settings;
    settings.state = state;
    settings.spread = 0.03;
    settings.precision = scene::LightPrecision::single;
    const int channels = state == render::SweptState::direct ? 1 : 4;
    std::vector<float> before, now(std::size_t(channels) * edge * edge * edge);
    std::vector<double> steps;
    for (int n = 0; n <= path.steps; ++n) {
        const double angle = glm::radians(path.from_deg + path.step_deg * n);
        const scene::Light light{.direction_world = std::cos(angle) * path.a + std::sin(angle) * path.b};
        const render::SweptLight swept = render::sweep_light(
            shaders, extinction, albedo, render::plan_sweep(grid, light, {0.0, 0.0, 1.0}, axis_count), settings);
        (channels == 1 ? swept.direct : swept.beside)
            .download({channels == 1 ? GLenum(GL_RED) : GLenum(GL_RGBA), GL_FLOAT}, now.size() * sizeof(float),
                      now.data());
        if (!before.empty()) {
            double most = 0.0;
            for (std::size_t k = 0; k < now.size(); ++k) {
                most = std::max(most, std::abs(double(now[k]) - before[k]));
            }
            steps.push_back(most);
        }
        before = now;
    }
    return *std::max_element(steps.begin(), steps.end()) / median(steps);
}

}  // namespace

void stress_light_motion(StressRig& rig) {
    rig.group("motion");
    struct Route {
        const char* name;
        const char* what;
        Path path;
    };
    for (const Route& route :
         {Route{"around", "a light once around in steps of 0.5 degrees: largest change of a cell over the median",
                once_around()},
          Route{"swap", "in steps of 0.01 degrees through a change of axes: the same", through_a_swap()}}) {
        const auto jump = [&](render::SweptState state, int axis_count) {
            return [&rig, &route, state, axis_count] {
                return jump_over_median(rig.shaders(), route.path, state, axis_count);
            };
        };
        const std::string name(route.name);
        rig.number(name + "-direct", route.what, 3.0, jump(render::SweptState::direct, 3));
        rig.number(name + "-diffuse", route.what, 3.0, jump(render::SweptState::diffuse, 3));
        rig.number(name + "-paper", "the same as published, with two axes; known to jump, no bound",
                   std::numeric_limits<double>::infinity(), jump(render::SweptState::chromaticity, 2));
    }
}

}  // namespace bruma::measure
