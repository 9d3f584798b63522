#include <fmt/core.h>

#include <limits>

#include "measure/stress/stress_mesh.h"

namespace bruma::measure {
namespace {

scene::Scene scene_of(const scene::MeshParts& parts, double millimetres_per_unit = 1.0) {
    return mesh_scene(made(parts, millimetres_per_unit));
}

scene::MeshParts named(scene::MeshParts parts, const std::string& name) {
    parts.name = parts.where = name;
    return parts;
}

/// The triangles of one behind those of the other, or turned round.
void append(scene::MeshParts& to, const scene::MeshParts& from, bool turned) {
    const auto first = std::int32_t(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (const auto& corners : from.triangles) {
        std::array<scene::FaceCorner, 3> face{{{first + corners[0].position},
                                               {first + corners[turned ? 2 : 1].position},
                                               {first + corners[turned ? 1 : 2].position}}};
        to.add_face(face, 0);
    }
}

}  // namespace

void stress_mesh_shapes(MeshCases& cases, int pieces) {
    const auto triangle = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        scene::MeshParts parts = named({}, "triangle");
        add_triangle(parts, a, b, c);
        return scene_of(parts);
    };
    cases.sound("triangle", "one triangle", [&] { return triangle({0, 0, 0}, {10, 0, 0}, {0, 10, 3}); });
    for (const double height : {1e-3, 1e-6}) {
        cases.sound(fmt::format("needle-{:g}", height), "a triangle so much thinner than long", [&] {
            return triangle({0, 0, 0}, {10, 0, 0}, {5, 10 * height, 0});
        });
    }
    cases.refused("empty", "no triangle at all", [] { scene_of(named({}, "nothing")); });
    cases.refused("no-area", "triangles without area alone", [] {
        scene::MeshParts parts = named({}, "line");
        add_triangle(parts, {0, 0, 0}, {1, 1, 1}, {3, 3, 3});
        add_triangle(parts, {2, 2, 2}, {2, 2, 2}, {2, 2, 2});
        scene_of(parts);
    });
    cases.sound("two-sided", "a triangle and the same turned round", [] {
        scene::MeshParts parts = named({}, "leaf");
        add_triangle(parts, {0, 0, 0}, {10, 0, 0}, {0, 10, 0});
        add_triangle(parts, {0, 0, 0}, {0, 10, 0}, {10, 0, 0});
        return scene_of(parts);
    });
    cases.sound("coincident", "a ball twice in the same place", [] {
        scene::MeshParts parts = ball_parts();
        append(parts, ball_parts(), false);
        return scene_of(parts);
    });
    cases.sound("coincident-turned", "a ball and the same inside out", [] {
        scene::MeshParts parts = ball_parts();
        append(parts, ball_parts(), true);
        return scene_of(parts);
    });
    cases.sound("coincident-nodes", "two meshes in the same place", [] {
        scene::Scene scene = ball_scene();
        scene.nodes["twin"] = scene.nodes.at("mesh");
        return scene;
    });
    cases.sound("hollow", "a ball with a hollow", [] {
        scene::MeshParts parts = ball_parts();
        append(parts, ball_parts(7.0), true);
        return scene_of(parts);
    });
    cases.sound("skin", "a hollow ball whose wall is a ten-thousandth of it", [] {
        scene::MeshParts parts = ball_parts();
        append(parts, ball_parts(10.0 - 1e-3), true);
        return scene_of(parts);
    });
    cases.sound("crossing", "balls that run into each other", [] {
        scene::MeshParts parts = ball_parts();
        append(parts, ball_parts(10.0, {7, 0, 0}), false);
        append(parts, ball_parts(6.0, {0, 9, 2}), true);
        return scene_of(parts);
    });
    for (const double thickness : {1e-3, 1e-6}) {
        cases.sound(fmt::format("flat-{:g}", thickness), "a ball pressed so flat", [thickness] {
            scene::MeshParts parts = ball_parts();
            for (std::size_t n = 0; n < parts.positions.size(); ++n) {
                parts.positions[n].z *= thickness;
            }
            parts.normals.clear();
            for (auto& corners : parts.triangles) {
                for (scene::FaceCorner& corner : corners) {
                    corner.normal = -1;
                }
            }
            return scene_of(parts);
        });
    }
    for (const double metres : {1e-6, 1e-3, 1e3, 1e6}) {
        cases.sound(fmt::format("across-{:g}m", metres), "a ball so large",
                    [metres] { return scene_of(ball_parts(), 1e3 * metres / 20.0); });
    }
    for (const double far : {1e2, 1e4, 1e5, 1e9}) {
        cases.sound(fmt::format("off-{:g}", far), "a ball so many radii away from its origin",
                    [far] { return scene_of(ball_parts(10.0, glm::dvec3(10.0 * far, 0.0, 0.0))); });
    }
    cases.refused("off-1e18", "so far from its origin that doubles put all corners in one place",
                  [] { scene_of(ball_parts(10.0, glm::dvec3(1e19, 1e19, 1e19))); });
    cases.refused("too-large", "a unit that takes coordinates out of single precision",
                  [] { scene_of(ball_parts(), 1e42); });
    cases.sound("normals-turned", "normals of the file that point anywhere", [] {
        scene::MeshParts parts = ball_parts();
        for (std::size_t n = 0; n < parts.normals.size(); ++n) {
            parts.normals[n] = glm::dvec3(stress_noise(n, 1), stress_noise(n, 2), stress_noise(n, 3)) - 0.5;
        }
        return scene_of(parts);
    });
    cases.sound(fmt::format("pieces-{}", pieces), "so many pieces that do not touch",
                [pieces] { return scene_of(many_pieces(pieces)); });
}

void stress_mesh_placement(MeshCases& cases) {
    const auto placed = [](const scene::Transform& transform) {
        scene::Scene scene = ball_scene();
        scene.nodes.at("mesh").transform = transform;
        look_at_all(scene);
        return scene;
    };
    for (const double scale : {1e-9, 1e-6, 1e6, 1e9}) {
        cases.sound(fmt::format("scale-{:g}", scale), "drawn to another size",
                    [&] { return placed({.scale = glm::dvec3(scale)}); });
    }
    cases.sound("mirrored", "mirrored in x", [&] { return placed({.scale = {-1.0, 1.0, 1.0}}); });
    cases.sound("mirrored-thrice", "mirrored in all axes", [&] { return placed({.scale = glm::dvec3(-1.0)}); });
    for (const double thin : {1e-3, 1e-6, 1e-9}) {
        cases.sound(fmt::format("pressed-{:g}", thin), "one axis so much shorter", [&] {
            return placed({.rotation_deg = {20.0, 30.0, 0.0}, .scale = {1.0, thin, 1.0}});
        });
    }
    cases.sound("sheared", "turned inside a parent of unequal scale", [&] {
        scene::Scene scene = placed({.rotation_deg = {-40.0, 15.0, 70.0}});
        scene.nodes["parent"] = {
            .parent = {},
            .transform = scene::Transform{.rotation_deg = {20.0, 50.0, -35.0}, .scale = {1.0, 30.0, 0.1}},
            .content = scene::Group{}};
        scene.nodes.at("mesh").parent = "parent";
        look_at_all(scene);
        return scene;
    });
    cases.sound("sheared-flat", "turned inside a parent that presses it to a millionth", [&] {
        scene::Scene scene = placed({.rotation_deg = {0.0, 45.0, 45.0}, .scale = {1.0, 1e-6, 1.0}});
        scene.nodes["parent"] = {
            .parent = {}, .transform = scene::Transform{.scale = {1.0, 1.0, 1e-6}}, .content = scene::Group{}};
        scene.nodes.at("mesh").parent = "parent";
        look_at_all(scene);
        return scene;
    });
    cases.sound("far-away", "1000 km from the origin of the world", [&] {
        return placed({.translation = {1e6, -1e6, 1e6}});
    });
    const auto refused = [&](const std::string& name, const scene::Transform& transform) {
        cases.refused(name, "a transform that cannot be undone", [&] {
            scene::Scene scene = ball_scene();
            scene.nodes.at("mesh").transform = transform;
            scene::check(scene);
        });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    refused("scale-0", {.scale = {1.0, 0.0, 1.0}});
    refused("scale-nan", {.scale = {1.0, nan, 1.0}});
    refused("scale-inf", {.scale = {infinity, 1.0, 1.0}});
    refused("rotation-nan", {.rotation_deg = {nan, 0.0, 0.0}});
    refused("translation-inf", {.translation = {0.0, -infinity, 0.0}});
    cases.refused("parents-0", "parents whose scales come to nothing together", [&] {
        scene::Scene scene = placed({.scale = glm::dvec3(1e-100)});
        scene.nodes["parent"] = {
            .parent = {}, .transform = scene::Transform{.scale = glm::dvec3(1e-100)}, .content = scene::Group{}};
        scene.nodes.at("mesh").parent = "parent";
        scene::check(scene);
    });
    cases.refused("parents-inf", "parents whose scales come to infinity together", [&] {
        scene::Scene scene = placed({.scale = glm::dvec3(1e90)});
        scene.nodes["parent"] = {
            .parent = {}, .transform = scene::Transform{.scale = glm::dvec3(1e90)}, .content = scene::Group{}};
        scene.nodes.at("mesh").parent = "parent";
        scene::check(scene);
    });
}

}  // namespace bruma::measure
