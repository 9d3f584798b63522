// Shelf: closed form. Light that moves must not make any cell jump, and lights near by must cast the shadows of points.
#include <algorithm>
#include <cmath>

#include "drawing.h"
#include "light_grids.h"

namespace bruma::render {
namespace {

using LightMotion = Drawing;

/// Largest change of any cell at each step of a light along a path.
std::vector<double> changes(gl::ShaderLibrary& shaders, const LightCase& c, const std::vector<scene::Light>& path) {
    std::vector<double> result;
    Swept before;
    for (const scene::Light& light : path) {
        Swept now = sweep(shaders, c, light);
        if (!before.direct.empty() || !before.beside.empty()) {
            double most = 0.0;
            for (std::size_t n = 0; n < now.direct.size(); ++n) {
                most = std::max(most, std::abs(double(now.direct[n]) - before.direct[n]));
            }
            for (std::size_t n = 0; n < now.beside.size(); ++n) {
                most = std::max(most, std::abs(double(now.beside[n].x) - before.beside[n].x));
            }
            result.push_back(most);
        }
        before = std::move(now);
    }
    return result;
}

double largest_to_median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.back() / std::max(values[values.size() / 2], 1e-12);
}

/// Directions in steps of 0.01 degrees through `middle`, turning about `axis`.
std::vector<scene::Light> turn_through(glm::dvec3 middle, glm::dvec3 axis) {
    std::vector<scene::Light> path;
    const glm::dvec3 m = glm::normalize(middle);
    const glm::dvec3 side = glm::normalize(glm::cross(axis, m));
    for (int n = -10; n <= 10; ++n) {
        const double angle = glm::radians(0.01 * (n + 0.5));
        path.push_back(sunlight(std::cos(angle) * m + std::sin(angle) * side));
    }
    return path;
}

struct Turn {
    const char* name;
    glm::dvec3 middle, axis;
};
const Turn turns[] = {
    {"two largest components swap", {0.65, 0.35, 0.65}, {0.0, 1.0, 0.0}},
    {"two smallest components swap", {0.8, 0.4, 0.4}, {1.0, 0.0, 0.0}},
    {"diagonal", {1.0, 1.0, 1.0}, {1.0, -1.0, 0.0}},
    {"a component changes sign", {0.5, 0.0, 0.8}, {1.0, 0.0, -0.6}},
    {"a shift of half a cell", {0.0, 0.5, 1.0}, {1.0, 0.0, 0.0}},
};

TEST_F(LightMotion, Test12NoCellJumpsWhenTheLightTurns) {
    for (const glm::dvec3 extent : {glm::dvec3(1.0), glm::dvec3(1.0, 1.0, 2.0)}) {
        for (const SweptState state : {SweptState::direct, SweptState::diffuse}) {
            LightCase c = blobs(24, extent);
            c.albedo = glm::dvec3(0.7);  // with 1, diffuse light is what direct light lacks, and tells nothing new
            c.settings = {.state = state, .spread = 0.03, .precision = scene::LightPrecision::single};
            for (const Turn& turn : turns) {
                const double ratio = largest_to_median(changes(shaders(), c, turn_through(turn.middle, turn.axis)));
                report(std::string(turn.name) + (state == SweptState::direct ? ", direct" : ", diffuse"), ratio);
                EXPECT_LE(ratio, 3.0);
            }
        }
    }
}

TEST_F(LightMotion, Test12OneAndTwoAxesDoJump) {
    // What three axes are for; and proof that the test above can fail.
    double worst[3] = {};
    for (const int axis_count : {1, 2}) {
        LightCase c = blobs(24, {1.0, 1.0, 2.0});
        c.axis_count = axis_count;
        c.settings = {.state = SweptState::chromaticity, .precision = scene::LightPrecision::single};
        for (const Turn& turn : turns) {
            worst[axis_count] = std::max(
                worst[axis_count], largest_to_median(changes(shaders(), c, turn_through(turn.middle, turn.axis))));
        }
        report("largest jump against the median, axes: " + std::to_string(axis_count), worst[axis_count]);
    }
    EXPECT_GT(worst[1], 20.0);
    EXPECT_GT(worst[2], 6.0);
}

TEST_F(LightMotion, PointLightsOutsideNearAndInside) {
    for (const glm::dvec3 place : {glm::dvec3(3.0, 1.0, 2.0), glm::dvec3(0.2, 0.1, 0.9), glm::dvec3(0.5, 0.0, 0.0),
                                   glm::dvec3(0.11, -0.07, 0.2), glm::dvec3(0.0)}) {
        const LightCase c{.cells = glm::ivec3(48), .sigma = uniform(3.0)};
        const Swept swept = sweep(shaders(), c, lamp_at(place));
        const auto exact = [&](glm::dvec3 x) {
            const glm::dvec3 way = place - x;
            const double distance = glm::length(way);
            return distance > 0.0 ? std::exp(-3.0 * std::min(distance, way_out(c.extent, x, way / distance))) : 1.0;
        };
        report("mean error", mean_error(c, swept, exact));
        report("largest error", largest_error(c, swept, exact));
        EXPECT_LE(mean_error(c, swept, exact), 0.5 / 48);
        // Parallel light has the same kink behind the box's edges, larger or smaller with its direction.
        double parallel = 0.03;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 seen_from = glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) - 0.5;
            const glm::dvec3 omega = glm::normalize(place - seen_from + 1e-9);
            const Swept straight = sweep(shaders(), c, sunlight(omega));
            parallel = std::max(parallel, largest_error(c, straight, [&](glm::dvec3 x) {
                                    return std::exp(-3.0 * way_out(c.extent, x, omega));
                                }));
        }
        report("largest error of parallel light", parallel);
        EXPECT_LE(largest_error(c, swept, exact), parallel);
    }
}

