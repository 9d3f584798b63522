#include "app/nothing_seen.h"

#include "base/log.h"
#include "scene/unseen.h"

namespace bruma::app {

void NothingSeen::look_at(const scene::Scene& scene, const render::Picture& picture) {
    if (seen_) {
        return;
    }
    seen_ = coverage_.covers_any(picture);
    if (seen_) {
        sentence_.clear();
    } else if (sentence_.empty()) {
        sentence_ = scene::why_nothing_is_seen(scene, glm::ivec2(picture.color.size()));
    }
}

void NothingSeen::say() const {
    if (!sentence_.empty()) {
        log_warning("{}", sentence_);
    }
}

}  // namespace bruma::app
