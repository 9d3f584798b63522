// Shelf: closed form. Light swept through grids of known extinction, against what the integral gives.
#include <algorithm>
#include <cmath>
#include <random>

#include "drawing.h"
#include "light_grids.h"

namespace bruma::render {
namespace {

const glm::dvec3 oblique = glm::normalize(glm::dvec3(0.30, 0.52, 0.80));
const glm::dvec3 thirty(0.0, 0.5, std::sqrt(0.75));
const glm::dvec3 forty_five(0.0, std::sqrt(0.5), std::sqrt(0.5));
const glm::dvec3 diagonal = glm::normalize(glm::dvec3(1.0));

using LightSweep = Drawing;

TEST_F(LightSweep, Test08AlongAnAxisIsExponential) {
    for (const glm::ivec3 cells : {glm::ivec3(16), glm::ivec3(64), glm::ivec3(5, 5, 256)}) {
        const LightCase c{.cells = cells, .extent = glm::dvec3(cells) / double(cells.z), .sigma = uniform(4.0)};
        for (const double side : {1.0, -1.0}) {
            const double error = largest_error(c, sweep(shaders(), c, sunlight({0.0, 0.0, side})),
                                               [&](glm::dvec3 x) { return std::exp(-4.0 * (0.5 - side * x.z)); });
            report("largest error of " + std::to_string(cells.z) + " slices", error);
            // A last-bit error of exp repeats at every slice.
            EXPECT_LE(error, cells.z <= 64 ? 1e-5 : 5e-5);
        }
    }
}

TEST_F(LightSweep, Test09ObliqueThroughAHomogeneousCube) {
    for (const glm::dvec3 omega : {thirty, oblique, forty_five, diagonal}) {
        double coarse_mean = 0.0;
        for (const int n : {32, 64}) {
            const LightCase c{.cells = glm::ivec3(n), .sigma = uniform(4.0)};
            const auto exact = [&](glm::dvec3 x) { return std::exp(-4.0 * way_out(glm::dvec3(1.0), x, omega)); };
            const Swept swept = sweep(shaders(), c, sunlight(omega));
            const double mean = mean_error(c, swept, exact);
            const double most = largest_error(c, swept, exact);
            report("mean error", mean);
            report("largest error", most);
            if (omega == forty_five || omega == diagonal) {
                EXPECT_LE(most, 1e-5);  // the shift is whole cells: only lengths of ways can be wrong
                continue;
            }
            EXPECT_LE(mean, 0.5 / n);
            // The kink behind the entry corner is smeared by interpolation.
            EXPECT_LE(most, 0.35 * std::sqrt(4.0 / n));
            if (n == 64) {
                EXPECT_LE(mean, 0.7 * coarse_mean) << "first order";
            }
            coarse_mean = mean;
        }
    }
}

TEST_F(LightSweep, Test10EnergyIsKept) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<double> values(20 * 24 * 16);
    for (double& value : values) {
        value = 30.0 * std::pow(unit(random), 4.0);
    }
    LightCase c{.cells = {20, 24, 16}, .extent = {1.0, 1.2, 0.5}, .sigma = [&](glm::ivec3 at) {
                    return values[std::size_t((at.z * 24 + at.y) * 20 + at.x)];
                }};
    for (const double spread : {0.0, 0.03, 0.3}) {
        c.settings = {.state = SweptState::diffuse, .spread = spread, .precision = scene::LightPrecision::single};
        for (const glm::dvec3 omega : {glm::dvec3(0.0, 0.0, 1.0), oblique, diagonal}) {
            double most = 0.0;
            for (const glm::vec4 at : sweep(shaders(), c, sunlight(omega)).beside) {
                most = std::max(most, std::abs(double(at.x) + at.w - 1.0));
            }
            report("largest |l + m - 1|", most);
            EXPECT_LE(most, 1e-4);
        }
    }
}

TEST_F(LightSweep, Test11SlicesDoNotChangeTheLight) {
    // Absorption of a uniform slab: exp(-(1 - w) tau) whatever the number of slices; S = w (1 - T) would give 4 % more.
    double along[3] = {};
    for (int n = 0; n < 3; ++n) {
        const int slices = 32 << (2 * n);
        LightCase c{
            .cells = {4, 4, slices}, .extent = {1.0, 1.0, 1.0}, .sigma = uniform(4.0), .albedo = glm::dvec3(0.9)};
        c.settings = {.state = SweptState::diffuse, .precision = scene::LightPrecision::single};
        const Swept swept = sweep(shaders(), c, sunlight({0.0, 0.0, 1.0}));
        for (int z = 0; z < slices; ++z) {
            const glm::vec4 at = swept.beside[std::size_t(z) * 16 + 5];
            const double tau = 4.0 * (slices - z - 0.5) / slices;
            EXPECT_NEAR(at.x + at.w, std::exp(-0.1 * tau), 2e-4);
        }
        // Smooth extinction, read at one place.
        c.sigma = [slices](glm::ivec3 at) { return 4.0 + 3.0 * std::sin(6.0 * (at.z + 0.5) / slices); };
        c.settings.state = SweptState::direct;
        const auto direct = sweep(shaders(), c, sunlight({0.0, 0.0, 1.0})).direct;
        along[n] = 0.5 * (direct[std::size_t(slices) / 4 * 16 - 11] + direct[std::size_t(slices) / 4 * 16 + 5]);
    }
    report("change of light, 32 against 512 slices", std::abs(along[0] / along[2] - 1.0));
    EXPECT_NEAR(along[0] / along[2], 1.0, 0.01);
    EXPECT_NEAR(along[1] / along[2], 1.0, 0.003);
}

TEST_F(LightSweep, Test11SpreadDoesNotDependOnResolution) {
    // A screen with a hole and a gap below it; light scattered below it must be as wide at any resolution, read at one
    // depth.
    double widths[3] = {};
    for (int n = 0; n < 3; ++n) {
        const int edge = 24 << n;
        LightCase c{.cells = glm::ivec3(edge), .sigma = [edge](glm::ivec3 at) {
                        const glm::dvec2 x = (glm::dvec2(at) + 0.5) / double(edge) - 0.5;
                        const bool hole = std::max(std::abs(x.x), std::abs(x.y)) < 1.0 / 12.0;
                        const double z = (at.z + 0.5) / edge;
                        return z > 11.0 / 12.0 ? (hole ? 0.0 : 1e4) : z > 10.0 / 12.0 ? 0.0 : 20.0;
                    }};
        c.settings = {.state = SweptState::diffuse, .spread = 0.025, .precision = scene::LightPrecision::single};
        c.albedo_at = [edge](glm::ivec3 at) { return glm::dvec3((at.z + 0.5) / edge > 10.0 / 12.0 ? 0.0 : 1.0); };
        const Swept swept = sweep(shaders(), c, sunlight({0.0, 0.0, 1.0}));
        double sum = 0.0, squares = 0.0;
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x) {
                const auto at = [&](int z) { return double(swept.beside[(std::size_t(z) * edge + y) * edge + x].x); };
                const double m = 0.5 * (at(edge / 4 - 1) + at(edge / 4));
                const double place = (x + 0.5) / edge - 0.5;
                sum += m;
                squares += m * place * place;
            }
        }
        // The hole alone is 1/6 wide.
        widths[n] = std::sqrt(squares / sum - 1.0 / 432.0);
        report("spread of diffuse light at " + std::to_string(edge), widths[n]);
    }
    // Scatterings are a Poisson process: tau / (1 - exp(-tau)) of them in the mean where there is at least one.
    const double tau = 20.0 * (10.0 / 12.0 - 0.25);
    const double expected = 0.025 * std::sqrt(tau / -std::expm1(-tau));
    for (const double width : widths) {
        // At the coarsest a slice scatters twice, at a place known to half a slice only.
        EXPECT_NEAR(width / expected, 1.0, 0.02);
    }
    EXPECT_NEAR(widths[1] / widths[2], 1.0, 0.01);
}

