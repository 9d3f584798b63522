#pragma once
#include <memory>

#include "io/builtin_name.h"
#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// The samples of a source: a file relative to the working directory, or builtin:NAME. Remarks go to the log.
/// Throws InputError; what `progress` throws passes through.
std::shared_ptr<const scene::VolumeGrid> load_grid(const scene::VolumeSource& source, const Progress& progress);

/// Fills in every grid that is missing. A grid that `known` holds for the same source is shared and not read again.
void load_missing_grids(scene::Scene& scene, const scene::Scene* known, const Progress& progress);

}  // namespace bruma::io
