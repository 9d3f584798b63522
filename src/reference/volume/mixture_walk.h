#pragma once
#include <vector>

#include "reference/volume/piece_walk.h"

namespace bruma::reference {

/// A ray through several volumes, part by part: on each the same pieces of the same volumes are present.
class MixtureWalk {
  public:
    MixtureWalk(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, bool leap);

    /// Distance in metres between the first entry and the last exit; below 0 for a ray that meets no volume.
    double length() const { return last_ - first_; }

    /// Goes on to the next part that holds something; false when there is none.
    bool next();
    double t0() const { return t0_; }
    double t1() const { return t1_; }
    /// The volumes on [t0, t1], each at its piece. The reference stays good while the walk lives.
    const std::vector<const PieceWalk*>& present() const { return present_; }

  private:
    std::vector<PieceWalk> walks_;
    std::vector<const PieceWalk*> present_;
    double first_, last_, t0_ = 0.0, t1_ = 0.0;
};

}  // namespace bruma::reference
