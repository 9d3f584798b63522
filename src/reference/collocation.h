#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace bruma::reference {

/// A medium at one point of a ray.
struct MediumPoint {
    double extinction = 0.0;                  ///< 1/m
    glm::dvec3 extinction_times_source{0.0};  ///< radiance per metre
};

/// What a part of a ray adds: its own radiance as seen from its front end, and its optical depth.
struct SegmentIntegral {
    glm::dvec3 radiance{0.0};
    double optical_depth = 0.0;
};

/// tau' = sigma, C' = exp(-tau) sigma S over [t0, t1] from tau = 0, C = 0 by Gauss-Legendre collocation with three
/// nodes (order 6; Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.7). The radiance is a mean
/// of S weighted at the nodes, times the opacity, and so is exact for constant S.
template <class Medium>
SegmentIntegral collocate(const Medium& medium, double t0, double t1) {
    constexpr double root15 = 3.872983346207416885179265399782;
    constexpr double node[3] = {0.5 - root15 / 10.0, 0.5, 0.5 + root15 / 10.0};
    constexpr double weight[3] = {5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0};
    constexpr double matrix[3][3] = {
        {5.0 / 36.0, 2.0 / 9.0 - root15 / 15.0, 5.0 / 36.0 - root15 / 30.0},
        {5.0 / 36.0 + root15 / 24.0, 2.0 / 9.0, 5.0 / 36.0 - root15 / 24.0},
        {5.0 / 36.0 + root15 / 30.0, 2.0 / 9.0 + root15 / 15.0, 5.0 / 36.0},
    };
    const double length = t1 - t0;
    const MediumPoint at[3] = {medium(t0 + node[0] * length), medium(t0 + node[1] * length),
                               medium(t0 + node[2] * length)};
    SegmentIntegral result;
    glm::dvec3 weighted_source(0.0);
    double weights = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double depth = length * (matrix[i][0] * at[0].extinction + matrix[i][1] * at[1].extinction +
                                       matrix[i][2] * at[2].extinction);
        const double seen = weight[i] * std::exp(-depth);
        weighted_source += seen * at[i].extinction_times_source;
        weights += seen * at[i].extinction;
        result.optical_depth += length * weight[i] * at[i].extinction;
    }
    if (weights > 0.0) {
        result.radiance = weighted_source * (-std::expm1(-result.optical_depth) / weights);
    }
    return result;
}

/// Front-to-back integral along one ray, with an estimate of its error.
class RayIntegral {
  public:
    /// Below this transmittance nothing behind can be told from rounding.
    static constexpr double smallest_transmittance = 1e-12;

    /// `tolerance` for the whole ray, in radiance; `t_length` is the length over which it is shared out. A part whose
    /// halves differ by the share `relative_tolerance` of its own radiance is good enough, however bright it is. The
    /// integral ends where less than `stop_transmittance` is left.
    RayIntegral(double tolerance, double t_length, double relative_tolerance = 1e-13,
                double stop_transmittance = smallest_transmittance)
        : tolerance_(tolerance),
          length_(t_length),
          relative_tolerance_(relative_tolerance),
          stop_transmittance_(stop_transmittance) {}

    bool stopped() const { return transmittance_ < stop_transmittance_; }

    /// Adds [t0, t1], on which the medium should be smooth, halving it until whole and halves agree.
    template <class Medium>
    void add(const Medium& medium, double t0, double t1) {
        const SegmentIntegral whole = collocate(medium, t0, t1);
        evaluations_ += 3;
        refine(medium, t0, t1, whole, 0);
    }

    glm::dvec3 radiance() const { return radiance_; }
    double transmittance() const { return transmittance_; }
    /// Sum of |whole - halves| as it reaches the eye: of the radiance and of the transmittance.
    double radiance_difference() const { return radiance_difference_; }
    double transmittance_difference() const { return relative_difference_ * transmittance_; }
    std::uint64_t evaluations() const { return evaluations_; }

  private:
    static constexpr int deepest = 40;  ///< halvings; a jump that no knot announced ends here

    template <class Medium>
    void refine(const Medium& medium, double t0, double t1, const SegmentIntegral& whole, int depth) {
        if (stopped()) {
            return;
        }
        const double middle = t0 + 0.5 * (t1 - t0);
        const SegmentIntegral front = collocate(medium, t0, middle);
        const SegmentIntegral back = collocate(medium, middle, t1);
        evaluations_ += 6;
        const double behind_front = std::exp(-front.optical_depth);
        const glm::dvec3 radiance = front.radiance + behind_front * back.radiance;
        const double optical_depth = front.optical_depth + back.optical_depth;
        const double passed = std::exp(-optical_depth);
        const glm::dvec3 apart = glm::abs(radiance - whole.radiance);
        const double of_radiance = std::max({apart.x, apart.y, apart.z});
        const double of_transmittance = std::abs(passed - std::exp(-whole.optical_depth));
        // A part of length zero still gets a share, else a jump would be halved for ever.
        const double share = std::max((t1 - t0) / length_, 1e-4) * tolerance_;
        // Beside a lamp, where radiance grows without bound, places rounded by a share of their distance shift it.
        const double floor =
            (relative_tolerance_ + 0x1p-50 * std::abs(t1) / (t1 - t0)) * std::max({radiance.x, radiance.y, radiance.z});
        const bool agree = transmittance_ * (of_radiance + of_transmittance) <= std::max(share, transmittance_ * floor);
        // In thick matter both sides may miss the bright skin and agree on nothing: split until it is thin.
        const bool thin = optical_depth <= 1.5;
        if ((agree && thin) || depth == deepest || middle <= t0 || middle >= t1) {
            const glm::dvec3 added = transmittance_ * radiance;
            radiance_ += added;
            radiance_difference_ +=
                transmittance_ * of_radiance + relative_difference_ * std::max({added.x, added.y, added.z});
            relative_difference_ += passed > 0.0 ? std::min(1.0, of_transmittance / passed) : 0.0;
            transmittance_ *= passed;
            return;
        }
        refine(medium, t0, middle, front, depth + 1);
        refine(medium, middle, t1, back, depth + 1);
    }

    double tolerance_, length_, relative_tolerance_, stop_transmittance_;
    glm::dvec3 radiance_{0.0};
    double transmittance_ = 1.0;
    double radiance_difference_ = 0.0, relative_difference_ = 0.0;
    std::uint64_t evaluations_ = 0;
};

}  // namespace bruma::reference