TEST_F(LightSweep, Test13TurningTheDataWithTheLight) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int n = 12;
    std::vector<double> values(n * n * n);
    for (double& value : values) {
        value = 20.0 * unit(random);
    }
    const auto value_at = [&](glm::ivec3 at) { return values[std::size_t((at.z * n + at.y) * n + at.x)]; };
    const Swept original = sweep(shaders(), {.cells = glm::ivec3(n), .sigma = value_at}, sunlight(oblique));
    double most = 0.0;
    for (const CubeTurn& turn : turns_of_a_cube()) {
        const CubeTurn back = glm::transpose(turn);
        const auto turned_from = [&](glm::ivec3 at) {
            return glm::ivec3(glm::round(0.5 * (back * glm::dvec3(2 * at - (n - 1)) + double(n - 1))));
        };
        const LightCase c{.cells = glm::ivec3(n), .sigma = [&](glm::ivec3 at) { return value_at(turned_from(at)); }};
        const Swept turned = sweep(shaders(), c, sunlight(turn * oblique));
        for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t index) {
            const glm::ivec3 from = turned_from(at);
            most = std::max(most, std::abs(double(turned.direct[index]) -
                                           original.direct[std::size_t((from.z * n + from.y) * n + from.x)]));
        });
    }
    report("largest change under 24 turns", most);
    EXPECT_LE(most, 2e-6);  // sums in another order
}

