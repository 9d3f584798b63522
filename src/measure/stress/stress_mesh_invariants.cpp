#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "measure/stress/stress_mesh.h"

namespace bruma::measure {
namespace {

scene::Scene edited(scene::Scene scene, const std::function<void(scene::Scene&)>& change) {
    change(scene);
    return scene;
}

/// Lengths times a factor, coefficients over it.
scene::Scene scaled(double factor) {
    scene::Scene scene = mesh_scene(made(ball_parts(), factor));
    set_medium(scene, [factor](scene::SubsurfaceMedium& medium) {
        medium.reduced_scattering /= factor;
        medium.absorption /= factor;
    });
    return scene;
}

scene::MeshParts turned_inside_out(scene::MeshParts parts, bool with_normals) {
    for (auto& corners : parts.triangles) {
        std::swap(corners[1], corners[2]);
    }
    for (glm::dvec3& normal : parts.normals) {
        normal *= with_normals ? -1.0 : 1.0;
    }
    return parts;
}

/// Without its pole caps, so that nothing says which side is out but the order of corners.
scene::MeshParts open_ball(bool turned) {
    scene::MeshParts parts = ball_parts();
    parts.normals.clear();
    std::erase_if(parts.triangles, [&](const auto& corners) {
        return std::any_of(corners.begin(), corners.end(), [&](const scene::FaceCorner& corner) {
            return std::abs(parts.positions[std::size_t(corner.position)].y) > 9.0;
        });
    });
    for (auto& corners : parts.triangles) {
        for (scene::FaceCorner& corner : corners) {
            corner.normal = -1;
        }
    }
    parts.triangle_materials.resize(parts.triangles.size());
    return turned ? turned_inside_out(parts, false) : parts;
}

double grey_error(StressRig& rig) {
    scene::Scene scene = ball_scene();
    set_medium(scene, [](scene::SubsurfaceMedium& medium) {
        medium.reduced_scattering = glm::dvec3(0.7);
        medium.absorption = glm::dvec3(0.01);
    });
    const Image image = rig.draw(scene);
    double worst = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float* p = &image.rgba[4 * n];
        const auto [low, high] = std::minmax({p[0], p[1], p[2]});
        worst = std::max(worst, high > 0.0F ? double(high - low) / double(high) : 0.0);
    }
    return worst;
}

}  // namespace

void stress_mesh_invariants(MeshCases& cases) {
    for (const bool translucent : {true, false}) {
        const auto ball = [translucent](scene::Scene scene) {
            return edited(std::move(scene), [&](scene::Scene& s) {
                stress_mesh(s).surface.edit([&](scene::MeshSurface& surface) {
                    surface.shading = translucent ? scene::MeshShading::translucent : scene::MeshShading::blinn_phong;
                });
            });
        };
        const std::string kind = translucent ? "translucent" : "opaque";
        const scene::Scene usual = ball(ball_scene());
        for (const double factor : {2.0, 1e6}) {
            // Powers of two change no digit; others round each product.
            cases.same(fmt::format("light-{:g}-{}", factor, kind), "so many times the light, as a share",
                       factor == 2.0 ? 0.0 : 1e-5, usual,
                       edited(usual,
                              [&](scene::Scene& s) {
                                  s.lights.at("sun").edit([&](scene::Light& light) { light.intensity *= factor; });
                              }),
                       factor);
        }
        // Roundings shift texels' borders under the points that are drawn, of which a picture holds few here.
        for (const double factor : {1e-6, 1e-3, 1e3, 1e6}) {
            cases.same(fmt::format("lengths-{:g}-{}", factor, kind), "all lengths of mesh and matter times this", 0.02,
                       usual, ball(scaled(factor)));
        }
        cases.same("inside-out-" + kind, "turned inside out, against the usual ball", 0.0, usual,
                   ball(mesh_scene(made(turned_inside_out(ball_parts(), true)))));
        cases.same("inside-out-order-" + kind, "the order of corners turned, but not the normals", 0.0, usual,
                   ball(mesh_scene(made(turned_inside_out(ball_parts(), false)))));
        cases.same("open-inside-out-" + kind, "an open surface has no inside: turned, against not", 1e-3,
                   ball(mesh_scene(made(open_ball(false)))), ball(mesh_scene(made(open_ball(true)))));
        cases.same("order-" + kind, "triangles in another order", 1e-3, usual, ball(mesh_scene([] {
                       scene::MeshParts parts = ball_parts();
                       std::reverse(parts.triangles.begin(), parts.triangles.end());
                       return made(parts);
                   }())));
        cases.same("moved-" + kind, "body and camera 1 km away", 1e-3, usual, edited(usual, [](scene::Scene& s) {
                       const glm::dvec3 by(1000.0, -500.0, 250.0);
                       s.nodes.at("mesh").transform = scene::Transform{.translation = by};
                       s.camera->edit([by](scene::Camera& camera) {
                           camera.eye_world += by;
                           camera.target_world += by;
                       });
                   }));
        cases.same("turned-" + kind, "body, lamp and camera a quarter turned", 0.02, usual,
                   edited(usual, [](scene::Scene& s) {
                       const auto turn = [](glm::dvec3 v) { return glm::dvec3(v.z, v.y, -v.x); };
                       s.nodes.at("mesh").transform = scene::Transform{.rotation_deg = {0.0, 90.0, 0.0}};
                       s.lights.at("sun").edit(
                           [&](scene::Light& light) { light.direction_world = turn(light.direction_world); });
                       s.camera->edit([&](scene::Camera& camera) {
                           camera.eye_world = turn(camera.eye_world);
                           camera.target_world = turn(camera.target_world);
                       });
                   }));
        cases.same("dark-lamp-" + kind, "with a lamp that gives no light", 0.0, usual,
                   edited(usual, [](scene::Scene& s) { s.lights["dark"] = scene::Light{.intensity = 0.0}; }));
    }
    cases.rig().number("grey", "grey matter under white light: largest difference of two colours, as a share", 1e-6,
                       [&] { return grey_error(cases.rig()); });
    cases.same("twice", "the same picture drawn twice", 0.0, ball_scene(), ball_scene());
}

}  // namespace bruma::measure
