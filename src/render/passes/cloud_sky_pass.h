#pragma once
#include "gl/buffer.h"
#include "render/frame_graph.h"
#include "scene/scene.h"

namespace bruma::render {

/// What sun and sky send, as include/sky_light.glsl reads it.
struct SkyLight {
    static constexpr GLuint binding = 7;
    gl::Buffer buffer;
};

/// Unit vector to the scene's sun: its first directional lamp that shines; straight up where there is none.
glm::dvec3 sun_direction_world(const scene::Scene& scene);

/// Fills it without a sky: from the first directional lamp and the constant environment, over a grey ground.
class CloudSkyPass {
  public:
    explicit CloudSkyPass(FrameGraph& graph);
    void update(const scene::Scene& scene);
    void remove() { graph_.remove_pass(pass_); }

    Handle<SkyLight> light;

  private:
    FrameGraph& graph_;
    PassId pass_;
};

}  // namespace bruma::render
