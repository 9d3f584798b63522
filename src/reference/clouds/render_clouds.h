#pragma once
#include <optional>

#include "reference/clouds/cloud_march.h"
#include "reference/clouds/cloud_monte_carlo.h"
#include "reference/medium/render_scattering.h"
#include "reference/sky/sky_picture.h"

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
    SkyTableOptions sky_tables = fine_sky_tables();
    std::vector<std::uint8_t> wanted =
        {};  ///< pixels that are not 0 alone are worked out, the others black; empty: all
    std::function<void(double)> progress = {};
};

/// Lamp and constant environment as clouds see them: the first directional lamp that shines is the sun, over a ground
/// of the default atmosphere's albedo.
CloudLight cloud_light(const scene::Scene& scene);

/// Air and sun of an outdoor scene, as clouds see them.
class CloudSky {
  public:
    CloudSky(const scene::Scene& scene, const SkyTableOptions& options);
    const CloudLight& light() const { return light_; }
    /// Air before a point of the ray at a distance, in the shadows of these clouds; `samples` per layer on each way to
    /// the sun.
    std::function<AirLight(double distance_m)> air_along(const scene::Ray& ray, double longest_m,
                                                         std::span<const CloudMedium> shading = {},
                                                         int samples = 64) const;

  private:
    std::shared_ptr<const AtmosphereTables> tables_;
    glm::dvec3 eye_world_, irradiance_;
    CloudLight light_;
};

/// All shown layers of clouds over the background, seen by the scene's camera at the scene's time, in double precision.
/// Outdoors the sun reaches each point through the air above it and the air before each point is seen, in the shadows
/// of clouds unless `sky.shafts` is off, all by the sun's elevation at the camera; the sky behind is left out, and its
/// light is that on the ground. Paths of all orders pass no air but that before their first collision. `error`: single:
/// estimated; multiple: standard error. Throws InputError for a scene without camera, or with shown volumes or meshes,
/// which this reference does not know.
ScatteringImage render_clouds(const scene::Scene& scene, int width, int height, const CloudImageOptions& options = {});

}  // namespace bruma::reference
