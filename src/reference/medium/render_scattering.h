#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "scene/scene.h"

namespace bruma::reference {

enum class LightPaths {
    single,   ///< lights only, scattered once: SingleScattering, exact to a tolerance
    multiple  ///< all of the light, that of the environment too: PathTracer, exact on average
};

struct ScatteringOptions {
    LightPaths paths = LightPaths::multiple;
    double tolerance = 1e-3;    ///< single: of each pixel, radiance; display range is 1
    int samples = 64;           ///< multiple: paths for each pixel
    int max_bounces = 100'000;  ///< multiple: times that light is scattered before its path is cut off
    std::uint64_t seed = 0;     ///< multiple: pictures of other seeds are independent of each other
    bool leap = true;           ///< single: pass over transparent matter; off only to prove that it changes nothing
    std::function<void(double)> progress = {};  ///< share done in [0, 1]; from worker threads, one call at a time
};

struct ScatteringImage {
    Image image;                   ///< radiance over the background; alpha is 1 - transmittance, exact; no tone mapping
    std::vector<glm::vec3> error;  ///< per pixel and channel. single: estimated bound; multiple: standard error
    double largest_error = 0.0;
    double rms_error = 0.0;
    std::uint64_t evaluations = 0;  ///< single: of the media; multiple: collisions
    double cut_off_share = 0.0;     ///< multiple: paths cut off at max_bounces; their further light is missing, no more
};

/// The picture seen by the scene's camera along each pixel's central ray. The same inputs give the same picture, bit
/// for bit, on the same machine, with any number of threads. Throws InputError for a scene that fails scene::check or
/// has no camera, a picture without pixels, fewer than two samples, or a medium too steep for delta tracking.
ScatteringImage render_scattering(const scene::Scene& scene, int width, int height,
                                  const ScatteringOptions& options = {});

}  // namespace bruma::reference
