#pragma once
#include <string>

#include "render/volume/majorants.h"
#include "render/volume/scattering_tables.h"
#include "render/volume/volume_passes.h"

namespace bruma::render {

/// Scattering tables on the GPU.
struct ScatteringTextures {
    gl::Texture optics, glow;
};
struct BoundsTexture {
    gl::Texture bounds;
    glm::vec3 cells_from_texture{1.0F};  ///< macrocells along each axis, fractional
};

/// What path tracing needs of one volume beside its voxels, made by view-independent passes.
class PathVolumePasses {
  public:
    /// `volume` must outlive this.
    PathVolumePasses(FrameGraph& graph, const std::string& node_name, const VolumePasses& volume);
    void update(const scene::Volume& volume);
    void remove();

    Handle<ScatteringTextures> tables;
    Handle<BoundsTexture> bounds;

  private:
    FrameGraph& graph_;
    Handle<scene::TransferFunction> transfer_function_;
    Handle<CellRanges> ranges_;
    Handle<VolumeTexture> voxels_;
    PassId tabulate_, bound_;
};

}  // namespace bruma::render
