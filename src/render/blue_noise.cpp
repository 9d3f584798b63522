#include "render/blue_noise.h"

#include <algorithm>
#include <cmath>

namespace bruma::render {
namespace {

/// Sum of Gaussians around all set pixels of a torus, kept up to date pixel by pixel.
class Energy {
  public:
    explicit Energy(int edge) : edge_(edge), kernel_(std::size_t(edge) * edge), energy_(kernel_.size(), 0.0F) {
        constexpr double sigma = 1.5;
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x) {
                const double dx = std::min(x, edge - x);
                const double dy = std::min(y, edge - y);
                kernel_[std::size_t(y) * edge + x] = float(std::exp(-(dx * dx + dy * dy) / (2.0 * sigma * sigma)));
            }
        }
    }
    void add(std::size_t pixel, float sign) {
        const int px = int(pixel) % edge_;
        const int py = int(pixel) / edge_;
        for (int y = 0; y < edge_; ++y) {
            const float* row = &kernel_[std::size_t((y - py + edge_) % edge_) * edge_];
            for (int x = 0; x < edge_; ++x) {
                energy_[std::size_t(y) * edge_ + x] += sign * row[(x - px + edge_) % edge_];
            }
        }
    }
    /// The set pixel with most energy (tightest cluster), or the unset one with least (largest void).
    std::size_t extreme(const std::vector<bool>& set, bool cluster) const {
        std::size_t best = set.size();
        for (std::size_t n = 0; n < set.size(); ++n) {
            if (set[n] == cluster &&
                (best == set.size() || (cluster ? energy_[n] > energy_[best] : energy_[n] < energy_[best]))) {
                best = n;
            }
        }
        return best;
    }

  private:
    int edge_;
    std::vector<float> kernel_, energy_;
};

}  // namespace

std::vector<std::uint16_t> make_blue_noise(int edge) {
    const std::size_t count = std::size_t(edge) * edge;
    std::vector<bool> set(count, false);
    Energy energy(edge);
    const auto flip = [&](std::size_t pixel) {
        set[pixel] = !set[pixel];
        energy.add(pixel, set[pixel] ? 1.0F : -1.0F);
    };
    // A start of one tenth by a fixed generator, then moved from cluster to void until nothing moves.
    const std::size_t start = count / 10;
    std::uint32_t state = 12345;
    for (std::size_t n = 0; n < start;) {
        state = state * 1664525U + 1013904223U;
        const std::size_t pixel = (state >> 8) % count;
        if (!set[pixel]) {
            flip(pixel);
            ++n;
        }
    }
    for (;;) {
        const std::size_t cluster = energy.extreme(set, true);
        flip(cluster);
        const std::size_t hole = energy.extreme(set, false);
        flip(hole);
        if (hole == cluster) {
            break;
        }
    }
    std::vector<std::uint16_t> rank(count, 0);
    const std::vector<bool> prototype = set;
    const Energy prototype_energy = energy;
    for (std::size_t n = start; n-- > 0;) {
        const std::size_t cluster = energy.extreme(set, true);
        rank[cluster] = std::uint16_t(n);
        flip(cluster);
    }
    set = prototype;
    energy = prototype_energy;
    for (std::size_t n = start; n < count; ++n) {
        const std::size_t hole = energy.extreme(set, false);
        rank[hole] = std::uint16_t(n);
        flip(hole);
    }
    return rank;
}

}  // namespace bruma::render
