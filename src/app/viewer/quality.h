#pragma once
#include <algorithm>
#include <glm/glm.hpp>

#include "render/march/march_pass.h"

namespace bruma::app {

/// Chooses how coarsely to draw while something moves, from what the last pictures cost, so that a picture takes about
/// a fourteenth of a second: first fewer pixels, down to a quarter along each edge, then longer steps, up to four.
class QualityController {
  public:
    static constexpr double target_ms = 70.0;

    /// The view for a picture of `area` pixels while something moves. Without any measurement yet: the coarsest.
    /// `from_last`: only the camera or the time is new, so that clouds come from the last picture where they can.
    render::View moving(glm::ivec2 area, bool from_last = false) const;
    /// The view of the picture that stays.
    static render::View refined(glm::ivec2 area) { return {.pixels = area, .in_window = true}; }

    /// What the refined picture will cost, ms; 0 when unknown.
    double refined_ms(glm::ivec2 area) const { return std::max(0.0, ms_per_pixel_) * area.x * area.y; }

    /// Tells what a picture cost: the marches over `view`, and all other passes; with `from_last` those of clouds took
    /// most of their pixels from the last picture.
    void measured(const render::View& view, double march_ms, double other_ms, bool from_last = false);
    /// Forgets the costs: another scene.
    void forget() { *this = {}; }

  private:
    double ms_per_pixel_ = -1.0;  ///< at step scale 1; negative: unknown
    double ms_per_pixel_from_last_ = -1.0;
    double other_ms_ = 0.0;
    glm::ivec2 last_pixels_{0};
};

}  // namespace bruma::app
