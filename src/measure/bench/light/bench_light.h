#pragma once
#include "measure/bench/volume/bench_volume.h"
#include "measure/metrics/display_error.h"

/// What light inside of volumes costs and how far it is from the truth, over the ways to compute it.
namespace bruma::measure {

/// The ways: `direct` and `diffuse` are the physical light volume without and with light scattered more than once.
enum class LightProvider { direct, diffuse, paper, shadow_rays };
std::string_view words_of(LightProvider provider);

/// Three volumes made by code in black surroundings, scattering white light: a cluster of molecules and dense kernels
/// under parallel light, the first once more with g = 0.7, the second by a point light beside it.
std::vector<BenchScene> default_light_scenes(double aspect);
/// Gives a scene what the suite asks of all: black surroundings, and parallel light in place of its own.
void make_light_scene(scene::Scene& scene);

struct LightBenchOptions {
    glm::ivec2 pixels{96, 96};          ///< of the pictures that are compared, and of the draws that are timed
    glm::ivec2 frame_pixels{512, 512};  ///< of the emission-absorption frame that is the unit of building
    int repeats = 3;
    bool quick = false;                 ///< without full resolution
    double reference_tolerance = 1e-3;  ///< radiance, per pixel, of single scattering
    int reference_samples = 256;        ///< paths per pixel of multiple scattering
    std::function<void(const std::string&)> say = {};
};

struct LightBenchRow {
    LightProvider provider = LightProvider::direct;
    scene::LightVolumeSettings settings;
    DisplayError single, multiple;
    double build_ms = 0.0;          ///< light after a change of its direction or place; the medium stands ready
    double build_over_frame = 0.0;  ///< against an emission-absorption frame of `frame_pixels`
    double draw_ms = 0.0;
    double draw_over_frame = 0.0;  ///< against an emission-absorption frame of `pixels`
    int dispatches = 0;            ///< of one build
    std::int64_t cells = 0;        ///< of direct light
    double megabytes = 0.0;        ///< light and its medium as they are kept; without the scratch of the sweep
};

struct LightBenchScene {
    std::string name;
    double single_white = 1.0, multiple_white = 1.0;  ///< radiance that is display range: 99.5th percentile
    double single_rms_error = 0.0;                    ///< stated by the reference; display range
    double multiple_rms_error = 0.0;                  ///< standard error of a pixel, RMS; display range
    double multiple_bias_error = 0.0;                 ///< standard error of the mean of all pixels; display range
    double single_share = 0.0;                        ///< light scattered once, of all scattered light
    double reference_seconds = 0.0;
    double frame_ms = 0.0;        ///< emission-absorption at `frame_pixels`, median
    double small_frame_ms = 0.0;  ///< at `pixels`
    std::vector<LightBenchRow> rows;
};

/// The same sweep in launches of several slices.
struct LightBatchRow {
    glm::ivec3 cells{0};
    bool diffuse = false;
    int slices_per_dispatch = 0;  ///< 0: chosen
    int dispatches = 0;
    double ms = 0.0;
    double over_one = 1.0;  ///< median ratio to launches of one slice
};

/// Building the usual light volume (half resolution) after its light has changed.
struct LightBuildRow {
    std::string scene, transfer_function;
    bool diffuse = false;
    double build_ms = 0.0, frame_ms = 0.0;
    double ratio = 0.0;  ///< median, against an emission-absorption frame of `frame_pixels`
};
/// Building after a light has changed is to take at most this many frames.
inline constexpr double most_build_frames = 4.0;
/// RMSE against single scattering that direct light at half resolution must keep, display range 1, g = 0.
inline constexpr double most_single_rmse = 0.02;

struct LightBench {
    Machine machine;
    LightBenchOptions options;
    std::vector<LightBenchScene> scenes;
    std::vector<LightBatchRow> batches;
    std::vector<LightBuildRow> builds;
};
LightBench run_light_bench(const std::vector<BenchScene>& scenes, const LightBenchOptions& options);

}  // namespace bruma::measure
