#pragma once
#include "reference/volume/volume_ray.h"

namespace bruma::reference {

/// The blocks of 8^3 cells that a ray crosses in one volume, front to back, without the transparent ones.
class MajorantWalk {
  public:
    MajorantWalk(const PreparedVolume& volume, const scene::Ray& ray, double t_far);

    bool finished() const { return finished_; }
    void advance();
    double t0() const { return t0_; }
    double t1() const { return t1_; }
    double majorant() const { return majorant_; }  ///< 1/m, for all of [t0, t1]

    /// What the volume is at t in [t0, t1]. Rounding at a face is resolved towards the current block, so that its
    /// majorant holds; throws std::logic_error if it does not.
    OpticalPoint optics_at(double t) const;

  private:
    void enter_block();

    VolumeRay in_volume_;
    glm::ivec3 block_{0};
    double t0_ = 0.0, t1_ = 0.0, majorant_ = 0.0;
    VolumeRay::Plane exit_;
    bool finished_ = false;
};

}  // namespace bruma::reference
