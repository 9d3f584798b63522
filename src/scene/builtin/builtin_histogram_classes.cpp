#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene/builtin/builtin_transfer_functions.h"

namespace bruma::scene {
namespace {

constexpr int bins = 256;

/// Voxels of bins [first, past).
double count(const Histogram& h, int first, int past) {
    return double(std::accumulate(h.counts.begin() + first, h.counts.begin() + past, std::uint64_t{0}));
}

/// Mean bin of [first, past), its middle when that is empty.
double mean_bin(const Histogram& h, int first, int past) {
    double weighted = 0.0;
    for (int b = first; b < past; ++b) {
        weighted += (b + 0.5) * double(h.counts[std::size_t(b)]);
    }
    const double n = count(h, first, past);
    return n > 0.0 ? weighted / n : 0.5 * (first + past);
}

/// The first bin below which lies at least this share of all voxels.
int quantile(const Histogram& h, double share) {
    const double wanted = share * count(h, 0, bins);
    double below = 0.0;
    int b = 0;
    while (b < bins && below < wanted) {
        below += double(h.counts[std::size_t(b++)]);
    }
    return b;
}

/// The first bin above the background: where the flank of the highest peak in the lower half has fallen to a twentieth
/// or rises again, and a little more. Kept so that between a quarter and 98 % of the voxels are background, as far as
/// the fullest bin allows.
int background_end(const Histogram& h) {
    const auto peak = std::max_element(h.counts.begin(), h.counts.begin() + bins / 2);
    int end = int(peak - h.counts.begin()) + 1;
    // Bins of integer data may be empty by turns, so the flank is the sum of three.
    const auto around = [&](int b) { return count(h, std::max(0, b - 1), std::min(bins, b + 2)); };
    while (end < bins / 2 && around(end + 2) < around(end) && around(end) > 0.05 * double(*peak)) {
        ++end;
    }
    end += 8;
    return std::clamp(end, quantile(h, 0.25), std::max(quantile(h, 0.25), quantile(h, 0.98)));
}

/// Otsu's threshold of bins [first, bins): the split with the largest variance between both classes.
int otsu_split(const Histogram& h, int first) {
    double best = -1.0;
    int split = (first + bins) / 2;
    for (int s = first + 1; s < bins; ++s) {
        const double below = count(h, first, s);
        const double above = count(h, s, bins);
        const double apart = mean_bin(h, s, bins) - mean_bin(h, first, s);
        if (below > 0.0 && above > 0.0 && below * above * apart * apart > best) {
            best = below * above * apart * apart;
            split = s;
        }
    }
    return split;
}

/// Opacity per voxel that leaves exp(-optical_depth) of the light after `voxels`.
double opacity_over(double optical_depth, double voxels) {
    return -std::expm1(-optical_depth / std::max(1.0, voxels));
}

/// A constant has no structure to show: its box stays, three quarters transparent along its longest edge.
TransferFunction haze(const VolumeGrid& grid) {
    TransferFunction tf;
    const glm::dvec3 extent = grid.extent();
    tf.window = {grid.smallest - 0.5, grid.smallest + 0.5};
    tf.reference_length = std::max({extent.x, extent.y, extent.z});
    tf.opacity = {{0.0, 0.25}};
    tf.color = {{0.0, glm::dvec3(0.3)}};
    return tf;
}

}  // namespace

TransferFunction transfer_function_of_histogram(const VolumeGrid& grid) {
    if (grid.smallest == grid.largest) {
        return haze(grid);
    }
    // Few values of 8 bits are far from the others: all of them are shown.
    const std::array<double, 2> range{grid.smallest, grid.largest};
    const std::array<double, 2> window = bytes_per_voxel(grid.type) == 1 ? range : grid.suggested_window;
    const Histogram h = histogram(grid, bins, window);
    const int start = std::min(background_end(h), bins - 3);
    const int split = std::clamp(otsu_split(h, start), start + 1, bins - 1);
    const double soft = mean_bin(h, start, split);
    const double dense = mean_bin(h, split, bins);

    // How far light travels in each class, in voxels, if its voxels lay together in one lump.
    const double soft_length = std::cbrt(count(h, start, bins));
    const double dense_length = std::cbrt(count(h, split, bins));
    const double veil = std::min(0.2, opacity_over(2.4, soft_length));
    const double firm = std::clamp(opacity_over(16.0, dense_length), 0.1, 0.6);

    const auto at = [](double bin) { return bin / bins; };
    const double between = 0.5 * (soft + split);
    TransferFunction tf;
    if (window != range) {
        tf.window = window;
    }
    tf.reference_length = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    tf.opacity = {{at(0.0), 0.0},
                  {at(start), 0.0},
                  {at(0.5 * (start + soft)), 0.6 * veil},
                  {at(soft), veil},
                  {at(between), 1.5 * veil},
                  {at(split), 0.3 * firm},
                  {at(dense), firm},
                  {1.0, std::min(0.9, 1.5 * firm)}};
    tf.color = {{at(start), {0.04, 0.16, 0.36}}, {at(0.5 * (start + soft)), {0.12, 0.32, 0.20}},
                {at(soft), {0.38, 0.32, 0.16}},  {at(between), {0.52, 0.30, 0.13}},
                {at(split), {0.64, 0.33, 0.13}}, {at(dense), {0.86, 0.68, 0.45}},
                {1.0, {1.0, 0.95, 0.86}}};
    normalise(tf);
    return tf;
}

}  // namespace bruma::scene
