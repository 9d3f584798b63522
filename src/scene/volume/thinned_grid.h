#pragma once
#include <memory>

#include "scene/volume/volume_grid.h"

namespace bruma::scene {

/// The same box with fewer samples: about 1 / `factors` along each axis, each the mean of the present samples that it
/// stands for, absent where most of these are. Ranges and windows stay those of the whole data.
std::shared_ptr<const VolumeGrid> thinned(const VolumeGrid& grid, glm::ivec3 factors);

/// Samples of a thinned grid.
glm::ivec3 thinned_size(glm::ivec3 size, glm::ivec3 factors);

}  // namespace bruma::scene
