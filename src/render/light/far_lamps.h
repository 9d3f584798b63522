#pragma once
#include <optional>

#include "scene/scene.h"

namespace bruma::render {

/// Parallel light in place of a lamp that stands more than 10^4 radii, along some axis, from the middle of what it
/// lights: its rays differ by less than floats at such a distance tell points apart, in shadow maps and where light
/// enters. Nothing for a lamp that is nearer or has no position. Metres.
std::optional<scene::Light> parallel_from_afar(const scene::Light& light, glm::dvec3 middle_world, double radius_world);

/// A copy of the scene with such light in place of the lamps that are far from all of it; nothing when there are none.
std::optional<scene::Scene> with_far_lamps_parallel(const scene::Scene& scene);

}  // namespace bruma::render
