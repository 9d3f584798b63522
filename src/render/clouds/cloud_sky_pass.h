#pragma once
#include "render/frame_graph.h"
#include "render/products/sky_light.h"
#include "scene/scene.h"

namespace bruma::render {

/// Unit vector to the scene's sun: the one in the sky, or indoors the first directional lamp that shines; straight up
/// where there is none.
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
