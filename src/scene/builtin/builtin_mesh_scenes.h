#pragma once
#include "scene/scene.h"

namespace bruma::scene {

/// Things of marble, cream, skin and potato, lit from the front and from
/// behind, beside one of glazed clay.
Scene translucent_scene();

}  // namespace bruma::scene
