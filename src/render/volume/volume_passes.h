#pragma once
#include <memory>

#include "render/frame_graph.h"
#include "render/volume/macrocells.h"
#include "render/volume/transfer_tables.h"
#include "render/volume/volume_texture.h"
#include "scene/scene.h"

namespace bruma::render {

/// Transfer tables on the GPU, with the CPU's copy.
struct TableTextures {
    TransferTables tables;
    gl::Texture optics, depth, source, glow;
};
struct EmptinessTexture {
    gl::Texture distance;
    int edge = 4;
    glm::ivec3 voxels{1};
    double occupied_share = 1.0;
};

/// The view-independent passes of one volume and their products. Their revisions come from the scene, so each reruns
/// only for its own cause: new data, an edited transfer function, lighting switched on.
class VolumePasses {
  public:
    VolumePasses(FrameGraph& graph, const std::string& node_name);
    /// Hands the graph this frame's sources and parameters. `step_world`: length of a segment in metres.
    void update(const scene::Volume& volume, const scene::RenderSettings& settings, double step_world);
    void remove();

    Handle<VolumeTexture> voxels;
    Handle<GradientTexture> gradients;
    Handle<TableTextures> tables;
    Handle<EmptinessTexture> emptiness;
    Handle<scene::TransferFunction> transfer_function;
    Handle<CellRanges> cell_ranges() const { return ranges_; }

  private:
    FrameGraph& graph_;
    Handle<std::shared_ptr<const scene::VolumeGrid>> grid_;
    Handle<CellRanges> ranges_;
    PassId upload_, differentiate_, range_, tabulate_, find_empty_;
};

}  // namespace bruma::render
