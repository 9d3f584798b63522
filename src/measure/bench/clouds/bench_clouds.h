#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "measure/bench/bench_machine.h"
#include "scene/scene.h"

/// What clouds cost and how far their pictures are from the truth, over the techniques of the march, and what
/// reprojection saves and costs.
namespace bruma::measure {

struct CloudBenchOptions {
    glm::ivec2 pixels{512, 288};
    int truth_pixels = 512;         ///< of them spread over the picture are compared with the truth, which is slow
    glm::ivec2 bias_pixels{16, 9};  ///< of the pictures by random paths
    int repeats = 3;
    std::uint32_t paths = 64;  ///< for each pixel, to judge the model of light by; 0: it is not judged
    std::string only;          ///< views whose 'PRESET VIEW' holds these words; empty: all
    bool quick = false;        ///< from below, if `only` names nothing, and no other steps
    std::function<void(const std::string&)> say = {};
    std::function<scene::Scene(const scene::Scene&)> change = {};  ///< what is to be different in every scene
    std::function<void(const struct CloudBench&)> keep = {};       ///< told after each view what there is so far
};

/// Of some pixels of a picture, in linear light of display range 1: what is brighter counts as 1.
struct SpreadError {
    double rmse = 0.0;
    double standard_error = 0.0;  ///< of the RMSE, since these are not all pixels
    double relative_rmse = 0.0;
    double bias = 0.0;  ///< signed mean
};
/// Indices of pixels that are spread evenly (the R2 sequence of Roberts 2018), always the same ones, each once.
std::vector<std::size_t> spread_pixels(glm::ivec2 pixels, int count);
SpreadError error_at(const std::vector<std::size_t>& places, const Image& found, const Image& truth);

/// One set of techniques on one view of one preset.
struct CloudBenchRow {
    std::string technique;
    double step_m = 0.0;  ///< shortest segment
    SpreadError error = {};
    double ms = 0.0, cpu_ms = 0.0;                                ///< of a frame whose view alone is new, median
    double turns = 0.0, weather = 0.0, noise = 0.0, light = 0.0;  ///< lookups per pixel
};

/// A pan with reprojection, against full frames of the same moments.
struct CloudPan {
    double full_ms = 0.0, ms = 0.0;  ///< median of the frames
    double full_cpu_ms = 0.0, cpu_ms = 0.0;
    double rmse_in_motion = 0.0;  ///< largest of frames 8, 16, 24 and 32, from full ones of the same moments
    double rmse_at_rest = 0.0;    ///< after 16 more frames without motion
    double flicker = 0.0;         ///< deviation of a pixel over 64 frames at rest, RMS
};

/// Light scattered more than once, as drawn, against light that is scattered any number of times, in the radiance that
/// clouds add. Green of all pixels of a picture.
struct CloudBias {
    double modelled = 0.0, paths = 0.0;  ///< means over the picture
    double standard_error = 0.0;         ///< of `paths`
    double rms = 0.0;                    ///< difference of single pixels, the noise of the paths taken off
};
/// By the double-precision march and by random paths, which know no sky but the constant environment.
CloudBias multiple_scattering_bias(scene::Scene scene, glm::ivec2 pixels, std::uint32_t samples);

struct CloudBenchScene {
    std::string preset, view;
    double reference_seconds = 0.0;
    std::vector<CloudBenchRow> rows;  ///< all techniques for each length of steps; the first one has the usual settings
    CloudPan pan;
    CloudBias bias = {};
};

struct CloudBench {
    Machine machine;
    CloudBenchOptions options;
    std::vector<CloudBenchScene> scenes;
};

/// A preset seen from below, from inside or from above the layer.
scene::Scene cloud_view(scene::CloudType type, const std::string& view);

/// Throws InputError when `only` names no view.
CloudBench run_cloud_bench(const CloudBenchOptions& options);
/// clouds.csv, clouds.json and clouds.html.
void write_cloud_bench(const CloudBench& bench, const std::filesystem::path& folder);
/// One sentence of a scene: error, time and lookups of the usual settings, and what reprojection does.
std::string finding(const CloudBenchScene& scene);
/// How far light scattered more than once is from the truth.
std::string finding_bias(const CloudBenchScene& scene);
/// What a scene costs beside another at the same error, in lookups of noise and light per pixel: on the lines through
/// the usual settings with steps of all lengths. Nothing where one of them never is that near.
std::optional<double> cost_beside(const CloudBenchScene& scene, const CloudBenchScene& other, double rmse);

}  // namespace bruma::measure
