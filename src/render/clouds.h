#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/passes/cloud_march_pass.h"

namespace bruma::render {

/// All passes of all layers of clouds in a scene. Noise and light are shared by the layers.
class Clouds {
  public:
    Clouds(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {}

    /// Hands the graph this frame's sources and parameters; returns the picture of each shown layer. `sky`: what the
    /// sky sends; empty indoors.
    std::vector<Handle<CloudPicture>> update(const scene::Scene& scene, const std::vector<std::string>& shown,
                                             Handle<OpaquePicture> opaque, Handle<SkyLight> sky, glm::ivec2 pixels,
                                             double step_scale);
    void remove();
    /// With reprojection: turns that are missing until the picture is as if all of it had been marched.
    int missing_turns() const;
    /// The counting march of each layer of the last update.
    std::vector<Handle<CloudCounts>> counts() const;

  private:
    struct Layer {
        Layer(FrameGraph& graph, gl::ShaderLibrary& shaders, const std::string& name)
            : passes(graph, shaders, name), march(graph, shaders, name) {}
        CloudPasses passes;
        CloudMarchPass march;
    };
    void forget_own_sky();
    void keep_only(const scene::Scene& scene, const std::vector<std::string>& shown);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    std::unique_ptr<CloudSkyPass> sky_;  ///< none outdoors
    std::map<scene::NoisePacking, std::unique_ptr<CloudNoisePass>> noise_;
    std::map<std::string, std::unique_ptr<Layer>> layers_;
};

}  // namespace bruma::render
