#include "reference/volume/transmittance.h"

#include <algorithm>
#include <cmath>

#include "reference/volume/piece_walk.h"

namespace bruma::reference {
namespace {

struct Depth {
    double value;  ///< optical depth
    double error;  ///< estimated
};

/// Gauss' rules with one and with three nodes share the middle. Where their results differ by the share e, the second
/// derivative makes up e, and the sixth, which is all that the three nodes miss, some e^3 / 150 of it.
Depth gauss(const PieceWalk& walk, double t0, double t1) {
    constexpr double off_middle = 0.38729833462074168851792653997824;  // sqrt(15) / 10
    const PreparedVolume& volume = walk.volume();
    const auto extinction = [&](double x) {
        return volume.curves.at(*walk.piece().stretch, walk.u_at(t0 + x * (t1 - t0))).extinction;
    };
    const double middle = extinction(0.5);
    const double mean = (5.0 * extinction(0.5 - off_middle) + 8.0 * middle + 5.0 * extinction(0.5 + off_middle)) / 18.0;
    const double share = mean > 0.0 ? std::min(1.0, std::abs(mean - middle) / mean) : 0.0;
    return {mean * (t1 - t0), mean * (t1 - t0) * share * share * share};
}

/// Adds up one volume's optical depth along a ray.
class DepthIntegral {
  public:
    DepthIntegral(double tolerance, double length, double largest_depth)
        : tolerance_(tolerance), length_(length), largest_depth_(largest_depth) {}

    void add(const PieceWalk& walk, double t0, double t1, int level = 0) {
        constexpr int deepest = 40;
        const Depth depth = gauss(walk, t0, t1);
        evaluations += 3;
        const double share = std::max((t1 - t0) / length_, 1e-4) * tolerance_;
        const double middle = t0 + 0.5 * (t1 - t0);
        const bool good = std::exp(-value) * std::min(1.0, depth.error) <= share;
        if (good || level == deepest || middle <= t0 || middle >= t1) {
            value += depth.value;
            error += depth.error;
            return;
        }
        add(walk, t0, middle, level + 1);
        if (!opaque()) {
            add(walk, middle, t1, level + 1);
        }
    }
    bool opaque() const { return value > largest_depth_; }

    double value = 0.0, error = 0.0;
    std::uint64_t evaluations = 0;

  private:
    double tolerance_, length_, largest_depth_;
};

}  // namespace

Transmittance transmittance(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, double t_far,
                            double tolerance, double negligible, bool leap) {
    const double largest_depth = -std::log(negligible);
    double depth = 0.0;
    Transmittance result;
    for (const PreparedVolume& volume : volumes) {
        PieceWalk walk(volume, ray, leap, t_far);
        DepthIntegral integral(tolerance, walk.t_out() - walk.t_in(), largest_depth - depth);
        for (; !walk.finished() && !integral.opaque(); walk.advance()) {
            integral.add(walk, walk.piece().t0, walk.piece().t1);
        }
        depth += integral.value;
        result.error += integral.error;
        result.evaluations += integral.evaluations;
        if (depth > largest_depth) {
            return {0.0, negligible, result.evaluations};
        }
    }
    result.value = std::exp(-depth);
    result.error = result.value * std::expm1(std::min(result.error, 50.0));
    return result;
}

}  // namespace bruma::reference
