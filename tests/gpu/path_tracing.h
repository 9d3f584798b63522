#pragma once
#include "drawing.h"

/// What the tests of path tracing share.
namespace bruma::render {

struct Traced {
    Image mean, error;  ///< error: standard error, per pixel and channel
};

/// Mean over all pixels of one channel, and its standard error; pixels are independent of each other.
struct Estimate {
    double mean = 0.0, error = 0.0;
};

class PathTraced : public Drawing {
  protected:
    Traced trace(const scene::Scene& scene, glm::ivec2 pixels, PathGoal goal);
};

Estimate estimate(const Traced& traced, int channel);
/// How far two estimates lie apart, in their joint standard errors.
double apart(const Estimate& a, const Estimate& b);

scene::VolumeOptics& path_traced(scene::VolumeOptics& optics);
/// Homogeneous matter between z = -height/2 and +height/2, so wide that its borders are never met, seen from +z.
scene::Scene wide_slab(double sigma, double height, double albedo, double g);

}  // namespace bruma::render
