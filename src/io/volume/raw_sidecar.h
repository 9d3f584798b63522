#pragma once
#include <filesystem>
#include <optional>

#include "scene/volume/volume.h"

namespace bruma::io {

struct Sidecar {
    std::filesystem::path path;
    scene::VolumeSource says;                ///< parts it does not name stay empty
    std::optional<glm::dvec3> rotation_deg;  ///< that sets the volume upright, facing +z; see scene::Transform
};

/// The JSON file beside a headerless file, NAME.raw.json or NAME.json, if there is one. Scenes and transfer functions
/// of that name are passed over; so is what another program left there (no JSON, no object, mostly unknown keys), which
/// is said once in the log. Throws InputError for what was meant as a sidecar: broken JSON or an object with our keys,
/// wrong values, and keys that are nearly ours, with the nearest known one.
std::optional<Sidecar> read_sidecar(const std::filesystem::path& raw_path);

}  // namespace bruma::io