TEST_F(LightMotion, PointLightsCastShadowsFromWhereTheyStand) {
    // An opaque plate between an inside light and one side: dark behind it, full light on the other side.
    constexpr int n = 40;
    const LightCase c{.cells = glm::ivec3(n),
                      .sigma = [](glm::ivec3 at) { return at.x == 28 && at.y > 8 && at.y < 32 ? 1e4 : 0.0; }};
    const Swept swept = sweep(shaders(), c, lamp_at({0.02, 0.0, 0.01}));
    const auto at = [&](int x, int y, int z) { return swept.direct[std::size_t((z * n + y) * n + x)]; };
    EXPECT_LE(at(34, 20, 20), 1e-3);
    EXPECT_LE(at(38, 20, 12), 1e-3);
    EXPECT_GE(at(10, 20, 20), 0.999);
    EXPECT_GE(at(24, 4, 30), 0.999);
}

TEST_F(LightMotion, NoCellJumpsWhenAPointLightMovesThroughTheGrid) {
    LightCase c = blobs(24);
    // Fixed irradiance: what jumps is the share that arrives. Through faces, centres and borders of cells.
    for (const glm::dvec3 start : {glm::dvec3(0.02, 0.03, 0.5), glm::dvec3(1.0 / 48, 1.0 / 48, 1.0 / 48)}) {
        std::vector<scene::Light> path;
        for (int n = -10; n <= 10; ++n) {
            path.push_back(lamp_at(start + glm::dvec3(1e-5, 2e-5, 1e-4) * (n + 0.5)));
        }
        std::vector<double> steps = changes(shaders(), c, path);
        const double most = *std::max_element(steps.begin(), steps.end());
        report("largest change for a step of 1e-4", most);
        // A smooth field changes by about its gradient, below 30 per metre here, times the step.
        EXPECT_LE(most, 30.0 * 1.1e-4);
    }
}

TEST_F(LightMotion, LightsInOddPlacesGiveFiniteLight) {
    LightCase c = blobs(10, {1.0, 0.1, 3.0});
    for (const SweptState state : {SweptState::direct, SweptState::diffuse, SweptState::chromaticity}) {
        c.settings.state = state;
        for (const scene::Light& light :
             {lamp_at({0.0, 0.0, 0.0}), lamp_at({0.5, 0.0, 0.0}), lamp_at({0.5, 0.05, 1.5}),
              lamp_at({0.05, 0.005, 0.15}), lamp_at(glm::dvec3(1e300)), lamp_at({1e7, 0.0, 0.0}),
              lamp_at(glm::dvec3(1e-300)), sunlight({1e-200, 0.0, 1e-200}), sunlight({1.0, 1e-9, 1e-18})}) {
            const Swept swept = sweep(shaders(), c, light);
            for (const float value : swept.direct) {
                ASSERT_TRUE(value >= 0.0F && value <= 1.00001F) << value;
            }
            for (const glm::vec4 value : swept.beside) {
                ASSERT_TRUE(value.x >= 0.0F && value.x <= 1.00001F && value.w >= 0.0F && value.w <= 1.00001F)
                    << value.x;
            }
        }
    }
    for (const double sigma : {1e-9, 1e9}) {
        c.sigma = uniform(sigma);
        c.settings.state = SweptState::diffuse;
        for (const glm::vec4 value : sweep(shaders(), c, sunlight({0.3, 0.5, 0.8})).beside) {
            ASSERT_NEAR(value.x + value.w, 1.0, 1e-4);
        }
    }
}

}  // namespace
}  // namespace bruma::render
