#pragma once
#include <optional>
#include <vector>

#include "reference/random.h"
#include "reference/volume/prepared_volume.h"
#include "scene/camera.h"

/// Free flight through volumes without bias and without quadrature (Woodcock et al., Techniques used in the GEM code,
/// ANL-7050, 1965; Novak et al., Monte Carlo methods for volumetric light transport simulation, CGF 37, 2018).
namespace bruma::reference {

struct Collision {
    const PreparedVolume* volume = nullptr;
    double t = 0.0;  ///< distance along the ray, metres
    OpticalPoint optics{};
};

/// Where a photon on this ray first meets matter. In each volume by delta tracking; the nearest of independent
/// collisions is that of the mixture, and finds its volume in proportion to the extinctions.
std::optional<Collision> next_collision(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray,
                                        RandomStream& random);

/// A random number whose mean is the transmittance from the ray's near plane to `t_far`: ratio tracking (Novak,
/// Selle, Jarosz, Residual ratio tracking, SIGGRAPH Asia 2014), with Russian roulette once little is left.
double tracked_transmittance(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, double t_far,
                             RandomStream& random);

}  // namespace bruma::reference
