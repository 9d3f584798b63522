#pragma once
#include <deque>

#include "app/viewer/scene_home.h"

namespace bruma::app {

/// Undo and redo of everything but the camera and the moment shown. A scene is a small value beside its shared grids,
/// so whole scenes are kept, each with its home. A gesture, such as one drag, is one step.
class EditHistory {
  public:
    /// Looks at the scene after each frame; `in_gesture` while a button or a widget is held.
    void observe(const scene::Scene& scene, const SharedHome& home, bool in_gesture);
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }
    /// Puts the scene back by one step. Its camera stays, unless the scene is another one, at home in another file.
    void undo(scene::Scene& scene, SharedHome& home);
    void redo(scene::Scene& scene, SharedHome& home);
    /// Starts afresh from this scene.
    void restart(const scene::Scene& scene, const SharedHome& home);
    /// Tells that `home` was written to its file, so that no other scene of the same file is there any more.
    void was_saved(const SceneHome& home);

  private:
    struct Step {
        scene::Scene scene;
        SharedHome home;
    };
    void settle(Step step, scene::Scene& scene, SharedHome& home);

    static constexpr std::size_t longest = 100;
    Step settled_;
    SceneStamp stamp_;
    std::deque<Step> past_, future_;
};

}  // namespace bruma::app
