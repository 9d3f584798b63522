#pragma once
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace bruma::app {

/// Whether a picture of this aspect ratio holds the whole box, before the camera.
bool shows(const scene::Camera& camera, const scene::Bounds& bounds, double aspect);

/// How a hand moves a camera. The eye goes around the target on a sphere whose poles are the camera's up axis; it stops
/// just short of them, so that up never flips. Each function returns the moved camera; the near distance follows the
/// distance to the target.

/// Angles in radians: positive `azimuth` turns the scene to the right, positive `elevation` raises the eye.
scene::Camera orbited(scene::Camera camera, double azimuth, double elevation);

/// The point under the hand follows it: `pixels` of movement (x right, y down) in a picture `height` pixels high.
scene::Camera panned(scene::Camera camera, glm::dvec2 pixels, double height);

/// Distance, and height of an orthographic view, times `factor` > 0.
scene::Camera zoomed(scene::Camera camera, double factor);

enum class Side { front, back, left, right, top, bottom };
/// Looks at the same target from the same distance, from a side; front is +z where y is up.
scene::Camera seen_from_side(scene::Camera camera, Side side);

/// Changes between perspective and orthographic so that the target keeps its size in the picture.
scene::Camera with_other_projection(scene::Camera camera);

}  // namespace bruma::app
