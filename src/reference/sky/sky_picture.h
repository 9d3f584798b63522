#pragma once
#include <functional>
#include <optional>

#include "base/image.h"
#include "reference/sky/sky_models.h"
#include "reference/sky/sky_tables.h"
#include "scene/scene.h"

namespace bruma::reference {

/// What a ray from any point meets in air and ground. Points are relative to the sea level below the camera, y up
/// there; also from outside the air, which is where the ray's path then begins.
struct SkyPath {
    AirLight air;                               ///< for irradiance 1 of the sun
    std::optional<double> sun_climb_at_ground;  ///< where the ray ends there
};
SkyPath sky_path(const AtmosphereTables& tables, const glm::dvec3& from, const glm::dvec3& direction,
                 const glm::dvec3& to_sun, int steps);

SkyTableOptions fine_sky_tables();
/// Without light that is scattered more than once where the sky has none.
SkyTableOptions as_asked(SkyTableOptions options, const scene::Sky& sky);

/// The sky of an outdoor scene, for any ray from its camera. May be used from several threads.
class SkyBackground {
  public:
    /// By default from tables several times finer than those that pictures are drawn from.
    explicit SkyBackground(const scene::Scene& scene, SkyTableOptions options = fine_sky_tables());
    /// Radiance of air and ground, above the horizon of the sky's model, without the sun's disc.
    glm::dvec3 radiance(const scene::Ray& ray, int steps) const;
    /// Of the sun's disc alone, behind the air, or as the model has it.
    glm::dvec3 disc(const scene::Ray& ray) const;
    bool near_disc(const scene::Ray& ray, double margin_rad) const;

  private:
    glm::dvec3 from_sea_level(const glm::dvec3& point_world) const;
    glm::dvec3 ground_radiance(double sun_climb) const;

    scene::Outdoors outdoors_;
    glm::dvec3 eye_world_;
    glm::dvec3 to_sun_;
    AtmosphereTables tables_;
    double model_share_ = 1.0;               ///< the rest is the atmosphere
    std::optional<GroundSky> model_;         ///< nothing: the atmosphere
    std::vector<glm::dvec3> sky_on_ground_;  ///< planar irradiance by the sky, over the square root of the sun's climb
};

struct SkyPictureResult {
    Image image;               ///< alpha 0; no tone mapping
    std::vector<float> error;  ///< per pixel: what half as many steps change, which bounds what they leave
    double largest_error = 0.0;
    double rms_error = 0.0;
};
/// The sky at pixel centres, the sun's disc as the mean over each pixel.
SkyPictureResult render_sky(const scene::Scene& scene, int width, int height, int steps = 1000,
                            const std::function<void(double)>& progress = {});

}  // namespace bruma::reference
