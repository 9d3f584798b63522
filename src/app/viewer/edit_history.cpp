#include "app/viewer/edit_history.h"

#include <utility>

namespace bruma::app {

void EditHistory::observe(const scene::Scene& scene, bool in_gesture) {
    if (in_gesture) {
        return;
    }
    SceneStamp stamp = document_stamp(scene);
    if (stamp == stamp_) {
        return;
    }
    past_.push_back(std::exchange(settled_, scene));
    stamp_ = std::move(stamp);
    future_.clear();
    if (past_.size() > longest) {
        past_.pop_front();
    }
}

void EditHistory::exchange(scene::Scene& scene, scene::Scene with) {
    if (scene.camera) {
        with.camera = scene.camera;
    }
    with.time = scene.time;
    scene = std::move(with);
}

void EditHistory::undo(scene::Scene& scene) {
    observe(scene, false);
    if (past_.empty()) {
        return;
    }
    future_.push_back(settled_);
    settled_ = std::move(past_.back());
    past_.pop_back();
    stamp_ = document_stamp(settled_);
    exchange(scene, settled_);
}

void EditHistory::redo(scene::Scene& scene) {
    if (future_.empty()) {
        return;
    }
    past_.push_back(settled_);
    settled_ = std::move(future_.back());
    future_.pop_back();
    stamp_ = document_stamp(settled_);
    exchange(scene, settled_);
}

void EditHistory::restart(const scene::Scene& scene) {
    past_.clear();
    future_.clear();
    settled_ = scene;
    stamp_ = document_stamp(scene);
}

}  // namespace bruma::app
