#include "measure/stress/stress_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/error.h"
#include "measure/bench/mesh/mesh_truth.h"

namespace bruma::measure {
namespace {

double brightest_of(const Image& image) {
    double most = 0.0;
    for (std::size_t n = 0; n < image.rgba.size(); ++n) {
        if (n % 4 != 3 && image.rgba[n] < 0.0F) {
            throw std::runtime_error(fmt::format("radiance of {:.2g}", image.rgba[n]));
        }
        most = n % 4 != 3 ? std::max(most, double(image.rgba[n])) : most;
    }
    return most;
}

bool is_clear_sentence(const std::string& text) {
    return text.size() > 20 && text.size() < 600 && text.find('\n') == std::string::npos;
}

}  // namespace

void add_triangle(scene::MeshParts& parts, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto first = std::int32_t(parts.positions.size());
    parts.positions.insert(parts.positions.end(), {a, b, c});
    parts.add_face(std::array<scene::FaceCorner, 3>{{{first}, {first + 1}, {first + 2}}}, 0);
}

scene::MeshParts ball_parts(double radius, glm::dvec3 centre) {
    constexpr int rings = 10, sides = 12;
    scene::MeshParts parts;
    parts.name = parts.where = "ball";
    for (int ring = 0; ring <= rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            const double polar = std::numbers::pi * ring / rings;
            const double turn = 2.0 * std::numbers::pi * side / sides;
            // The poles exactly, so that the ball is closed.
            const double across = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
            parts.normals.emplace_back(across * std::cos(turn), std::cos(polar), -across * std::sin(turn));
            parts.positions.push_back(centre + radius * parts.normals.back());
        }
    }
    const auto corner = [&](int ring, int side) {
        const auto n = std::int32_t(ring * sides + side % sides);
        return scene::FaceCorner{n, -1, n};
    };
    for (int ring = 0; ring < rings; ++ring) {
        for (int side = 0; side < sides; ++side) {
            if (ring > 0) {
                parts.add_face(std::array<scene::FaceCorner, 3>{corner(ring, side), corner(ring + 1, side),
                                                                corner(ring, side + 1)},
                               0);
            }
            if (ring + 1 < rings) {
                parts.add_face(std::array<scene::FaceCorner, 3>{corner(ring, side + 1), corner(ring + 1, side),
                                                                corner(ring + 1, side + 1)},
                               0);
            }
        }
    }
    return parts;
}

scene::MeshParts many_pieces(int count) {
    scene::MeshParts parts;
    parts.name = parts.where = "pieces";
    const glm::dvec3 corners[] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    const glm::ivec3 faces[] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    const int edge = std::max(1, int(std::ceil(std::cbrt(double(count)))));
    const double cell = 20.0 / edge;
    for (int n = 0; n < count; ++n) {
        const glm::dvec3 at = cell * (glm::dvec3(n % edge, n / edge % edge, n / edge / edge) + 0.5) - 10.0;
        const auto first = std::int32_t(parts.positions.size());
        for (const glm::dvec3 corner : corners) {
            parts.positions.push_back(at + 0.3 * cell * corner);
        }
        for (const glm::ivec3 face : faces) {
            parts.add_face(std::array<scene::FaceCorner, 3>{{{first + face.x}, {first + face.y}, {first + face.z}}}, 0);
        }
    }
    return parts;
}

std::shared_ptr<const scene::TriangleMesh> made(const scene::MeshParts& parts, double millimetres_per_unit) {
    scene::MeshSource source;
    source.millimetres_per_unit = millimetres_per_unit;
    return scene::make_mesh(parts, source, 0.0).mesh;
}

scene::Mesh& stress_mesh(scene::Scene& scene) {
    return std::get<scene::Mesh>(scene.nodes.at("mesh").content);
}

