#include "reference/clouds/cloud_medium.h"

#include <algorithm>

namespace bruma::reference {

CloudMedium medium_of(const CloudField& field, const CloudGeometry& geometry, const scene::CloudOptics& optics) {
    return {geometry, [field](const glm::dvec3& at) { return field.density(at); }, field.majorant(), optics};
}

std::vector<CloudStretch> stretches(std::span<const CloudMedium> media, const glm::dvec3& origin_world,
                                    const glm::dvec3& direction_world, double longest_m) {
    struct Part {
        const CloudMedium* medium;
        Interval<double> interval;
    };
    std::vector<Part> parts;
    std::vector<double> cuts;
    for (const CloudMedium& medium : media) {
        const auto intervals = medium.geometry.intervals(origin_world, direction_world);
        for (int n = 0; n < intervals.count; ++n) {
            Interval<double> interval = intervals.parts[std::size_t(n)];
            interval.end = std::min(interval.end, longest_m);
            if (interval.end > interval.begin) {
                parts.push_back({&medium, interval});
                cuts.insert(cuts.end(), {interval.begin, interval.end});
            }
        }
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<CloudStretch> result;
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
        CloudStretch stretch{cuts[n], cuts[n + 1], {}};
        for (const Part& part : parts) {
            if (part.interval.begin <= stretch.begin_m && part.interval.end >= stretch.end_m) {
                stretch.media.push_back(part.medium);
            }
        }
        if (stretch.end_m > stretch.begin_m && !stretch.media.empty()) {
            result.push_back(std::move(stretch));
        }
    }
    return result;
}

}  // namespace bruma::reference
