#pragma once
#include <array>
#include <memory>
#include <vector>

#include "scene/volume/volume_grid.h"

namespace bruma::app {

/// How often the values of a grid occur, counted once per grid and kept for drawing.
class VolumeHistogram {
  public:
    static constexpr int bins = 512;
    /// Counts anew only for another grid.
    void update(const std::shared_ptr<const scene::VolumeGrid>& grid);
    /// Height in [0, 1] of the values from `low` to `high`: the fullest bin among them, over the fullest of all but the
    /// two ends, which mostly hold air and what was cut off. `logarithmic` shows what is rare.
    double height(double low, double high, bool logarithmic) const;
    double smallest() const { return counted_.smallest; }
    double largest() const { return counted_.largest; }

  private:
    std::shared_ptr<const scene::VolumeGrid> grid_;
    scene::Histogram counted_;
    double fullest_ = 1.0;
};

}  // namespace bruma::app