TEST_F(LightSweep, Test14TurningTheLightAboutABlob) {
    const auto blob = [](double r) { return 40.0 * std::exp(-r * r / 0.03); };
    for (const int n : {32, 64}) {
        const LightCase c{.cells = glm::ivec3(n), .sigma = [&](glm::ivec3 at) {
                              return blob(glm::length((glm::dvec3(at) + 0.5) / double(n) - 0.5));
                          }};
        const glm::dvec3 omegas[2] = {{0.0, 0.0, 1.0}, glm::normalize(glm::dvec3(0.3, -0.5, 0.7))};
        const Swept straight = sweep(shaders(), c, sunlight(omegas[0]));
        const Swept tilted = sweep(shaders(), c, sunlight(omegas[1]));
        const glm::dmat3 turn = turn_between(omegas[0], omegas[1]);
        double squares = 0.0;
        int count = 0;
        for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t index) {
            const glm::dvec3 x = (glm::dvec3(at) + 0.5) / double(n) - 0.5;
            if (glm::length(x) < 0.42) {
                const double difference = trilinear(c.cells, tilted.direct, turn * x) - straight.direct[index];
                squares += difference * difference;
                ++count;
            }
        });
        const double rms = std::sqrt(squares / count);
        report("RMS change at " + std::to_string(n), rms);
        EXPECT_LE(rms, n == 32 ? 0.02 : 0.01);
    }
}

TEST_F(LightSweep, Test15NoLightLeaksThroughAWall) {
    constexpr int n = 64;
    for (const int thick : {1, 2, 4}) {
        // Angles off the wall's normal: slices across the wall shift by 1 to 6 cells, and would jump it.
        for (const double degrees : {0.0, 10.0, 18.4349, 26.5651, 30.0, 45.0, 60.0}) {
            const glm::dvec3 omega(std::sin(glm::radians(degrees)), 0.0, std::cos(glm::radians(degrees)));
            // Opacity of a cell: 1 - 2^-16.
            const LightCase c{.cells = {n, 3, n}, .extent = {1.0, 3.0 / n, 1.0}, .sigma = [=](glm::ivec3 at) {
                                  return at.z >= 44 && at.z < 44 + thick ? 16.0 * std::log(2.0) * n : 0.0;
                              }};
            const Swept swept = sweep(shaders(), c, sunlight(omega));
            double most = 0.0;
            int dark = 0;
            for_each_cell(c.cells, [&](glm::ivec3 at, std::size_t index) {
                // Distance from the ray that grazes the wall's end at the border, across it. Interpolation smears that
                // edge by sqrt(n f (1 - f)) <= 4 cells; a thousandth is reached at 3.1 times that.
                const double to_edge = ((n - at.x - 0.5) - (44.0 - at.z - 0.5) * omega.x / omega.z) * omega.z;
                if (at.z < 42 && to_edge > 12.5) {
                    most = std::max(most, double(swept.direct[index]));
                    ++dark;
                }
            });
            EXPECT_LE(most, 1e-3) << thick << " cells, " << degrees << " degrees";
            EXPECT_GT(dark, 200);
        }
    }
}

TEST_F(LightSweep, Test16WidthOfAnEdgeSweptByOneAxis) {
    // Repeated bilinear interpolation is a random walk: 2.56 sqrt(n f (1 - f)) cells from 10 to 90 %.
    constexpr int n = 96;
    for (const double f : {0.1, 0.25, 0.5}) {
        const LightCase c{.cells = {n, 3, n},
                          .extent = {1.0, 3.0 / n, 1.0},
                          .sigma = [](glm::ivec3 at) { return at.z == n - 2 && at.x < n / 4 ? 1e5 : 0.0; },
                          .axis_count = 1};
        const Swept swept = sweep(shaders(), c, sunlight(glm::normalize(glm::dvec3(-f, 0.0, 1.0))));
        const auto row = [&](int x) { return double(swept.direct[std::size_t(n) + x]); };  // z = 0, y = 1
        const auto crossing = [&](double level) {
            for (int x = 1; x < n; ++x) {
                if (row(x - 1) < level && row(x) >= level) {
                    return x - 1 + (level - row(x - 1)) / (row(x) - row(x - 1));
                }
            }
            return -1e9;
        };
        const double width = crossing(0.9) - crossing(0.1);
        const double expected = 2.56 * std::sqrt((n - 2) * f * (1.0 - f));
        report("edge width at shift " + std::to_string(f), width);
        EXPECT_NEAR(width / expected, 1.0, 0.1);
    }
}

