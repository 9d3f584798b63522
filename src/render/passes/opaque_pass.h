#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/passes/mesh_passes.h"
#include "render/sky_light.h"
#include "scene/scene.h"

namespace bruma::render {

/// The nearest surface at the centre of each pixel: one sample, so edges are not smoothed. Bottom row first.
struct OpaquePicture {
    gl::Texture radiance;  ///< linear Rec.709; alpha is 1 on a surface and 0 beside
    gl::Texture distance;  ///< along the pixel's ray, from the eye or the plane through it, in `unit_world`; 1e30: none
    gl::Texture depth;
    gl::Framebuffer framebuffer;
    double unit_world = 1.0;  ///< metres
};

/// Rasterises all shown meshes.
class OpaquePass {
  public:
    OpaquePass(FrameGraph& graph, gl::ShaderLibrary& shaders);

    using Meshes = std::map<std::string, std::unique_ptr<MeshPasses>>;
    /// Hands the graph this frame's sources and parameters; `meshes` are all shown ones. `sky`: empty indoors.
    void update(const scene::Scene& scene, const Meshes& meshes, glm::ivec2 pixels, Handle<SkyLight> sky = {});
    void remove();

    Handle<OpaquePicture> picture;

  private:
    struct MeshInput {
        std::string name;
        Handle<MeshPasses::Triangles> triangles;
        Handle<MeshBuffers> buffers;
        Handle<MeshTextures> textures;  ///< empty where none is shown
        glm::dmat4 world_from_model{1.0};
        scene::MeshSurface surface;  ///< of the matter inside nothing is kept
        bool operator==(const MeshInput&) const = default;
    };
    struct Parameters {
        glm::ivec2 pixels{0};
        double skipped_distance = 0.0;  ///< metres, before parallel rays start
        std::vector<MeshInput> meshes;
        std::vector<scene::Light> lights;
        scene::Environment environment;
        Handle<SkyLight> sky;
        bool operator==(const Parameters&) const = default;
    };
    struct Stand;  // where the meshes stand before the camera

    void draw(const PassAccess& access, const Parameters& parameters);
    static void draw_mesh(const PassAccess& access, gl::Program& program, const MeshInput& input, const Stand& stand);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<scene::Camera> camera_;
    Handle<int> shader_revision_;
    PassId pass_;
    bool said_translucent_ = false;
};

}  // namespace bruma::render
