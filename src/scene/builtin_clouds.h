#pragma once
#include <span>
#include <string_view>

#include "scene/scene.h"

namespace bruma::scene {

/// Names of the whole scenes of clouds, without 'builtin:' in front: one for each genus.
std::span<const std::string_view> builtin_cloud_scenes();
/// A layer of clouds over the camera, under the sun of a fair afternoon.
Scene builtin_cloud_scene(CloudType type);

}  // namespace bruma::scene