TEST_F(LightSweep, Test20ThinExtinctionOverManySlices) {
    for (const scene::LightPrecision kept : {scene::LightPrecision::single, scene::LightPrecision::half}) {
        LightCase c{.cells = {3, 3, 256}, .extent = {3.0 / 256, 3.0 / 256, 1.0}, .sigma = uniform(256 * 2.00020003e-4)};
        c.settings.precision = kept;
        const Swept swept = sweep(shaders(), c, sunlight({0.0, 0.0, 1.0}));
        // 255.5 slices, each of opacity 2e-4. Half precision keeps 5e-4 of the result; in the sweep it would stay at 1.
        EXPECT_NEAR(swept.direct[4], std::pow(1.0 - 2e-4, 255.5), 1e-3);
    }
}

TEST_F(LightSweep, Test21TheSameEveryTime) {
    LightCase c = blobs(24);
    for (const int per_dispatch : {0, 1, 5}) {
        c.settings.slices_per_dispatch = per_dispatch;
        const Swept first = sweep(shaders(), c, sunlight(oblique));
        for (int turn = 0; turn < 33; ++turn) {
            ASSERT_EQ(sweep(shaders(), c, sunlight(oblique)).direct, first.direct);
        }
        c.settings.slices_per_dispatch = 1;
        EXPECT_EQ(sweep(shaders(), c, sunlight(oblique)).direct, first.direct)
            << "the number of slices of a dispatch changes the time and not the light";
    }
}

TEST_F(LightSweep, KnowingWhereItIsEmptyChangesNoBit) {
    // Macrocells of two cells, a few of them occupied; distances by brute force.
    constexpr int n = 32;
    constexpr int blocks = n / 2;
    const auto occupied = [](glm::ivec3 block) { return (block.x * 7 + block.y * 13 + block.z * 29) % 97 == 0; };
    std::vector<std::uint8_t> distance;
    for_each_cell(glm::ivec3(blocks), [&](glm::ivec3 at, std::size_t) {
        int nearest = 255;
        for_each_cell(glm::ivec3(blocks), [&](glm::ivec3 other, std::size_t) {
            const glm::ivec3 apart = glm::abs(other - at);
            nearest = occupied(other) ? std::min(nearest, std::max({apart.x, apart.y, apart.z})) : nearest;
        });
        distance.push_back(std::uint8_t(nearest));
    });
    gl::Texture emptiness = gl::Texture::make_3d("emptiness", GL_R8UI, glm::ivec3(blocks));
    emptiness.set_nearest();
    emptiness.upload({GL_RED_INTEGER, GL_UNSIGNED_BYTE}, distance.data());
    LightCase c{.cells = glm::ivec3(n), .sigma = [&](glm::ivec3 at) { return occupied(at / 2) ? 40.0 : 0.0; }};
    for (const scene::Light& light :
         {sunlight(oblique), sunlight({0.1, 0.0, 1.0}), sunlight({0.25, 0.9, 0.3}), lamp_at({0.1, 0.2, 0.05})}) {
        const Swept without = sweep(shaders(), c, light);
        const Swept with = sweep(shaders(), c, light, {&emptiness, glm::dvec3(0.5), glm::dvec3(0.0)});
        EXPECT_EQ(with.direct, without.direct);
    }
}

TEST_F(LightSweep, AxesWithoutWeightCostNothing) {
    const LightCase c = blobs(8);
    EXPECT_EQ(plan_of(c, sunlight({0.0, 0.0, 1.0})).axes.size(), 1U);
    EXPECT_EQ(plan_of(c, sunlight({0.0, 0.02, 1.0})).axes.size(), 1U);  // 0.0004 of the light
    EXPECT_EQ(plan_of(c, sunlight(thirty)).axes.size(), 2U);
    EXPECT_EQ(plan_of(c, sunlight(oblique)).axes.size(), 3U);
}

}  // namespace
}  // namespace bruma::render
