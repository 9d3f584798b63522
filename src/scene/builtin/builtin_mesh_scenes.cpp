#include "scene/builtin/builtin_mesh_scenes.h"

#include "scene/builtin/mesh_builtin.h"

namespace bruma::scene {
namespace {

Node builtin_mesh_node(const std::string& name, const Transform& transform, const MeshSurface& surface) {
    Mesh mesh;
    mesh.source.file = "builtin:" + name;
    mesh.triangles = builtin_mesh(name, mesh.source).mesh;
    mesh.surface = surface;
    return {.parent = {}, .visible = true, .transform = transform, .content = std::move(mesh)};
}

MeshSurface made_of(Material material) {
    MeshSurface surface;
    surface.shading = MeshShading::translucent;
    surface.material = material;
    return surface;
}

Transform at(glm::dvec3 translation, glm::dvec3 rotation_deg, double scale) {
    return {.translation = translation, .rotation_deg = rotation_deg, .scale = glm::dvec3(scale)};
}

}  // namespace

Scene translucent_scene() {
    Scene scene;
    scene.nodes["pot"] =
        builtin_mesh_node("pot", at({-0.045, -0.020, -0.006}, {8.0, -30.0, 0.0}, 0.36), made_of(Material::marble));
    scene.nodes["knot"] =
        builtin_mesh_node("mesh-knot", at({0.0, 0.0, 0.0}, {-20.0, 15.0, 0.0}, 0.72), made_of(Material::skin1));
    scene.nodes["ball"] =
        builtin_mesh_node("mesh-sphere", at({-0.012, -0.024, 0.032}, glm::dvec3(0.0), 0.7), made_of(Material::potato));
    scene.nodes["cup"] =
        builtin_mesh_node("pot", at({0.047, -0.020, -0.006}, {8.0, -35.0, 0.0}, 0.36), made_of(Material::cream));
    MeshSurface clay;
    clay.diffuse_color = {0.62, 0.30, 0.20};
    clay.specular = 0.35;
    clay.shininess = 40.0;
    scene.nodes["clay"] = builtin_mesh_node("mesh-knot", at({0.024, -0.020, 0.030}, {-30.0, -25.0, 20.0}, 0.34), clay);
    scene.lights["key"] = Light{.direction_world = {-0.55, 0.8, 0.55}, .color = {1.0, 0.9, 0.76}, .intensity = 2.2};
    scene.lights["rim"] = Light{.direction_world = {0.45, 0.35, -0.8}, .color = {1.0, 0.93, 0.85}, .intensity = 7.0};
    scene.environment = Environment{.radiance = {0.030, 0.032, 0.036}};
    scene.background = Background{.top = {0.004, 0.005, 0.008}, .bottom = {0.030, 0.034, 0.044}};
    Camera camera;
    camera.eye_world = {0.0, 0.050, 0.240};
    camera.target_world = {0.001, -0.006, 0.0};
    camera.vertical_angle_deg = 22.0;
    scene.camera = camera;
    return scene;
}

}  // namespace bruma::scene
