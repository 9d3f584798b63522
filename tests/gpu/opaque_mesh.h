#pragma once
#include <cmath>

#include "drawing.h"
#include "scene/mesh/mesh.h"

/// Meshes and scenes that the tests of opaque surfaces share.
namespace bruma::render {

/// A quad of the given half width around the origin, in the plane z = 0, facing +z; texture coordinates run over it
/// once.
inline std::shared_ptr<scene::TriangleMesh> quad_mesh(float half_width) {
    auto mesh = std::make_shared<scene::TriangleMesh>();
    const float h = half_width;
    mesh->name = "quad";
    mesh->positions = {{-h, -h, 0.0F}, {h, -h, 0.0F}, {h, h, 0.0F}, {-h, h, 0.0F}};
    mesh->normals.assign(4, {0.0F, 0.0F, 1.0F});
    mesh->texture_coordinates = {{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}};
    mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh->triangle_materials = {0, 0};
    mesh->materials.resize(1);
    mesh->low = glm::dvec3(-h, -h, 0.0);
    mesh->high = glm::dvec3(h, h, 0.0);
    return mesh;
}

/// A sphere of radius 1 around the origin in `rings` by 2 * rings patches, with exact normals.
inline std::shared_ptr<scene::TriangleMesh> sphere_mesh(int rings) {
    auto mesh = std::make_shared<scene::TriangleMesh>();
    mesh->name = "sphere";
    const int columns = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
        for (int j = 0; j <= columns; ++j) {
            const double theta = M_PI * i / rings, phi = 2.0 * M_PI * j / columns;
            mesh->positions.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta),
                                         std::sin(theta) * std::cos(phi));
        }
    }
    mesh->normals = mesh->positions;
    const auto at = [&](int i, int j) { return std::uint32_t(i * (columns + 1) + j); };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < columns; ++j) {
            if (i > 0) {
                mesh->triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
            }
            if (i + 1 < rings) {
                mesh->triangles.emplace_back(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
    }
    mesh->triangle_materials.assign(mesh->triangles.size(), 0);
    mesh->materials.resize(1);
    mesh->low = glm::dvec3(-1.0);
    mesh->high = glm::dvec3(1.0);
    mesh->closed = true;
    return mesh;
}

/// Adds a mesh of a plain Lambert colour.
inline scene::Mesh& add_mesh(scene::Scene& scene, const std::string& name,
                             std::shared_ptr<const scene::TriangleMesh> triangles, glm::dvec3 color,
                             const scene::Transform& transform = {}) {
    scene::Mesh mesh;
    mesh.triangles = std::move(triangles);
    mesh.surface.edit([&](scene::MeshSurface& surface) {
        surface.shading = scene::MeshShading::lambert;
        surface.diffuse_color = color;
    });
    scene::Node node;
    node.transform = transform;
    node.content = std::move(mesh);
    return std::get<scene::Mesh>((scene.nodes[name] = std::move(node)).content);
}

/// Nothing yet but a camera on +z.
inline scene::Scene scene_seen_from(double distance, scene::Projection projection, double view_height) {
    scene::Camera camera;
    camera.projection = projection;
    camera.eye_world = {0.0, 0.0, distance};
    camera.view_height = view_height;
    camera.vertical_angle_deg = 2.0 * glm::degrees(std::atan(0.5 * view_height / distance));
    camera.near_distance = 1e-6 * distance;
    scene::Scene scene;
    scene.camera.emplace(camera);
    return scene;
}

constexpr scene::Projection both_projections[] = {scene::Projection::perspective, scene::Projection::orthographic};

}  // namespace bruma::render
