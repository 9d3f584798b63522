#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>

namespace bruma::io {

/// A published volume whose files say neither how far apart its samples are nor which side is up.
struct KnownVolume {
    std::string name;
    glm::dvec3 spacing_m{1e-3};
    glm::dvec3 rotation_deg{0.0};  ///< that sets it upright, facing +z; see scene::Transform
};

/// The entry of assets/known_volumes.json with which the file's name begins (in any case) and which has this size.
std::optional<KnownVolume> known_volume(const std::filesystem::path& path, glm::ivec3 size);

}  // namespace bruma::io
