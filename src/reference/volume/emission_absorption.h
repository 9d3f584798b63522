#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "reference/volume/prepared_volume.h"
#include "scene/scene.h"

/// The truth for volumes that emit and absorb: the integral
///
///     L = integral of sigma(t) S(t) exp(-tau(t)) dt + B exp(-tau),   tau(t) = integral of sigma
///
/// (Max, Optical Models for Direct Volume Rendering, IEEE TVCG 1995) along each pixel's central ray, in double
/// precision, by quadrature that adapts to a stated error. The scalar field is trilinear between samples at
/// (i + 1/2) / n and clamped in the outer half voxel; the transfer function is evaluated exactly, after interpolation.
/// Several volumes at one place add their sigma and their sigma S. Nothing of RenderSettings matters here.
namespace bruma::reference {

struct ReferenceOptions {
    double tolerance = 1e-6;  ///< of each pixel, radiance; display range is 1
    bool leap = true;         ///< pass over transparent matter; off only to prove that it changes nothing
    std::function<void(double)> progress = {};  ///< share done in [0, 1]; called from worker threads, one at a time
};

struct RayResult {
    glm::dvec3 radiance{0.0};       ///< added by the volumes, without background
    double transmittance = 1.0;     ///< share of the background that is seen
    double error = 0.0;             ///< estimated bound, of each channel of the radiance and of the transmittance
    std::uint64_t evaluations = 0;  ///< of the media
};

struct ReferenceImage {
    Image image;               ///< radiance over the background; alpha is 1 - transmittance; no tone mapping
    std::vector<float> error;  ///< per pixel, radiance: estimated bound, with the rounding of the picture to float
    double largest_error = 0.0;
    double rms_error = 0.0;
    std::uint64_t evaluations = 0;
};

/// A scene made ready for rays. Keeps its grids alive; may be used from several threads.
class EmissionAbsorption {
  public:
    /// Throws InputError for a scene that fails scene::check, has no camera, or asks for lighting beyond this model.
    explicit EmissionAbsorption(const scene::Scene& scene, const ReferenceOptions& options = {});

    RayResult trace(const scene::Ray& ray) const;

  private:
    ReferenceOptions options_;
    std::vector<PreparedVolume> volumes_;
};

/// One ray; for many, keep an EmissionAbsorption.
RayResult trace(const scene::Scene& scene, const scene::Ray& ray, const ReferenceOptions& options = {});

/// The picture seen by the scene's camera. Same inputs give the same picture, bit for bit, on the same machine.
/// Throws InputError as EmissionAbsorption does, and for a picture without pixels.
ReferenceImage render_emission_absorption(const scene::Scene& scene, int width, int height,
                                          const ReferenceOptions& options = {});

}  // namespace bruma::reference
