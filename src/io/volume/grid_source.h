#pragma once
#include <memory>

#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// Whether a name means a volume or scene made by code, as in "builtin:bucky".
bool is_builtin(std::string_view file);
/// The part behind "builtin:".
std::string builtin_name(std::string_view file);

/// The samples of a source: a file relative to the working directory, or builtin:NAME. Remarks go to the log.
/// Throws InputError; what `progress` throws passes through.
std::shared_ptr<const scene::VolumeGrid> load_grid(const scene::VolumeSource& source, const Progress& progress);

/// Fills in every grid that is missing. A grid that `known` holds for the same source is shared and not read again.
void load_missing_grids(scene::Scene& scene, const scene::Scene* known, const Progress& progress);

}  // namespace bruma::io
