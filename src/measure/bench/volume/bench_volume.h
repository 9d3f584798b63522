#pragma once
#include <functional>
#include <string>
#include <vector>

#include "measure/bench/bench_machine.h"
#include "measure/metrics/image_error.h"
#include "scene/scene.h"

/// What a picture of a volume costs against how far it is from the truth, over the settings that trade the two.
namespace bruma::measure {

struct BenchScene {
    std::string name;
    scene::Scene scene;  ///< with a camera and its grids
};
/// Three volumes made by code, each under a transfer function with a sharp peak, which is what point samples miss.
std::vector<BenchScene> default_bench_scenes(double aspect);

struct VolumeBenchOptions {
    glm::ivec2 pixels{512, 512};
    int repeats = 3;                                   ///< rounds; in each every setting is drawn once
    bool quick = false;                                ///< fewer steps and stops
    double reference_tolerance = 1e-6;                 ///< radiance, per pixel
    std::function<void(const std::string&)> say = {};  ///< told what is being done, a line at a time
};

/// One setting of the matrix. Times are of the march alone; its tables and textures stand ready.
struct VolumeBenchRow {
    scene::RenderSettings settings;
    ImageError error;  ///< against the reference
    Duration time;     ///< medians over the rounds
    double time_over_brute =
        1.0;  ///< median of wall time over that of the paired frame without skipping or termination
    double cpu_over_brute = 1.0;
    double time_over_yardstick = 1.0;  ///< the same against the default settings, one picture for the whole scene
    double samples_per_pixel = 0.0, queries_per_pixel = 0.0;
    double skipped_share = 0.0;  ///< of the samples that the brute-force frame takes
    double table_ms = 0.0;       ///< building the transfer tables, once per step and transfer function
    bool same_bits = true;       ///< with skipping: as the picture without it
};

struct VolumeBenchScene {
    std::string name;
    double reference_rms_error = 0.0, reference_largest_error = 0.0;  ///< stated by the reference itself
    double reference_seconds = 0.0;
    Duration yardstick;  ///< default settings
    std::vector<VolumeBenchRow> rows;
};

struct VolumeBench {
    Machine machine;
    VolumeBenchOptions options;
    std::vector<VolumeBenchScene> scenes;
};
VolumeBench run_volume_bench(const std::vector<BenchScene>& scenes, const VolumeBenchOptions& options);

}  // namespace bruma::measure
