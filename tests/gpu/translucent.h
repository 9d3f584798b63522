#pragma once
#include <string>

#include "opaque_mesh.h"
#include "scene/builtin/mesh_builtin.h"

/// Scenes of translucent bodies that several tests share.
namespace bruma::render {

inline std::shared_ptr<const scene::TriangleMesh> builtin_triangles(const std::string& name, double mm_per_unit = 1.0) {
    scene::MeshSource source;
    source.file = "builtin:" + name;
    source.millimetres_per_unit = mm_per_unit;
    return scene::builtin_mesh(name, source).mesh;
}

/// Adds a mesh that shows nothing but the light from inside.
inline scene::Mesh& add_translucent(scene::Scene& scene, const std::string& name,
                                    std::shared_ptr<const scene::TriangleMesh> triangles,
                                    const scene::SubsurfaceMedium& medium) {
    scene::Mesh& mesh = add_mesh(scene, name, std::move(triangles), glm::dvec3(1.0));
    mesh.surface.edit([&](scene::MeshSurface& surface) {
        surface.shading = scene::MeshShading::translucent;
        surface.material = scene::Material::custom;
        surface.custom_medium = medium;
    });
    // The reference looks through the middle of each pixel.
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.samples = 1; });
    mesh.subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.model = scene::SubsurfaceModel::directional_dipole;
        settings.highlight = false;
        settings.noise = 0.0;  // exactly the passes that are asked for
        settings.maps = 8;
        settings.map_size = 64;
        settings.light_map_size = 512;
        settings.samples = 16;
    });
    return mesh;
}

/// A camera outside the box around everything, parallel rays, looking against `back`.
inline scene::Camera parallel_camera_around(const scene::Scene& scene, glm::dvec3 back) {
    scene::Camera camera = scene::fit_camera(scene::world_bounds(scene), 1.0, back);
    camera.projection = scene::Projection::orthographic;
    return camera;
}

inline View view_of(glm::ivec2 pixels, int passes) {
    View view{pixels, 1.0};
    view.paths.samples = passes;
    return view;
}

}  // namespace bruma::render
