#pragma once
#include <string>
#include <vector>

#include "measure/bench/volume/bench_volume.h"

/// What the rows of a bench say, in numbers and in one sentence each. All interpolation is linear between logarithms.
namespace bruma::measure {

/// Transmittance at which rays end by default.
inline constexpr double default_stop = 1.0 / 1024.0;

/// Rows of one classification in order of step, with the given skipping and stop (0: no early termination).
std::vector<VolumeBenchRow> rows_by_step(const VolumeBenchScene& scene, scene::Classification classification, bool skip,
                                         double stop);

struct Fit {
    double order = 0.0;  ///< error ~ factor * step^order
    double factor = 0.0;
    int points = 0;  ///< that it stands on; fewer than 2 is no fit
};
/// Least squares of log RMSE on log step, over errors above `floor`, where rounding and tables do not show.
Fit fit_order(const std::vector<VolumeBenchRow>& rows, double floor = 1e-5);

/// 'post-classification needs a step of 0.21 voxel and 3.4 x the time for the error that pre-integration has at one
/// voxel', or what is true instead.
std::string finding_time(const VolumeBenchScene& scene);
std::string finding_samples(const VolumeBenchScene& scene);
std::string finding_order(const VolumeBenchScene& scene);
std::string finding_savings(const VolumeBenchScene& scene);

}  // namespace bruma::measure
