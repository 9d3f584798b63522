#include "measure/bench/volume/bench_volume.h"

#include <fmt/core.h>

#include <chrono>
#include <cstring>
#include <memory>

#include "base/installation.h"
#include "measure/bench/bench_stand.h"
#include "reference/volume/emission_absorption.h"

namespace bruma::measure {
namespace {

using scene::Classification;
using scene::RenderSettings;

bool same_pixels(const Image& a, const Image& b) {
    return a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

std::vector<double> steps_of(const VolumeBenchOptions& options) {
    return options.quick ? std::vector{0.5, 1.0, 2.0} : std::vector{0.125, 0.25, 0.5, 1.0, 2.0, 4.0};
}

/// 0 means no early termination. All thresholds at the usual step; elsewhere only off and the default, since what a
/// threshold saves and costs hardly depends on the step.
std::vector<double> stops_of(const VolumeBenchOptions& options, double step) {
    if (options.quick || step != 1.0) {
        return {0.0, 1.0 / 1024.0};
    }
    return {0.0, 1.0 / 510.0, 1.0 / 1024.0, 1.0 / 6600.0};
}

/// Frames of fine steps are long and few disturbances change them much.
int rounds_of(const VolumeBenchOptions& options, double step) {
    return step < 0.5 ? (options.repeats + 1) / 2 : options.repeats;
}

/// Everything at one step and classification: the frames of one round are drawn in turn, so that whatever else the
/// machine does meets all of them alike.
class Column {
  public:
    Column(gl::ShaderLibrary& shaders, const BenchScene& scene, const Image& truth, const VolumeBenchOptions& options)
        : truth_(truth),
          options_(options),
          walker_(shaders, scene.scene, options.pixels),
          leaper_(shaders, scene.scene, options.pixels),
          yardstick_(shaders, scene.scene, options.pixels) {
        yardstick_.prepare(RenderSettings{});
    }

    std::vector<VolumeBenchRow> measure(double step, Classification classification, Duration& yardstick) {
        std::vector<Entry> entries = make_entries(step, classification);
        std::vector<double> yardstick_wall, yardstick_cpu;
        for (int round = 0; round < rounds_of(options_, step); ++round) {
            const Duration base = yardstick_.timed(RenderSettings{});
            yardstick_wall.push_back(base.wall_ms);
            yardstick_cpu.push_back(base.cpu_ms);
            Duration brute;
            for (Entry& entry : entries) {
                const Duration time = stand(entry.row.settings).timed(entry.row.settings);
                if (&entry == &entries.front()) {
                    brute = time;
                }
                entry.wall.push_back(time.wall_ms);
                entry.cpu.push_back(time.cpu_ms);
                entry.over_brute.push_back(time.wall_ms / brute.wall_ms);
                entry.cpu_over_brute.push_back(time.cpu_ms / std::max(1e-3, brute.cpu_ms));
                entry.over_yardstick.push_back(time.wall_ms / base.wall_ms);
            }
        }
        yardstick = {median(yardstick_wall), median(yardstick_cpu)};
        std::vector<VolumeBenchRow> rows;
        for (Entry& entry : entries) {
            entry.row.time = {median(entry.wall), median(entry.cpu)};
            entry.row.time_over_brute = median(entry.over_brute);
            entry.row.cpu_over_brute = median(entry.cpu_over_brute);
            entry.row.time_over_yardstick = median(entry.over_yardstick);
            rows.push_back(entry.row);
        }
        return rows;
    }

  private:
    struct Entry {
        VolumeBenchRow row;
        std::vector<double> wall, cpu, over_brute, cpu_over_brute, over_yardstick;
    };

    BenchStand& stand(const RenderSettings& settings) { return settings.empty_space_skipping ? leaper_ : walker_; }

    /// Draws each setting once for its error and its counts; the first entry is the brute-force frame.
    std::vector<Entry> make_entries(double step, Classification classification) {
        std::vector<Entry> entries;
        double brute_samples = 1.0;
        const double pixels = double(options_.pixels.x) * options_.pixels.y;
        for (const double stop : stops_of(options_, step)) {
            Image walked;
            ImageError error;
            for (const bool skip : {false, true}) {
                if (!skip && stop > 0.0 && step < 0.5) {
                    continue;  // long, and the same story as at half a voxel
                }
                VolumeBenchRow row;
                row.settings.classification = classification;
                row.settings.step = step;
                row.settings.empty_space_skipping = skip;
                row.settings.early_termination = stop > 0.0;
                row.settings.stop_transmittance = stop;
                const double table_ms = stand(row.settings).prepare(row.settings);
                table_ms_ = table_ms > 0.0 ? table_ms : table_ms_;
                row.table_ms = table_ms_;
                Image picture = stand(row.settings).picture();
                if (walked.rgba.empty()) {
                    error = compare_images(picture, truth_);
                    walked = std::move(picture);
                } else {
                    row.same_bits = same_pixels(walked, picture);
                }
                row.error = error;
                const render::SampleTotals counted = stand(row.settings).count(row.settings);
                brute_samples = entries.empty() ? double(counted.samples) : brute_samples;
                row.samples_per_pixel = counted.samples_per_pixel;
                row.queries_per_pixel = double(counted.emptiness_queries) / pixels;
                row.skipped_share = brute_samples > 0.0 ? 1.0 - double(counted.samples) / brute_samples : 0.0;
                entries.push_back({row, {}, {}, {}, {}, {}});
            }
        }
        return entries;
    }

    const Image& truth_;
    const VolumeBenchOptions& options_;
    BenchStand walker_, leaper_, yardstick_;
    double table_ms_ = 0.0;
};

}  // namespace

VolumeBench run_volume_bench(const std::vector<BenchScene>& scenes, const VolumeBenchOptions& options) {
    VolumeBench bench{describe_machine(), options, {}};
    gl::ShaderLibrary shaders(installed_folder("shaders"));
    const auto say = [&](const std::string& line) {
        if (options.say) {
            options.say(line);
        }
    };
    for (const BenchScene& scene : scenes) {
        VolumeBenchScene result;
        result.name = scene.name;
        const auto start = std::chrono::steady_clock::now();
        const reference::ReferenceImage truth = reference::render_emission_absorption(
            scene.scene, options.pixels.x, options.pixels.y, {.tolerance = options.reference_tolerance});
        result.reference_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        result.reference_rms_error = truth.rms_error;
        result.reference_largest_error = truth.largest_error;
        say(fmt::format("{}: reference in {:.1f} s, stated error at most {:.2g}, RMS {:.2g}", scene.name,
                        result.reference_seconds, truth.largest_error, truth.rms_error));
        Column column(shaders, scene, truth.image, options);
        for (const Classification classification : {Classification::post, Classification::preintegrated}) {
            for (const double step : steps_of(options)) {
                const auto rows = column.measure(step, classification, result.yardstick);
                result.rows.insert(result.rows.end(), rows.begin(), rows.end());
                say(fmt::format("{}: {}, step {} voxel: RMSE {:.3g}, {:.1f} ms, brute force {:.1f} ms", scene.name,
                                scene::enum_words<Classification>()[std::size_t(classification)], step,
                                rows.front().error.rmse, rows.back().time.wall_ms, rows.front().time.wall_ms));
            }
        }
        bench.scenes.push_back(std::move(result));
    }
    return bench;
}

}  // namespace bruma::measure
