#pragma once
#include <GL/glew.h>

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

namespace bruma::render {

/// What a shown volume would take on the GPU if everything fitted.
struct VolumeNeeds {
    std::string name;               ///< of its node
    glm::ivec3 samples{0};          ///< along x, y, z
    GLenum voxel_format = 0;        ///< of the texture that holds its samples
    GLenum gradient_format = 0;     ///< of the texture that holds its gradients; 0: needs none
    std::uint64_t light_bytes = 0;  ///< of its light volumes, all lamps and working memory together
    bool operator==(const VolumeNeeds&) const = default;
};

/// What there is.
struct TextureBudget {
    std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
    int longest_edge = std::numeric_limits<int>::max();
    /// Whether the driver takes a 3-D texture of this format and size; empty: any.
    std::function<bool(GLenum, glm::ivec3)> takes = {};
};

/// How volumes are kept so that they fit.
struct MemoryPlan {
    /// Factor by which each volume, in the order of the needs, is thinned out along each axis.
    std::vector<glm::ivec3> thinning;
    bool gradients_stored = true;      ///< else they are worked out from the samples wherever they are needed
    std::uint64_t bytes = 0;           ///< of all that is kept
    std::vector<std::string> remarks;  ///< a sentence for each thing that is not as it would be with more room
};

/// Bytes of a 3-D texture.
std::uint64_t texture_bytes(GLenum format, glm::ivec3 size);

/// Stored gradients go first, which costs time alone, and then samples. Light volumes were chosen by the user: where
/// they do not fit beside what is left, throws MachineError with the estimate and a way out.
MemoryPlan plan_memory(const std::vector<VolumeNeeds>& volumes, const TextureBudget& budget);

}  // namespace bruma::render
