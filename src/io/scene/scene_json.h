#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bruma::io {

/// A scene as a document: every field of every part under its name in the table of parameters (scene/field.h).
///
///     { "bruma_scene": 1, "camera": {...}, "sky": {...}, "sun": {...}, "atmosphere": {...}, "background": {...},
///       "rendering": {...}, "display": {...}, "time": {...},
///       "lights": { NAME: {...} },
///       "nodes": { NAME: { "kind": "volume" or "group", "parent": NAME or "", "visible": true, "transform": {...},
///                          "source": {...}, "transfer_function": {...} or a preset's name, "clip": {...},
///                          and the fields of VolumeOptics },
///                  NAME: { "kind": "mesh", ..., "source": {...}, and the fields of MeshSurface },
///                  NAME: { "kind": "clouds", ..., "preset": NAME to start from, "optics": {...}, "weather": {...},
///                          "march": {...}, and the fields of CloudLayer } } }
///
/// Grids and triangles are not part of it; `camera` is left out until someone has chosen it, and `sky`, `sun` and
/// `atmosphere` indoors.
nlohmann::json to_json(const scene::Scene& scene);

/// The reverse. Missing keys keep their defaults; grids and triangles stay null; what comes back has passed
/// scene::check. `where` is the file's name (or empty) and opens every message; presets are looked up in
/// `preset_folders`. Throws InputError for everything that is wrong, and nothing else.
scene::Scene from_json(const nlohmann::json& document, const std::string& where,
                       const std::vector<std::filesystem::path>& preset_folders = {});

}  // namespace bruma::io