scene::Scene mesh_scene(std::shared_ptr<const scene::TriangleMesh> triangles) {
    scene::Mesh mesh;
    mesh.source.file = "builtin:mesh-sphere";
    mesh.triangles = std::move(triangles);
    mesh.surface.edit([](scene::MeshSurface& surface) {
        surface.material = scene::Material::custom;
        surface.custom_medium = scene::medium_of(scene::Material::potato);
    });
    scene::Scene scene;
    scene.nodes["mesh"].content = std::move(mesh);
    make_body_scene(scene, "mesh");
    stress_mesh(scene).surface.edit([](scene::MeshSurface& surface) { surface.textured = true; });
    stress_mesh(scene).subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.maps = 4;
        settings.map_size = 24;
        settings.light_map_size = 64;
        settings.samples = 4;
        settings.noise = 1.0;  // both passes that are needed to know it
        settings.highlight = settings.unscattered = true;
    });
    scene.lights["sun"] = scene::Light{.direction_world = {0.3, 0.5, 0.8}};
    scene.camera = scene::fit_camera(scene::world_bounds(scene), 1.5);
    return scene;
}

scene::Scene ball_scene() {
    static const auto ball = made(ball_parts());
    return mesh_scene(ball);
}

void set_medium(scene::Scene& scene, const std::function<void(scene::SubsurfaceMedium&)>& change) {
    stress_mesh(scene).surface.edit([&](scene::MeshSurface& surface) { change(surface.custom_medium); });
}

void set_sun(scene::Scene& scene, const scene::Light& light) {
    scene.lights["sun"] = light;
}

void MeshCases::sound(const std::string& name, const std::string& what, const std::function<scene::Scene()>& make,
                      double most) {
    rig_.number(name, what + ": brightest", most, [&] {
        const scene::Scene scene = make();
        scene::check(scene);
        double brightest = 0.0;
        const auto judge = [&](const std::function<void(scene::Mesh&)>& change) {
            scene::Scene drawn = scene;
            for (auto& [node_name, node] : drawn.nodes) {
                if (auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
                    change(*mesh);
                }
            }
            brightest = std::max(brightest, brightest_of(rig_.draw(drawn)));
        };
        for (const auto shading : {scene::MeshShading::phong, scene::MeshShading::blinn_phong}) {
            judge([&](scene::Mesh& mesh) {
                mesh.surface.edit([&](scene::MeshSurface& surface) { surface.shading = shading; });
            });
        }
        for (const auto model : {scene::SubsurfaceModel::standard_dipole, scene::SubsurfaceModel::directional_dipole,
                                 scene::SubsurfaceModel::normalised_dipole}) {
            judge([&](scene::Mesh& mesh) {
                mesh.subsurface.edit([&](scene::SubsurfaceSettings& settings) { settings.model = model; });
            });
        }
        return brightest;
    });
}

void MeshCases::refused(const std::string& name, const std::string& what, const std::function<void()>& act) {
    rig_.number(name, what + ": refused", 0.0, [&] {
        try {
            act();
        } catch (const InputError& error) {
            if (!is_clear_sentence(error.what())) {
                throw std::runtime_error(fmt::format("refused, but not in one sentence: '{}'", error.what()));
            }
            return 0.0;
        }
        throw std::runtime_error("accepted");
    });
}

void MeshCases::same(const std::string& name, const std::string& what, double bound, const scene::Scene& a,
                     const scene::Scene& b, double b_over_a) {
    rig_.number(name, what, bound, [&] {
        const Image expected = rig_.draw(a);
        const double unit = brightest_of(expected);
        if (unit == 0.0) {
            throw std::runtime_error("nothing is lit");
        }
        Image found = rig_.draw(b);
        for (std::size_t n = 0; n < found.rgba.size(); ++n) {
            found.rgba[n] = n % 4 != 3 ? float(found.rgba[n] / b_over_a) : found.rgba[n];
        }
        return largest_difference(found, expected) / unit;
    });
}

std::vector<StressVerdict> run_mesh_stress(const StressOptions& options) {
    StressRig rig(options);
    MeshCases cases(rig);
    rig.group("files");
    stress_mesh_files(cases);
    rig.group("textures");
    stress_mesh_textures(cases);
    rig.group("shapes");
    stress_mesh_shapes(cases, options.pieces);
    rig.group("placement");
    stress_mesh_placement(cases);
    rig.group("matter");
    stress_mesh_matter(cases);
    rig.group("lamps");
    stress_mesh_lamps(cases);
    rig.group("invariants");
    stress_mesh_invariants(cases);
    return rig.verdicts();
}

}  // namespace bruma::measure
