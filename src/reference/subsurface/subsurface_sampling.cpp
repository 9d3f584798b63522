#include "reference/subsurface/subsurface_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace bruma::reference {
namespace {

using std::numbers::pi;

glm::dvec2 polar(double rho, double turns) {
    return {rho * std::cos(2.0 * pi * turns), rho * std::sin(2.0 * pi * turns)};
}

/// sigma_tr for sampling: without absorption the tail would be infinitely long.
double tail_rate(const SubsurfaceMedium& medium, int c, double bounding_radius) {
    return std::max(diffusion_constants(medium.channel(c)).sigma_tr, 0.5e-3 / bounding_radius);
}

/// 1 - (1 + t) e^-t, the share of the exponential disk within t = sigma* rho.
double share_within(double t) {
    return -std::expm1(-t) - t * std::exp(-t);
}

}  // namespace

double radical_inverse(std::uint64_t n, unsigned base) {
    double inverse = 0.0;
    double digit_weight = 1.0 / base;
    for (; n > 0; n /= base, digit_weight /= base) {
        inverse += double(n % base) * digit_weight;
    }
    return inverse;
}

glm::dvec2 uniform_disk_point(double u, double v) {
    return polar(std::sqrt(u), v);
}

ExponentialDisk::ExponentialDisk(double rate, double radius) : rate_(rate), radius_(radius) {}

ExponentialDisk ExponentialDisk::published(const SubsurfaceMedium& medium, double bounding_radius) {
    double rate = tail_rate(medium, 0, bounding_radius);
    for (int c = 1; c < 3; ++c) {
        rate = std::min(rate, tail_rate(medium, c, bounding_radius));
    }
    return {rate, 8.0 / rate};
}

ExponentialDisk ExponentialDisk::cut_to(double bounding_radius) const {
    return {rate_, std::min(radius_, 2.0 * bounding_radius)};
}

double ExponentialDisk::normaliser() const {
    return 2.0 * pi / (rate_ * rate_) * share_within(rate_ * radius_);
}

double ExponentialDisk::pdf(glm::dvec2 d) const {
    const double rho = glm::length(d);
    return rho <= radius_ ? std::exp(-rate_ * rho) / normaliser() : 0.0;
}

glm::dvec2 ExponentialDisk::sample(double u, double v) const {
    const double end = rate_ * radius_;
    const double wanted = u * share_within(end);
    double low = 0.0;
    double high = end;
    // Newton's method kept inside a bracket; the share's slope is t e^-t.
    double t = std::min(end, std::sqrt(2.0 * wanted));
    for (int turn = 0; turn < 60 && high - low > 1e-15 * end; ++turn) {
        const double excess = share_within(t) - wanted;
        (excess > 0.0 ? high : low) = t;
        const double slope = t * std::exp(-t);
        const double newton = slope > 0.0 ? t - excess / slope : -1.0;
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - t) < 1e-15 * end) {
            break;
        }
        t = next;
    }
    return polar(t / rate_, v);
}

CoreTailDensity::CoreTailDensity(const SubsurfaceMedium& medium, double bounding_radius, double texel) {
    for (int c = 0; c < 3; ++c) {
        const double core = diffusion_constants(medium.channel(c)).sigma_t_reduced;
        rates_[std::size_t(c)] = tail_rate(medium, c, bounding_radius);
        rates_[std::size_t(c) + 3] = texel > 0.0 ? std::min(core, 2.0 / texel) : core;
    }
}

double CoreTailDensity::pdf(glm::dvec2 d) const {
    const double rho = glm::length(d);
    double sum = 0.0;
    for (const double s : rates_) {
        sum += s * std::exp(-s * rho);
    }
    return sum / 6.0 / (2.0 * pi * rho);  // infinite at rho = 0, where a sample then weighs nothing
}

glm::dvec2 CoreTailDensity::sample(double u, double v) const {
    // One number picks the rate and, stretched, the distance.
    const double scaled = 6.0 * u;
    const std::size_t pick = std::min<std::size_t>(5, std::size_t(scaled));
    const double rest = scaled - double(pick);
    return polar(-std::log1p(-std::min(rest, 1.0 - 0x1p-53)) / rates_[pick], v);
}

BackLitDensity::BackLitDensity(const SubsurfaceMedium& medium, double depth, BoundingDisk disk)
    : around_(medium, disk.radius), disk_(disk) {
    const bool is_thin = depth < 0.25 * disk.radius;
    uniform_share_ = 0.25;
    hemisphere_share_ = is_thin ? 0.0 : 0.25;
    for (std::size_t core = 3; core < 6; ++core) {
        around_.rates_[core] = std::min(around_.rates_[core], (is_thin ? 1.0 : 2.0) / depth);
    }
}

double BackLitDensity::disk_pdf(glm::dvec2 d) const {
    const double share = glm::length(d - disk_.centre) / disk_.radius;
    if (share > 1.0) {
        return 0.0;
    }
    // Infinite at the rim, where a sample then weighs nothing.
    const double slope = std::sqrt(1.0 - share * share);
    return (uniform_share_ + 0.5 * hemisphere_share_ / slope) / (pi * disk_.radius * disk_.radius);
}

double BackLitDensity::pdf(glm::dvec2 d) const {
    return disk_pdf(d) + (1.0 - uniform_share_ - hemisphere_share_) * around_.pdf(d);
}

glm::dvec2 BackLitDensity::sample(double u, double v) const {
    if (u < uniform_share_) {
        return disk_.centre + disk_.radius * uniform_disk_point(u / uniform_share_, v);
    }
    u -= uniform_share_;
    if (u < hemisphere_share_) {
        const double height = 1.0 - u / hemisphere_share_;  // uniform on a hemisphere
        return disk_.centre + disk_.radius * uniform_disk_point(1.0 - height * height, v);
    }
    return around_.sample((u - hemisphere_share_) / (1.0 - uniform_share_ - hemisphere_share_), v);
}

bool is_back_lit(const SubsurfaceMedium& medium, double depth) {
    double thinnest = 1e300;
    for (int c = 0; c < 3; ++c) {
        thinnest = std::min(thinnest, diffusion_constants(medium.channel(c)).sigma_t_reduced);
    }
    return depth > 1.0 / thinnest;
}

}  // namespace bruma::reference
