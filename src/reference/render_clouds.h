#pragma once
#include <optional>

#include "reference/cloud_march.h"
#include "reference/cloud_monte_carlo.h"
#include "reference/render_scattering.h"

namespace bruma::reference {

struct CloudImageOptions {
    /// single: the scene's own model of light (octaves, or the artistic look) by the fine march, exact to a tolerance;
    /// multiple: all orders of scattering by random paths.
    LightPaths paths = LightPaths::single;
    CloudMarchOptions march = {};
    /// Marches of this fixed step (metres) and these many samples towards the sun, without error: for tests that cannot
    /// wait. Nothing: by halving.
    std::optional<double> fixed_step_m = {};
    int fixed_sun_samples = 64;
    std::uint32_t samples = 256;  ///< multiple: paths for each pixel
    std::function<void(double)> progress = {};
};

/// Lamp and constant environment as clouds see them: the first directional lamp that shines is the sun, over a ground
/// of the default atmosphere's albedo.
CloudLight cloud_light(const scene::Scene& scene);

/// All shown layers of clouds over the background, seen by the scene's camera at the scene's time, in double precision.
/// `error`: single: estimated; multiple: standard error. Throws InputError for a scene without camera, or with shown
/// volumes or meshes, which this reference does not know.
ScatteringImage render_clouds(const scene::Scene& scene, int width, int height, const CloudImageOptions& options = {});

}  // namespace bruma::reference
