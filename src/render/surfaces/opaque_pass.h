#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/clouds/cloud_shadows.h"
#include "render/light/shadow_pass.h"
#include "render/mesh/mesh_view.h"
#include "render/products/opaque_picture.h"
#include "render/products/sky_light.h"
#include "render/subsurface/translucent_passes.h"
#include "scene/scene.h"

namespace bruma::render {

/// Rasterises all shown meshes.
class OpaquePass {
  public:
    OpaquePass(FrameGraph& graph, gl::ShaderLibrary& shaders);

    using Meshes = std::map<std::string, std::unique_ptr<MeshPasses>>;
    using Translucents = std::map<std::string, std::unique_ptr<TranslucentPasses>>;
    /// Hands the graph this frame's sources and parameters; `meshes` are all shown ones, `translucents` what is inside
    /// those that light enters; `shadows`: empty where nothing casts any; `sky`: empty indoors; `clouds`: before the
    /// sun.
    void update(const scene::Scene& scene, const Meshes& meshes, const Translucents& translucents,
                Handle<ShadowMaps> shadows, glm::ivec2 pixels, Handle<SkyLight> sky = {},
                const CloudShadows& clouds = {});
    void remove();

    Handle<OpaquePicture> picture;

  private:
    /// What is inside a translucent mesh; null: it is opaque. Two are equal as long as both are or neither is, since
    /// what lies behind is told by the revisions of the products that they name.
    struct Inside {
        std::shared_ptr<const TranslucentPasses::Shown> shown;
        bool operator==(const Inside& other) const { return (shown == nullptr) == (other.shown == nullptr); }
    };
    struct MeshInput {
        std::string name;
        PlacedMesh placed;
        Handle<MeshTextures> textures;  ///< empty where none is shown
        scene::MeshSurface surface;     ///< of the matter inside nothing is kept
        int highlight = 0;              ///< as mesh.frag counts them
        bool colored = false;           ///< by colours at its corners
        Inside inside;
        bool operator==(const MeshInput&) const = default;
    };
    struct Parameters {
        glm::ivec2 pixels{0};
        int samples = 1;
        double skipped_distance = 0.0;  ///< metres, before parallel rays start
        std::vector<MeshInput> meshes;
        std::vector<scene::Light> lights;
        scene::Environment environment;
        Handle<ShadowMaps> shadows;
        Handle<SkyLight> sky;
        CloudShadows clouds;
        bool operator==(const Parameters&) const = default;
    };
    void draw(const PassAccess& access, const Parameters& parameters);
    static void draw_mesh(const PassAccess& access, gl::Program& program, const MeshInput& input, const MeshView& view,
                          Handle<ShadowMaps> shadows);
    static gl::Defines defines_of(const Parameters& parameters);
    /// How many pixels no map saw.
    std::uint32_t draw_translucent(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                                   const MeshInput& input);
    /// Whether light from behind comes through a body; then `thickness` is drawn.
    bool draw_thickness(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                        const MeshInput& input);
    /// Textures and constants of what is inside; the buffer must live until the mesh is drawn.
    static void set_inside(const PassAccess& access, gl::Program& program, const MeshInput& input, gl::Buffer& lamps);
    gl::Program& prepared_program(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                                  const gl::Defines& defines);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<scene::Camera> camera_;
    Handle<int> shader_revision_;
    PassId pass_;
};

}  // namespace bruma::render
