#pragma once
#include "gl/shader_library.h"
#include "gl/texture.h"
#include "render/frame_graph.h"
#include "scene/clouds/cloud_layer.h"

namespace bruma::render {

/// Noise that clouds are made of, in 16 bits: filtering in 8 would be seen as steps where the coverage is small.
struct CloudNoise {
    gl::Texture shape;     ///< 128^3; four channels, or one when packed
    gl::Texture detail;    ///< 32^3; its octaves summed, which is the same field
    gl::Texture coverage;  ///< effective coverage over the cloudy share of space, 1025 entries; made when asked for
};

/// Makes the noise once; nothing but its packing changes it.
class CloudNoisePass {
  public:
    CloudNoisePass(FrameGraph& graph, gl::ShaderLibrary& shaders, scene::NoisePacking packing);
    void update(bool with_coverage_table);
    void remove();

    Handle<CloudNoise> noise;

  private:
    void make(const PassAccess& access, bool with_coverage_table);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    scene::NoisePacking packing_;
    Handle<int> shader_revision_;
    Revision made_with_ = 0;  ///< of the shaders
    PassId pass_;
};

}  // namespace bruma::render
