#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/map_camera.h"
#include "render/mesh/mesh_passes.h"
#include "scene/scene.h"

namespace bruma::render {

/// What each lamp sees of all meshes.
struct ShadowMaps {
    gl::Texture depth;  ///< depth array; several layers for a lamp that sees all around it
    gl::Buffer lamps;   ///< for light/shadow.glsl, in the order of the lights
    glm::dvec3 center_world{0.0};
    double unit_world = 1.0;  ///< metres
    /// Shadow space from a mesh's corners, which count from the middle of its
    /// box.
    glm::dmat4 shadow_from_model(const glm::dmat4& world_from_model, glm::dvec3 middle_model) const;
};

/// Draws the shadow maps. They depend on the camera in nothing: a headlight's
/// shadows are behind what casts them, so it has none.
class ShadowPass {
  public:
    ShadowPass(FrameGraph& graph, gl::ShaderLibrary& shaders);

    using Meshes = std::map<std::string, std::unique_ptr<MeshPasses>>;
    /// Hands the graph this frame's parameters; `lights`: those that shine, in
    /// the shader's order.
    void update(const scene::Scene& scene, const Meshes& meshes, const std::vector<scene::Light>& lights);
    void remove();

    Handle<ShadowMaps> maps;

  private:
    struct Caster {
        Handle<MeshPasses::Triangles> triangles;
        Handle<MeshBuffers> buffers;
        glm::dmat4 world_from_model{1.0};
        bool operator==(const Caster&) const = default;
    };
    struct Parameters {
        std::vector<Caster> casters;
        std::vector<scene::Light> lamps;  ///< without colour and strength
        int size = 0;
        bool operator==(const Parameters&) const = default;
    };
    void draw(const PassAccess& access, const Parameters& parameters);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<int> shader_revision_;
    PassId pass_;
};

}  // namespace bruma::render
