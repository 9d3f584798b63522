#pragma once
#include <glm/glm.hpp>

#include "render/paths/path_goal.h"

namespace bruma::render {

/// Where a picture is drawn and how coarsely; a viewer lowers both while something moves.
struct View {
    glm::ivec2 pixels{0};
    double step_scale = 1.0;  ///< multiplies the step of the scene's settings
    PathGoal paths{};
    bool in_window = false;  ///< one of many at which someone looks: clouds may come from the last (CloudReprojection)
    bool operator==(const View&) const = default;
};

}  // namespace bruma::render
