#include "measure/bench/mesh/mesh_truth.h"

namespace bruma::measure {

reference::TriangleMesh reference_mesh(const scene::Scene& scene, const std::string& node_name) {
    const scene::TriangleMesh& mesh = **std::get<scene::Mesh>(scene.nodes.at(node_name).content).triangles;
    const glm::dmat4 world_from_model = scene::world_from_model(scene, node_name);
    const glm::dmat3 normals = glm::transpose(glm::inverse(glm::dmat3(world_from_model)));
    const bool mirrored = glm::determinant(glm::dmat3(world_from_model)) < 0.0;
    reference::TriangleMesh world;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        world.positions.emplace_back(world_from_model * glm::dvec4(mesh.positions[n], 1.0));
        world.normals.push_back(glm::normalize(normals * glm::dvec3(mesh.normals[n])));
    }
    for (const glm::uvec3& t : mesh.triangles) {
        world.triangles.push_back(mirrored ? glm::uvec3(t.x, t.z, t.y) : t);
    }
    return world;
}

reference::SubsurfaceMedium reference_medium(const scene::SubsurfaceMedium& medium) {
    return {medium.absorption, medium.scattering(), medium.asymmetry, medium.refraction_index};
}

reference::SubsurfaceModel reference_model(scene::SubsurfaceModel model) {
    switch (model) {
        case scene::SubsurfaceModel::standard_dipole:
            return reference::SubsurfaceModel::standard_dipole;
        case scene::SubsurfaceModel::directional_dipole:
            return reference::SubsurfaceModel::directional_dipole;
        case scene::SubsurfaceModel::normalised_dipole:
            break;
    }
    return reference::SubsurfaceModel::normalised_directional_dipole;
}

void make_body_scene(scene::Scene& scene, const std::string& node_name) {
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    scene.environment = scene::Environment{.radiance = glm::dvec3(0.0)};
    auto& mesh = std::get<scene::Mesh>(scene.nodes.at(node_name).content);
    mesh.surface.edit([](scene::MeshSurface& surface) {
        surface.shading = scene::MeshShading::translucent;
        surface.textured = false;
    });
    mesh.subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.highlight = settings.unscattered = false;
        settings.noise = 0.0;
    });
}

}  // namespace bruma::measure
