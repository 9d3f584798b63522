#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

namespace bruma::io {

/// Changes one value of a scene's document (see scene_json.h), as `--set PATH=VALUE` does:
///
///     nodes.bonsai.lighting=gradient               words need no quotes
///     camera.eye=[0, 0.1, 0.5]                     any JSON
///     nodes.bonsai.transfer_function.opacity.1.0=0.3   parts of arrays by index, from 0
///     volume.density_scale=2, mesh.material=cream, light.intensity=1    a kind's name addresses all nodes, or lights,
///     of that kind
///
/// The value is not judged here: read the document with `from_json` afterwards. Throws InputError for a setting without
/// '=' or '.', and for a part of the path that does not exist, with the nearest one that does.
void apply_setting(nlohmann::json& scene_document, std::string_view path_equals_value);

}  // namespace bruma::io
