#include "reference/clouds/cloud_field.h"

#include "reference/interpolation.h"

#include <algorithm>
#include <cmath>

namespace bruma::reference {
namespace {

/// Below this effective coverage there is no cloud; below this height of its top, none either.
constexpr double least_coverage = 1e-4;
constexpr double least_top = 1.0 / 255.0;

/// Equation 4.13, the five arguments applied to one remap: what of the base is above 1 - coverage.
double cut_by_coverage(double base, double height_shape, double coverage) {
    return coverage <= least_coverage ? 0.0 : saturate((base * height_shape - (1.0 - coverage)) / coverage);
}

/// Equations 4.14 and 4.15. The printed growing exponential breaks the bound of 0.35 that the text gives.
double erosion_of(const scene::CloudLayer& layer, double height, double detail) {
    const double sign = layer.erosion == scene::CloudErosion::fades ? -1.0 : 1.0;
    return 0.35 * std::exp(sign * 0.75 * layer.coverage) * mix(detail, 1.0 - detail, saturate(5.0 * height));
}

double eroded(double shape, double erosion) {
    return saturate((shape - erosion) / (1.0 - erosion));
}

}  // namespace

double ramp(double v, double a, double b) {
    const double width = b - a;
    return std::abs(width) < 1e-5 ? (v >= b ? 1.0 : 0.0) : saturate((v - a) / width);
}

double effective_coverage(const scene::CloudLayer& layer, const scene::CloudWeather& weather) {
    const double placed =
        layer.coverage_rule == scene::CoverageRule::blend
            ? mix(weather.placement, weather.placement_overcast, layer.coverage)
            : std::max(weather.placement, 2.0 * saturate(layer.coverage - 0.5) * weather.placement_overcast);
    return layer.coverage * placed;
}

double height_shape(double height, double cloud_top) {
    return saturate(height / 0.07) * (1.0 - ramp(height, 0.2 * cloud_top, cloud_top));
}

double height_density(const scene::CloudLayer& layer, const scene::CloudWeather& weather, double height) {
    const double h = layer.density_follows_top ? saturate(height / std::max(weather.top, least_top)) : height;
    return layer.density * h * saturate(h / 0.15) * (1.0 - ramp(h, 0.9, 1.0)) * weather.density * 2.0;
}

CloudTerms cloud_terms(const scene::CloudLayer& layer, const scene::CloudWeather& weather, double coverage,
                       double height, double base, double detail) {
    CloudTerms terms;
    terms.base = base;
    terms.coverage = coverage;
    terms.height_shape = weather.top < least_top ? 0.0 : height_shape(height, weather.top);
    terms.height_density = height_density(layer, weather, height);
    terms.shape = cut_by_coverage(base, terms.height_shape, coverage);
    terms.erosion = erosion_of(layer, height, detail);
    terms.density = eroded(terms.shape, terms.erosion) * terms.height_density;
    return terms;
}

std::shared_ptr<const CloudNoise> make_cloud_noise(scene::NoisePacking packing, int shape_size, int detail_size) {
    CloudNoise noise{make_shape_noise(shape_size), make_detail_noise(detail_size)};
    if (packing == scene::NoisePacking::packed) {
        noise = {packed_shape(noise.shape), packed_detail(noise.detail)};
    }
    return std::make_shared<const CloudNoise>(std::move(noise));
}

std::shared_ptr<const CloudNoise> normative_cloud_noise(scene::NoisePacking packing) {
    if (packing == scene::NoisePacking::packed) {
        static const auto packed = make_cloud_noise(scene::NoisePacking::packed);
        return packed;
    }
    static const auto channels = make_cloud_noise();
    return channels;
}

LinearCoverage::LinearCoverage(const NoiseTexture& shape) {
    std::vector<double> bases;
    const std::size_t stride = shape.channels;
    bases.reserve(shape.texels.size() / stride);
    for (std::size_t n = 0; n < shape.texels.size(); n += stride) {
        const float* texel = &shape.texels[n];
        bases.push_back(stride == 1 ? double(texel[0]) : base_shape({texel[0], texel[1], texel[2], texel[3]}));
    }
    std::sort(bases.begin(), bases.end(), std::greater<>());
    constexpr std::size_t pieces = 1024;
    for (std::size_t n = 0; n <= pieces; ++n) {
        quantiles_.push_back(bases[n * (bases.size() - 1) / pieces]);
    }
}

double LinearCoverage::operator()(double share) const {
    if (share <= least_coverage) {
        return 0.0;
    }
    const double at = saturate(share) * double(quantiles_.size() - 1);
    const auto low = std::min(std::size_t(at), quantiles_.size() - 2);
    return 1.0 - mix(quantiles_[low], quantiles_[low + 1], at - double(low));
}

CloudField::CloudField(const scene::CloudLayer& layer, std::shared_ptr<const scene::WeatherMap> map,
                       std::shared_ptr<const CloudNoise> noise, double time_s)
    : layer_(layer),
      map_(std::move(map)),
      noise_(std::move(noise)),
      wind_(wind_direction_world(layer)),
      drifted_(wind_ * (layer.wind_speed_m_s * time_s)),
      majorant_(largest_density()) {
    if (layer.linear_coverage) {
        linear_coverage_.emplace(noise_->shape);
    }
}

double CloudField::evaluate(const glm::dvec3& pattern_point, bool with_detail) const {
    // Each way out is exact: the terms that follow could only say 0.
    if (pattern_point.y <= layer_.bottom_m || pattern_point.y >= layer_.top_m) {
        return 0.0;
    }
    const double h = height(pattern_point);
    const scene::CloudWeather at = weather(pattern_point);
    if (at.top < least_top || h >= at.top) {
        return 0.0;
    }
    const double c = coverage(at);
    const double shape_of_height = height_shape(h, at.top);
    if (c <= least_coverage || shape_of_height <= 1.0 - c) {
        return 0.0;
    }
    const glm::dvec3 p = blown(pattern_point, h);
    const double shape = cut_by_coverage(base(p), shape_of_height, c);
    if (shape == 0.0) {
        return 0.0;
    }
    const double cut = with_detail ? eroded(shape, erosion_of(layer_, h, detail(p))) : shape;
    return cut * height_density(layer_, at, h);
}

CloudTerms CloudField::terms(const glm::dvec3& pattern_point) const {
    const double h = height(pattern_point);
    const scene::CloudWeather at = weather(pattern_point);
    const glm::dvec3 p = blown(pattern_point, h);
    return cloud_terms(layer_, at, coverage(at), h, base(p), detail(p));
}

double CloudField::largest_density() const {
    // Between the profiles' rise and their fall at 0.9 the density grows with the height, up to the highest top.
    scene::CloudWeather most = map_->largest();
    const double h = layer_.density_follows_top ? 0.9 : std::min(0.9, most.top);
    most.top = 1.0;
    return height_density(layer_, most, h);
}

scene::CloudWeather CloudField::weather(const glm::dvec3& pattern_point) const {
    const glm::dvec3 at = (pattern_point - drifted_) / layer_.weather_tile_m;
    return map_->sample(at.x, at.z);
}

double CloudField::height(const glm::dvec3& pattern_point) const {
    return saturate((pattern_point.y - layer_.bottom_m) / (layer_.top_m - layer_.bottom_m));
}

double CloudField::coverage(const scene::CloudWeather& weather) const {
    const double c = effective_coverage(layer_, weather);
    return linear_coverage_ ? (*linear_coverage_)(c) : c;
}

double CloudField::base(const glm::dvec3& blown) const {
    const glm::dvec4 at = noise_->shape.sample(blown / layer_.shape_tile_m);
    return noise_->shape.channels == 1 ? at.r : base_shape(at);
}

double CloudField::detail(const glm::dvec3& blown) const {
    const glm::dvec4 at = noise_->detail.sample(blown / layer_.detail_tile_m);
    return noise_->detail.channels == 1 ? at.r : detail_octaves(glm::dvec3(at));
}

glm::dvec3 CloudField::blown(const glm::dvec3& pattern_point, double height) const {
    return pattern_point - drifted_ - wind_ * (height * layer_.skew_m);
}

}  // namespace bruma::reference
