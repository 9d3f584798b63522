#include "app/panels/volume/volume_histogram.h"

#include <algorithm>
#include <cmath>

namespace bruma::app {

void VolumeHistogram::update(const std::shared_ptr<const scene::VolumeGrid>& grid) {
    if (grid == grid_) {
        return;
    }
    grid_ = grid;
    counted_ = scene::histogram(*grid, bins, grid->core);
    fullest_ = 1.0;
    for (std::size_t n = 1; n + 1 < counted_.counts.size(); ++n) {
        fullest_ = std::max(fullest_, double(counted_.counts[n]));
    }
}

double VolumeHistogram::height(double low, double high, bool logarithmic) const {
    const double width = counted_.largest - counted_.smallest;
    const auto count = std::ptrdiff_t(counted_.counts.size());
    if (!(width > 0.0) || count == 0 || high < counted_.smallest || low > counted_.largest) {
        return 0.0;
    }
    const auto bin = [&](double value) {
        const double place = std::clamp((value - counted_.smallest) / width, 0.0, 1.0);
        return std::min(count - 1, std::ptrdiff_t(place * double(count)));
    };
    const auto most = *std::max_element(counted_.counts.begin() + bin(low), counted_.counts.begin() + bin(high) + 1);
    const double share = logarithmic ? std::log1p(double(most)) / std::log1p(fullest_) : double(most) / fullest_;
    return std::min(1.0, share);
}

}  // namespace bruma::app
