#include "app/viewer/edit_history.h"

#include <filesystem>
#include <utility>

namespace bruma::app {

bool same_file(const std::string& first, const std::string& second) {
    if (first.empty() || second.empty()) {
        return false;
    }
    const auto canonical = [](const std::string& path) {
        std::error_code error;
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
    };
    return canonical(first) == canonical(second);
}

void EditHistory::observe(const scene::Scene& scene, const SharedHome& home, bool in_gesture) {
    if (in_gesture) {
        return;
    }
    SceneStamp stamp = document_stamp(scene);
    if (stamp == stamp_ && home == settled_.home) {
        // Should another scene come, this one is brought back as it was last seen.
        settled_.scene.camera = scene.camera;
        settled_.scene.time = scene.time;
        return;
    }
    past_.push_back(std::exchange(settled_, {scene, home}));
    stamp_ = std::move(stamp);
    future_.clear();
    if (past_.size() > longest) {
        past_.pop_front();
    }
}

void EditHistory::settle(Step step, scene::Scene& scene, SharedHome& home) {
    settled_ = std::move(step);
    stamp_ = document_stamp(settled_.scene);
    scene::Scene shown = settled_.scene;
    if (settled_.home == home) {
        if (scene.camera) {
            shown.camera = scene.camera;
        }
        shown.time.edit([&](scene::Timeline& timeline) { timeline.now_s = scene.time->now_s; });
    }
    scene = std::move(shown);
    home = settled_.home;
}

void EditHistory::undo(scene::Scene& scene, SharedHome& home) {
    observe(scene, home, false);
    if (past_.empty()) {
        return;
    }
    future_.push_back(settled_);
    Step step = std::move(past_.back());
    past_.pop_back();
    settle(std::move(step), scene, home);
}

void EditHistory::redo(scene::Scene& scene, SharedHome& home) {
    if (future_.empty()) {
        return;
    }
    past_.push_back(settled_);
    Step step = std::move(future_.back());
    future_.pop_back();
    settle(std::move(step), scene, home);
}

void EditHistory::restart(const scene::Scene& scene, const SharedHome& home) {
    past_.clear();
    future_.clear();
    settled_ = {scene, home};
    stamp_ = document_stamp(scene);
}

void EditHistory::was_saved(const SceneHome& home) {
    for (const std::deque<Step>* steps : {&past_, &future_}) {
        for (const Step& step : *steps) {
            if (step.home && step.home.get() != &home && same_file(step.home->path, home.path)) {
                step.home->kept.clear();
            }
        }
    }
}

}  // namespace bruma::app
