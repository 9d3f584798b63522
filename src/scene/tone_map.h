#pragma once
#include <glm/glm.hpp>

#include "base/image.h"
#include "scene/rendering.h"

namespace bruma::scene {

/// What the display shows of linear radiance that is exposed already: linear Rec.709, clipped to [0, 1]. The curves of
/// shaders/compose/composite.frag in double precision, of which a channel never falls while the exposure rises.
glm::dvec3 tone_mapped(ToneMap tone_map, const glm::dvec3& exposed);

/// The same for a picture under the display's exposure; opacity is kept.
Image shown_image(const Image& linear, const Display& display);

}  // namespace bruma::scene
