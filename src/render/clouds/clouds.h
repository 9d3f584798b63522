#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "render/clouds/cloud_march_pass.h"
#include "render/clouds/cloud_shadows.h"
#include "render/clouds/cloud_shafts_pass.h"
#include "render/view.h"

namespace bruma::render {

/// All passes of all layers of clouds in a scene. Noise and light are shared by the layers.
class Clouds {
  public:
    Clouds(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {}

    /// Hands the graph what does not depend on the view. First of each frame, since surfaces lie in these shadows.
    CloudShadows prepare(const scene::Scene& scene, const std::vector<std::string>& shown);

    /// What lies around the clouds of a picture.
    struct Surroundings {
        Handle<OpaquePicture> opaque;  ///< index -1: no surfaces
        Handle<SkyLight> sky;          ///< what the sky sends; index -1: indoors
        std::optional<AirTables> air;  ///< none indoors
    };
    /// Hands the graph the rest; returns the picture of each layer of the last `prepare`.
    std::vector<Handle<CloudPicture>> update(const scene::Scene& scene, const std::vector<std::string>& shown,
                                             Surroundings around, const View& view);
    /// What the air misses in their shadows; an empty handle indoors, and where that is not asked for.
    Handle<CloudShafts> update_shafts(const scene::Scene& scene, const std::vector<std::string>& shown,
                                      const CloudShadows& shadows, const std::optional<AirTables>& air,
                                      glm::ivec2 pixels);
    void remove();
    /// With reprojection: turns that are missing until the picture is as if all of it had been marched.
    int missing_turns() const;
    /// Whether the last picture of a layer was made from the one before it.
    bool from_last() const;
    /// The picture of each layer of the last update.
    std::vector<Handle<CloudPicture>> pictures() const;
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
    void forget_shafts();
    void keep_only(const scene::Scene& scene, const std::vector<std::string>& shown);

    FrameGraph& graph_;
    gl::ShaderLibrary& shaders_;
    std::unique_ptr<CloudSkyPass> sky_;  ///< none outdoors
    std::unique_ptr<CloudShaftsPass> shafts_;
    std::map<scene::NoisePacking, std::unique_ptr<CloudNoisePass>> noise_;
    std::map<std::string, std::unique_ptr<Layer>> layers_;
};

}  // namespace bruma::render
