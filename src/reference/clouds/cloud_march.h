#pragma once
#include <cstdint>
#include <span>

#include "reference/clouds/cloud_air.h"
#include "reference/clouds/cloud_lighting.h"
#include "reference/clouds/cloud_medium.h"
#include "scene/camera.h"

/// The picture of clouds by a fine march in double precision: midpoints, energy-conserving segments, no big steps and
/// nothing skipped. The error is that of the numbers, for the model of light as it is given.
namespace bruma::reference {

/// How the optical depth to the sun is found: the straight ray, ever finer, or the six samples of the cone as pictures
/// are drawn with, whose own error against the straight ray is then part of the model.
enum class SunPath { straight, cone };

struct CloudMarchOptions {
    double tolerance = 1e-4;  ///< of the sum of both errors of a ray
    double coarsest_step_m = 64.0;
    double finest_step_m = 0.25;
    SunPath sun_path = SunPath::straight;
    int fewest_sun_samples = 64;  ///< per layer on the way to the sun, and up and down for ambient light
    int most_sun_samples = 4096;
    double stop_transmittance = 1e-6;
    double longest_m = 200e3;  ///< rays end here
    /// Air between the eye and a point of this ray, over the distance; empty: none.
    std::function<AirLight(double distance_m)> air = {};
};

/// Optical depth of all layers along a ray to its end, by `samples` midpoints in each stretch.
double optical_depth(std::span<const CloudMedium> media, const glm::dvec3& from_world,
                     const glm::dvec3& direction_world, int samples);

struct CloudRayResult {
    glm::dvec3 radiance{0.0};      ///< added by the clouds, without what is behind
    double transmittance = 1.0;    ///< share of what is behind that is seen
    double mean_distance_m = 0.0;  ///< weighted by what each part hides; 0 where nothing is hidden
    double view_error = 0.0;  ///< difference to the march of twice the step: of the radiance relative to its largest
                              ///< channel, or of the transmittance, whichever is larger
    double sun_error = 0.0;   ///< the same for half of the samples towards the sun
    double step_m = 0.0;      ///< of the last march
    int sun_samples = 0;
    std::uint64_t samples = 0;  ///< of the view ray, of all marches
};

/// One march, from the eye on, with a given step and number of samples towards the sun, without error.
CloudRayResult march_once(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                          double step_m, int sun_samples, const CloudMarchOptions& options = {});

/// Halves the step, and doubles the samples towards the sun, until each changes the result by less than half of the
/// tolerance. The field has kinks, so the last differences are given as they are, and not divided as by Richardson.
CloudRayResult march_clouds(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                            const CloudMarchOptions& options = {});

}  // namespace bruma::reference
