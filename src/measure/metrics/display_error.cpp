#include "measure/metrics/display_error.h"

#include <algorithm>
#include <cmath>

namespace bruma::measure {

double display_white(const Image& reference) {
    std::vector<double> brightest(reference.pixel_count());
    for (std::size_t n = 0; n < brightest.size(); ++n) {
        const float* p = &reference.rgba[4 * n];
        brightest[n] = std::max({p[0], p[1], p[2]});
    }
    const auto nth = brightest.begin() + std::ptrdiff_t(0.995 * double(brightest.size() - 1));
    std::nth_element(brightest.begin(), nth, brightest.end());
    return *nth > 0.0 ? *nth : 1.0;
}

DisplayError display_error(const Image& picture, const Image& reference, double white,
                           const std::vector<bool>& counts) {
    double squares = 0.0, sum = 0.0, count = 0.0;
    for (std::size_t n = 0; n < reference.pixel_count(); ++n) {
        if (!counts.empty() && !counts[n]) {
            continue;
        }
        for (std::size_t k = 4 * n; k < 4 * n + 3; ++k) {
            const double difference = (double(picture.rgba[k]) - double(reference.rgba[k])) / white;
            squares += difference * difference;
            sum += difference;
        }
        count += 3.0;
    }
    return count > 0.0 ? DisplayError{std::sqrt(squares / count), sum / count} : DisplayError{};
}

}  // namespace bruma::measure
