#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "render/mesh/mesh_view.h"
#include "render/subsurface/translucent_passes.h"
#include "scene/scene.h"

namespace bruma::render {

/// Finds the texels of translucent meshes' maps that the camera's pixels look up: light is worked out for no others. It
/// draws what the opaque pass draws, on the same pixels, and marks texels in place of reading them.
class MapReadsPass {
  public:
    using Meshes = std::map<std::string, std::unique_ptr<MeshPasses>>;
    using Translucents = std::map<std::string, std::unique_ptr<TranslucentPasses>>;

    MapReadsPass(FrameGraph& graph, gl::ShaderLibrary& shaders);
    ~MapReadsPass();
    MapReadsPass(const MapReadsPass&) = delete;
    MapReadsPass& operator=(const MapReadsPass&) = delete;
    /// Hands the graph this frame's parameters; `meshes` are all shown ones.
    void update(const scene::Scene& scene, const Meshes& meshes, const Translucents& translucents, glm::ivec2 pixels);

    Handle<MapReads> reads;

  private:
    struct Body {
        std::string name;
        std::size_t mesh = 0;  ///< among the placed ones
        Handle<ExitMaps> exits;
        glm::dmat3 body_from_model{1.0};
        bool operator==(const Body&) const = default;
    };
    struct Parameters {
        glm::ivec2 pixels{0};
        int samples = 1;
        double skipped_distance = 0.0;
        std::vector<PlacedMesh> meshes;
        std::vector<Body> bodies;
        bool operator==(const Parameters&) const = default;
    };
    void draw(const PassAccess& access, const Parameters& parameters);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    Handle<scene::Camera> camera_;
    Handle<int> shader_revision_;
    PassId pass_;
    int samples_ = 0;
    gl::Texture depth_;
    gl::Framebuffer framebuffer_;
};

}  // namespace bruma::render
