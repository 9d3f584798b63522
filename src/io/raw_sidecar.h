#pragma once
#include <filesystem>
#include <optional>

#include "scene/volume.h"

namespace bruma::io {

struct Sidecar {
    std::filesystem::path path;
    scene::VolumeSource says;                ///< parts it does not name stay empty
    std::optional<glm::dvec3> rotation_deg;  ///< that sets the volume upright, facing +z; see scene::Transform
};

/// The JSON file beside a headerless file, NAME.raw.json or NAME.json, if there is one; a scene of that name is passed
/// over. Throws InputError for broken JSON, wrong values and unknown keys, with the nearest known one.
std::optional<Sidecar> read_sidecar(const std::filesystem::path& raw_path);

}  // namespace bruma::io
