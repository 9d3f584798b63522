#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "render/frame_graph.h"
#include "scene/mesh/mesh.h"

namespace bruma::render {

/// A mesh's triangles on the GPU, sorted by material.
struct MeshBuffers {
    struct Part {
        std::size_t material = 0;          ///< index into the mesh's materials
        std::size_t first = 0, count = 0;  ///< in the index buffer
    };
    gl::Buffer vertices, indices, colors;  ///< `colors`: empty where the mesh has none
    gl::VertexArray array;
    glm::dvec3 middle_model{0.0};  ///< what the positions are relative to: floats are finest around 0
    std::vector<Part> parts;
};

/// Draws all triangles, whatever their material.
void draw_all(const MeshBuffers& buffers);

/// The pictures laid over a mesh, each once.
struct MeshTextures {
    std::map<const scene::MeshTexture*, gl::Texture> of;
};

/// The view-independent passes of one mesh. They rerun only when its triangles change; a texture that is not shown is
/// never uploaded.
class MeshPasses {
  public:
    using Triangles = std::shared_ptr<const scene::TriangleMesh>;

    MeshPasses(FrameGraph& graph, const std::string& node_name);
    /// Hands the graph this frame's source.
    void update(const scene::Mesh& mesh);
    void remove();

    Handle<Triangles> triangles;
    Handle<MeshBuffers> buffers;
    Handle<MeshTextures> textures;

  private:
    FrameGraph& graph_;
    PassId upload_, upload_textures_;
};

}  // namespace bruma::render
