#pragma once
#include <memory>
#include <optional>
#include <string>

#include "app/viewer/scene_stamp.h"

namespace bruma::app {

/// What stays with a scene through all of its edits. Steps of undo share it, so that a step back across the opening of
/// a file brings the file's name back with the scene, and a scene saved under a new name has that name in all of its
/// steps.
struct SceneHome {
    std::string path;  ///< the file that saving writes; empty: in no file yet
    SceneStamp kept;   ///< of the scene as the file holds it, or as it was opened; empty: nowhere like this
    std::optional<scene::Camera> first_camera;
    bool has_own_camera = false;                 ///< the first camera was chosen, not fitted to what is shown
    std::optional<scene::Camera> placed_camera;  ///< set last by the viewer itself; another one was moved by hand
};
using SharedHome = std::shared_ptr<SceneHome>;

/// Whether two paths name the same file; files that are not there are compared by name.
bool same_file(const std::string& first, const std::string& second);

}  // namespace bruma::app
