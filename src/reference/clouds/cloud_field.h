#pragma once
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "reference/clouds/noise.h"
#include "scene/clouds/cloud_layer.h"
#include "scene/clouds/cloud_weather.h"

/// Density of clouds after Alaminos 2020, chapter 4 (Häggström 2018, Schneider 2015), made total: defined, finite and
/// continuous in its inputs for every weather and every parameter in its range.
namespace bruma::reference {

/// 0 below a, 1 above b, linear in between; a step at b when the two are nearly one. a <= b.
double ramp(double v, double a, double b);

/// Cloudy share of a column before noise: the coverage times what the weather map says at this coverage.
double effective_coverage(const scene::CloudLayer& layer, const scene::CloudWeather& weather);

/// Profiles over the height, at `height` in [0,1] from the bottom of the layer to its top.
double height_shape(double height, double cloud_top);  ///< round below and above, in [0,1]
double height_density(const scene::CloudLayer& layer, const scene::CloudWeather& weather, double height);

/// All quantities between the lookups and the density, by their names in the thesis' equations 4.5 to 4.16.
struct CloudTerms {
    double base = 0.0;      ///< noise of the large shape, in [0,1]
    double coverage = 0.0;  ///< effective
    double height_shape = 0.0;
    double height_density = 0.0;
    double shape = 0.0;    ///< cut by the coverage, in [0,1]
    double erosion = 0.0;  ///< subtracted by the detail noise, below 1
    double density = 0.0;
};
/// `base` and `detail` are base_shape and detail_octaves of the noise.
CloudTerms cloud_terms(const scene::CloudLayer& layer, const scene::CloudWeather& weather, double coverage,
                       double height, double base, double detail);

/// Noise of one field; may be shared by many layers.
struct CloudNoise {
    NoiseTexture shape;   ///< RGBA, or one channel when packed
    NoiseTexture detail;  ///< RGB, or one channel when packed
};
/// The normative textures, or smaller ones for tests: another field of the same sort.
std::shared_ptr<const CloudNoise> make_cloud_noise(scene::NoisePacking packing = scene::NoisePacking::channels,
                                                   int shape_size = 128, int detail_size = 32);

/// The normative textures, made once and kept.
std::shared_ptr<const CloudNoise> normative_cloud_noise(scene::NoisePacking packing = scene::NoisePacking::channels);

/// Effective coverage that fills a wanted share of space with cloud, from the distribution of the base shape.
class LinearCoverage {
  public:
    explicit LinearCoverage(const NoiseTexture& shape);
    double operator()(double share) const;

  private:
    std::vector<double> quantiles_;  ///< of the base shape, from its largest value down
};

/// A layer at one time.
class CloudField {
  public:
    CloudField(const scene::CloudLayer& layer, std::shared_ptr<const scene::WeatherMap> map,
               std::shared_ptr<const CloudNoise> noise, double time_s = 0.0);

    /// Density at (x, altitude, z), metres; 0 outside of the layer's altitudes. Dimensionless: times the extinction of
    /// density 1 it is an extinction per metre.
    double density(const glm::dvec3& pattern_point) const { return evaluate(pattern_point, true); }
    /// The same without detail noise: never smaller.
    double density_without_detail(const glm::dvec3& pattern_point) const { return evaluate(pattern_point, false); }
    /// The same from all terms, none left out early.
    CloudTerms terms(const glm::dvec3& pattern_point) const;
    /// No density of this field is larger.
    double majorant() const { return majorant_; }

    scene::CloudWeather weather(const glm::dvec3& pattern_point) const;

  private:
    double evaluate(const glm::dvec3& pattern_point, bool with_detail) const;
    double largest_density() const;
    double height(const glm::dvec3& pattern_point) const;
    double coverage(const scene::CloudWeather& weather) const;
    double base(const glm::dvec3& blown) const;
    double detail(const glm::dvec3& blown) const;
    glm::dvec3 blown(const glm::dvec3& pattern_point, double height) const;

    scene::CloudLayer layer_;
    std::shared_ptr<const scene::WeatherMap> map_;
    std::shared_ptr<const CloudNoise> noise_;
    std::optional<LinearCoverage> linear_coverage_;
    glm::dvec3 wind_;     ///< unit vector
    glm::dvec3 drifted_;  ///< metres that the pattern has moved since time 0
    double majorant_;
};

}  // namespace bruma::reference
