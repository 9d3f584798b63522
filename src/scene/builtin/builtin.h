#pragma once
#include <memory>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bruma::scene {

/// Names of the volumes made by code, without the 'builtin:' in front.
std::vector<std::string> builtin_volume_names();
/// A volume made by code; throws InputError, with the nearest known name, for an unknown one.
/// Always the same samples, on every machine.
std::shared_ptr<const VolumeGrid> builtin_volume(const std::string& name);

/// Names of whole scenes made by code, without the 'builtin:' in front.
std::vector<std::string> builtin_scene_names();
/// A whole scene with its grids in place.
Scene builtin_scene(const std::string& name);

/// The transfer function that shows a volume well when its user has not chosen one yet; for builtin volumes hand-made,
/// for others from the histogram.
TransferFunction suggested_transfer_function(const VolumeGrid& grid);

}  // namespace bruma::scene
