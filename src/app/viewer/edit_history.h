#pragma once
#include <deque>

#include "app/viewer/scene_stamp.h"

namespace bruma::app {

/// Undo and redo of everything but the camera. A scene is a small value beside its shared grids, so whole scenes are
/// kept. A gesture, such as one drag, is one step.
class EditHistory {
  public:
    /// Looks at the scene after each frame; `in_gesture` while a button or a widget is held.
    void observe(const scene::Scene& scene, bool in_gesture);
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// Puts the scene back by one step; its camera stays.
    void undo(scene::Scene& scene);
    void redo(scene::Scene& scene);
    /// Starts afresh from this scene.
    void restart(const scene::Scene& scene);

  private:
    static void exchange(scene::Scene& scene, scene::Scene with);

    static constexpr std::size_t longest = 100;
    scene::Scene settled_;
    SceneStamp stamp_;
    std::deque<scene::Scene> past_, future_;
};

}  // namespace bruma::app
