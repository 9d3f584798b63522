#pragma once
#include "reference/medium/delta_tracking.h"
#include "reference/medium/scattering_scene.h"

namespace bruma::reference {

/// Where a path left all matter.
struct Escape {
    bool escaped = false;  ///< otherwise it was absorbed, or cut off
    bool cut_off = false;  ///< it had been scattered `max_bounces` times
    int bounces = 0;
    glm::dvec3 way_world{0.0};  ///< unit
    glm::dvec3 weight{0.0};     ///< share of what it began with, per channel; its mean over all paths is exact
};

/// All of the light by Monte Carlo: paths from the eye by delta tracking, at each collision light straight from the
/// lights (next-event estimation by ratio tracking) and on by the phase function, with weight times the albedo;
/// Russian roulette once little weight is left. Unbiased, but for paths cut off after `max_bounces`. Volumes of
/// lighting none or gradient absorb, and give off their emission only. Surfaces (optics.surfaces) play no part.
///
/// Close to a lamp inside of matter 1 / r^2 has no variance: the error that samples show is then too small.
class PathTracer {
  public:
    /// Keeps a reference to the scene. Throws InputError for a medium that delta tracking would take for ever to cross.
    PathTracer(const ScatteringScene& scene, int max_bounces);

    struct Sample {
        glm::dvec3 radiance{0.0};  ///< of light scattered at least once
        bool cut_off = false;
        std::uint64_t collisions = 0;
    };
    Sample sample(const scene::Ray& ray, RandomStream& random) const;

    /// The same path without lights and emission: what a beam along the ray does, or by reciprocity what comes to it.
    Escape follow(const scene::Ray& ray, RandomStream& random) const;

  private:
    template <class AtCollision>
    Escape walk(scene::Ray ray, RandomStream& random, AtCollision&& at_collision) const;
    glm::dvec3 light_from_lights(const Collision& collision, glm::dvec3 position, glm::dvec3 way,
                                 RandomStream& random) const;

    const ScatteringScene& scene_;
    int max_bounces_;
};

}  // namespace bruma::reference
