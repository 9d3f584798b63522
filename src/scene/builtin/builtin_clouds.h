#pragma once
#include <span>
#include <string_view>

#include "scene/scene.h"

namespace bruma::scene {

/// Names of the whole scenes of one layer, without 'builtin:' in front: one for each genus.
std::span<const std::string_view> builtin_cloud_scenes();
/// A layer of clouds over the camera, under the sun of a fair afternoon.
Scene builtin_cloud_scene(CloudType type);
/// The clouds of such a scene: its node 'sky'.
Clouds& clouds_in(Scene& scene);

/// Cumulus under a sky, over hills that lie in their shadows.
Scene clouds_over_ground_scene();
/// Beams of a low sun between cumulus, in hazy air.
Scene clouds_shafts_scene();
/// A layer of clouds over the camera, under a sky.
Scene clouds_under_sky_scene();

}  // namespace bruma::scene
