#pragma once
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/volume.h"

namespace bruma::io {

/// A published volume whose files say neither how far apart its samples are nor which side is up.
struct KnownVolume {
    std::string name;
    std::vector<std::string> also;  ///< other names it goes by
    glm::ivec3 size{0};
    scene::VoxelType type = scene::VoxelType::uint8;
    glm::dvec3 spacing_m{1e-3};
    std::optional<glm::dvec3>
        rotation_deg;  ///< that sets it upright, facing +z, where it is known; see scene::Transform
    std::string from;  ///< the collection that publishes it
};

/// All of assets/known_volumes.json. Throws InputError when the list is broken.
std::vector<KnownVolume> known_volumes();

/// The volume of the list that a file holds, if its name begins with one of the volume's names and its size is the
/// volume's. Names are compared word by word, in any case, whatever stands between words ('BostonTeapot',
/// 'boston_teapot_copy', but not 'football' for 'foot'); of several the longest counts. Where nobody said the size, the
/// file must be as long as the volume: `bytes` of samples of the published type; `type`, where said, must be that one.
std::optional<KnownVolume> known_volume(const std::filesystem::path& path, const std::optional<glm::ivec3>& size,
                                        const std::optional<scene::VoxelType>& type, std::int64_t bytes);

}  // namespace bruma::io
