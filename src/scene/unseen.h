#pragma once
#include <string>

#include "scene/scene.h"

namespace bruma::scene {

/// One sentence about a picture in which no shown node covers a pixel: the likeliest cause, as far as nodes and camera
/// tell, and the next step. `pixels`: of the picture. Empty where nothing is missed: in a scene without volumes, meshes
/// and clouds. The scene must have passed `check`, with its grids and triangles; without a camera it has no sentence.
std::string why_nothing_is_seen(const Scene& scene, glm::ivec2 pixels);

}  // namespace bruma::scene
