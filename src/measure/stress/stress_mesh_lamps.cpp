#include <fmt/core.h>

#include <limits>
#include <numbers>

#include "measure/stress/stress_mesh.h"

namespace bruma::measure {
namespace {

using scene::Light;
using scene::LightKind;

scene::Scene under(const Light& light) {
    scene::Scene scene = ball_scene();
    set_sun(scene, light);
    return scene;
}

/// Lights the middle of the ball with irradiance pi.
Light lamp_on_ball(glm::dvec3 position) {
    const double distance = glm::length(position);
    return {.kind = LightKind::point,
            .position_world = position,
            .intensity = std::numbers::pi * std::max(1e-4, distance * distance)};
}

/// Near a lamp light is as strong as one wants.
constexpr double any = 1e30;

}  // namespace

void stress_mesh_lamps(MeshCases& cases) {
    const glm::dvec3 way = glm::normalize(glm::dvec3(0.3, 0.5, 0.8));
    const double radius = 0.010;  // metres, of the ball
    for (const double distance : {0.0, 1e-9, 0.5, 0.999, 1.0, 1.0 + 1e-6, 1.001, 1.1, 1.24, 1.26, 3.0}) {
        cases.sound(
            fmt::format("point-{:g}r", distance), "a lamp so many radii from the middle",
            [&] { return under(lamp_on_ball(distance * radius * way)); }, any);
    }
    cases.sound(
        "point-on-corner", "a lamp on a corner of the mesh",
        [&] {
            const scene::Scene ball = ball_scene();
            return under(lamp_on_ball(
                glm::dvec3((*std::get<scene::Mesh>(ball.nodes.at("mesh").content).triangles)->positions[40])));
        },
        any);
    cases.sound(
        "point-on-pole", "a lamp where twelve triangles meet",
        [&] {
            return under(lamp_on_ball({0.0, radius, 0.0}));
        },
        any);
    // A lamp as far as this many radii differs from parallel light by twice its inverse.
    const Light parallel{.direction_world = way};
    for (const bool translucent : {true, false}) {
        const auto shaded = [translucent](scene::Scene scene) {
            stress_mesh(scene).surface.edit([&](scene::MeshSurface& surface) {
                surface.shading = translucent ? scene::MeshShading::translucent : scene::MeshShading::blinn_phong;
            });
            return scene;
        };
        for (const double metres : {10.0, 100.0, 1e3, 1e6, 1e9, 1e12, 1e15}) {
            cases.same(fmt::format("far-{:g}m-{}", metres, translucent ? "translucent" : "opaque"),
                       "against parallel light, a share of the brightest", 0.02, shaded(under(parallel)),
                       shaded(under(lamp_on_ball(metres * way))));
        }
    }
    for (const double metres : {1e30, 1e150, 1e300}) {
        cases.sound(fmt::format("far-{:g}m", metres), "so far that nothing arrives", [&] {
            return under({.kind = LightKind::point, .position_world = metres * way, .intensity = 1e12});
        });
    }
    for (const double metres : {1e3, 1e9}) {
        Light spot = lamp_on_ball(metres * way);
        spot.kind = LightKind::spot;
        spot.direction_world = way;
        cases.same(fmt::format("spot-far-{:g}m", metres), "a spot aimed at the ball against parallel light", 0.02,
                   under(parallel), under(spot));
    }
    for (const double angle : {0.1, 90.0, 179.0}) {
        for (const double softness : {0.0, 1.0}) {
            cases.sound(
                fmt::format("spot-{:g}-{:g}", angle, softness), "a spot of this angle and softness",
                [&] {
                    Light spot = lamp_on_ball(3.0 * radius * way);
                    spot.kind = LightKind::spot;
                    spot.direction_world = way;
                    spot.spot_angle_deg = angle;
                    spot.spot_softness = softness;
                    return under(spot);
                },
                any);
        }
    }
    cases.sound(
        "spot-inside", "a spot inside the body",
        [&] {
            Light spot = lamp_on_ball(0.3 * radius * way);
            spot.kind = LightKind::spot;
            spot.direction_world = -way;
            return under(spot);
        },
        any);
    for (const double length : {1e-150, 1e-30, 1e30, 1e150}) {
        cases.same(fmt::format("direction-{:g}", length), "a direction of this length against the unit vector", 1e-3,
                   under(parallel), under({.direction_world = length * way}));
    }
    for (const double length : {0.0, 1e-300, 1e200, 1e308}) {
        cases.refused(fmt::format("direction-{:g}", length), "a direction without a length that numbers hold",
                      [&] { scene::check(under({.direction_world = length * way})); });
    }
    cases.refused("position-nan", "a lamp at no place", [&] {
        scene::check(under(lamp_on_ball({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0})));
    });
    cases.sound("headlight", "light along the view", [&] { return under({.kind = LightKind::headlight}); });
    cases.sound(
        "strongest", "the largest intensity and colour",
        [&] { return under({.color = glm::dvec3(1e6), .intensity = 1e12}); }, 1e19);
    cases.sound(
        "strongest-point", "the same of a lamp beside it",
        [&] {
            Light lamp = lamp_on_ball(2.0 * radius * way);
            lamp.color = glm::dvec3(1e6);
            lamp.intensity = 1e12;
            return under(lamp);
        },
        1e30);
    cases.sound(
        "none", "no lamp at all",
        [&] {
            scene::Scene scene = ball_scene();
            scene.lights.clear();
            return scene;
        },
        0.0);
    cases.sound(
        "off", "a lamp that is off", [&] { return under({.on = false}); }, 0.0);
    cases.sound(
        "black", "a lamp without colour", [&] { return under({.color = glm::dvec3(0.0)}); }, 0.0);
    cases.sound(
        "eight", "eight lamps of all kinds, one inside",
        [&] {
            scene::Scene scene = ball_scene();
            for (int n = 0; n < 8; ++n) {
                Light light =
                    lamp_on_ball((0.4 + 0.5 * n) * radius * glm::normalize(glm::dvec3(n - 3.5, 2 - n % 3, 1.0)));
                light.kind = LightKind(n % 4);
                light.intensity =
                    light.kind == LightKind::point || light.kind == LightKind::spot ? light.intensity : 0.3;
                scene.lights["lamp" + std::to_string(n)] = light;
            }
            return scene;
        },
        any);
}

}  // namespace bruma::measure
