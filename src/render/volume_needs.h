#pragma once
#include <optional>
#include <set>

#include "render/volume/memory_plan.h"
#include "scene/scene.h"

namespace bruma::render {

/// What the shown volumes of a scene would take on the GPU, in the order of `shown`. `byte_format`: of the texture that
/// holds samples of 8 bits.
std::vector<VolumeNeeds> volume_needs(const scene::Scene& scene, const std::vector<std::string>& shown,
                                      GLenum byte_format);

/// Keeps what is drawn of a scene's volumes within the room there is for textures.
class VolumeFitting {
  public:
    /// Bytes that volumes may take from now on; without a call, what the driver tells to be free.
    void set_budget(std::uint64_t bytes);

    /// The scene, or what stands in for it: the same with volumes thinned out until they fit. What is not as the scene
    /// asks is said once. Throws MachineError where light volumes find no room. Valid until the next call.
    const scene::Scene& fit(const scene::Scene& scene);
    bool gradients_stored() const { return plan_.gradients_stored; }

  private:
    struct Thinned {
        Revision whole{};
        glm::ivec3 factors{1};
        Tracked<std::shared_ptr<const scene::VolumeGrid>> grid;
    };

    std::optional<std::uint64_t> budget_;
    std::optional<GLenum> byte_format_;
    std::vector<VolumeNeeds> needs_;
    MemoryPlan plan_;
    std::map<std::string, Thinned> thinned_;  ///< by node
    std::optional<scene::Scene> fitted_;
    std::set<std::string> said_;
};

}  // namespace bruma::render
