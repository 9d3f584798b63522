#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace bruma::app {

/// Revisions and structure of a scene as numbers: equal stamps, equal scenes. Comparing them costs nothing beside
/// drawing, so the viewer asks 'did anything change?' instead of being told by each panel.
using SceneStamp = std::vector<std::uint64_t>;

/// All that the linear picture depends on.
SceneStamp picture_stamp(const scene::Scene& scene);
/// Whether two of the above differ by camera and time at most.
bool same_but_for_view(const SceneStamp& first, const SceneStamp& second);
/// All that a person edits and may want undone: everything but the camera and the moment
/// that is shown.
SceneStamp document_stamp(const scene::Scene& scene);

}  // namespace bruma::app
