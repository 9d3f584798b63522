#pragma once
#include <cstdint>
#include <functional>
#include <span>

#include "reference/clouds/cloud_air.h"
#include "reference/clouds/cloud_lighting.h"
#include "reference/clouds/cloud_medium.h"
#include "scene/camera.h"

/// Light in clouds by path tracing, all orders of scattering with the phase function and albedo as they are: the only
/// judge of the octaves. Delta tracking after Woodcock 1965; light from the sun by next-event estimation with ratio
/// tracking (Novak, Selle, Jarosz 2014). Unbiased but for the cut at `most_orders`.
namespace bruma::reference {

struct MonteCarloOptions {
    std::uint32_t samples = 1024;
    std::uint32_t pixel = 0;            ///< another number is another stream
    std::int64_t most_orders = 100000;  ///< of scattering; 1 is single scattering
    double longest_m = 200e3;           ///< of the view ray
    /// Air between the eye and a point of this ray, over the distance; empty: none. Paths pass none after that.
    std::function<AirLight(double distance_m)> air = {};
};

struct MonteCarloResult {
    glm::dvec3 radiance{0.0};        ///< of light that clouds scattered at least once
    glm::dvec3 standard_error{0.0};  ///< of that mean, from the spread of the samples
    double transmittance = 1.0;      ///< share of paths that met nothing, by ratio tracking
    double transmittance_error = 0.0;
    double mean_orders = 0.0;  ///< scatterings of a path
};

/// One ray. The same options give the same bits on any number of threads.
MonteCarloResult trace_paths(std::span<const CloudMedium> media, const CloudLight& light, const scene::Ray& ray,
                             const MonteCarloOptions& options = {});

}  // namespace bruma::reference
