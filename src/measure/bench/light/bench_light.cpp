#include "measure/bench/light/bench_light.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "base/installation.h"
#include "measure/bench/light/bench_light_costs.h"
#include "measure/bench/light/light_stand.h"
#include "reference/medium/render_scattering.h"

namespace bruma::measure {
namespace {

using scene::LightResolution;

constexpr std::array providers{LightProvider::direct, LightProvider::diffuse, LightProvider::paper,
                               LightProvider::shadow_rays};

double mean_of(const Image& image) {
    double sum = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        sum += double(image.rgba[4 * n]) + image.rgba[4 * n + 1] + image.rgba[4 * n + 2];
    }
    return sum / (3.0 * double(image.pixel_count()));
}

struct Truth {
    reference::ScatteringImage single, multiple;
};

Truth find_truth(const scene::Scene& scene, const LightBenchOptions& options, LightBenchScene& result) {
    scene::Scene scattering = scene;
    auto& volume = std::get<scene::Volume>(scattering.nodes.at(scene::shown_volumes(scene).front()).content);
    volume.optics.edit([](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::path_traced; });
    const auto start = std::chrono::steady_clock::now();
    const glm::ivec2 pixels = options.pixels;
    Truth truth{
        reference::render_scattering(
            scattering, pixels.x, pixels.y,
            {.paths = reference::LightPaths::single, .tolerance = options.reference_tolerance}),
        reference::render_scattering(scattering, pixels.x, pixels.y,
                                     {.paths = reference::LightPaths::multiple, .samples = options.reference_samples})};
    result.reference_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.single_white = display_white(truth.single.image);
    result.multiple_white = display_white(truth.multiple.image);
    result.single_rms_error = truth.single.rms_error / result.single_white;
    result.multiple_rms_error = truth.multiple.rms_error / result.multiple_white;
    double variance = 0.0;  // channels of a pixel share their paths: as if they were one number
    for (const glm::vec3 error : truth.multiple.error) {
        const double sum = double(error.x) + error.y + error.z;
        variance += sum * sum / 9.0;
    }
    result.multiple_bias_error = std::sqrt(variance) / double(truth.multiple.error.size()) / result.multiple_white;
    result.single_share = mean_of(truth.single.image) / std::max(1e-300, mean_of(truth.multiple.image));
    return truth;
}

/// All rows of one scene. Frames of emission and absorption alternate with those that are compared to them, so that
/// whatever else the machine does meets both alike.
class Matrix {
  public:
    Matrix(gl::ShaderLibrary& shaders, const BenchScene& scene, const LightBenchOptions& options)
        : options_(options), lit_(shaders, scene.scene), frame_(shaders, scene.scene), small_(shaders, scene.scene) {
        for (LightStand* stand : {&frame_, &small_}) {
            stand->set_unlit();
        }
        frame_.picture(options.frame_pixels);
        small_.picture(options.pixels);
    }

    void measure(const Truth& truth, LightBenchScene& result) {
        for (const LightProvider provider : providers) {
            for (const LightResolution resolution : resolutions()) {
                std::optional<LightBenchRow> built;
                for (const int near_steps : {0, 2}) {
                    LightBenchRow row;
                    row.provider = provider;
                    row.settings.resolution = resolution;
                    row.settings.near_steps = near_steps;
                    lit_.set(provider, row.settings);
                    const Image picture = lit_.picture(options_.pixels);
                    row.single = display_error(picture, truth.single.image, result.single_white);
                    row.multiple = display_error(picture, truth.multiple.image, result.multiple_white);
                    row.cells = lit_.cells();
                    row.megabytes = lit_.megabytes();
                    if (built) {  // the lookup's samples change nothing of the light itself
                        row.build_ms = built->build_ms;
                        row.build_over_frame = built->build_over_frame;
                        row.dispatches = built->dispatches;
                    } else {
                        time_build(row);
                    }
                    time_draw(row);
                    built = row;
                    result.rows.push_back(row);
                }
            }
        }
        result.frame_ms = median(frames_ms_);
        result.small_frame_ms = median(small_frames_ms_);
    }

  private:
    std::vector<LightResolution> resolutions() const {
        return options_.quick ? std::vector{LightResolution::half, LightResolution::quarter}
                              : std::vector{LightResolution::full, LightResolution::half, LightResolution::quarter};
    }

    void time_build(LightBenchRow& row) {
        std::vector<double> builds, ratios;
        double spent_ms = 0.0;
        for (int n = 0; n < options_.repeats && spent_ms < enough_ms; ++n) {
            const double frame = frame_.draw_ms(options_.frame_pixels);
            // A long build is not repeated: what compiling and the rest of the machine add is small beside it.
            const bool long_build = n == 0 && lit_.first_times().build_ms > enough_ms;
            const LightTimes times = long_build ? lit_.first_times() : lit_.after_light_change(options_.pixels);
            frames_ms_.push_back(frame);
            builds.push_back(times.build_ms);
            ratios.push_back(times.build_ms / frame);
            row.dispatches = times.dispatches;
            spent_ms += frame + times.build_ms;
        }
        row.build_ms = median(builds);
        row.build_over_frame = median(ratios);
    }

    void time_draw(LightBenchRow& row) {
        std::vector<double> draws, ratios;
        for (int n = 0; n < options_.repeats; ++n) {
            const double frame = small_.draw_ms(options_.pixels);
            const double draw = lit_.draw_ms(options_.pixels);
            small_frames_ms_.push_back(frame);
            draws.push_back(draw);
            ratios.push_back(draw / frame);
        }
        row.draw_ms = median(draws);
        row.draw_over_frame = median(ratios);
    }

    static constexpr double enough_ms = 2000.0;
    const LightBenchOptions& options_;
    LightStand lit_, frame_, small_;
    std::vector<double> frames_ms_, small_frames_ms_;
};

}  // namespace

std::string_view words_of(LightProvider provider) {
    switch (provider) {
        case LightProvider::direct:
            return "physical, direct";
        case LightProvider::diffuse:
            return "physical, diffuse";
        case LightProvider::paper:
            return "paper";
        case LightProvider::shadow_rays:
            break;
    }
    return "shadow rays";
}

LightBench run_light_bench(const std::vector<BenchScene>& scenes, const LightBenchOptions& options) {
    LightBench bench{describe_machine(), options, {}, {}, {}};
    gl::ShaderLibrary shaders(installed_folder("shaders"));
    const auto say = [&](const std::string& line) {
        if (options.say) {
            options.say(line);
        }
    };
    for (const BenchScene& scene : scenes) {
        LightBenchScene result;
        result.name = scene.name;
        const Truth truth = find_truth(scene.scene, options, result);
        say(fmt::format("{}: references in {:.1f} s; single scattering is {:.0f} % of the light", scene.name,
                        result.reference_seconds, 100.0 * result.single_share));
        Matrix(shaders, scene, options).measure(truth, result);
        for (const LightBenchRow& row : result.rows) {
            say(fmt::format("{}: {}, {}, near steps {}: RMSE {:.3f}, bias {:+.3f}, build {:.2f}, draw {:.2f}",
                            scene.name, words_of(row.provider),
                            scene::enum_words<LightResolution>()[std::size_t(row.settings.resolution)],
                            row.settings.near_steps, row.single.rmse, row.multiple.bias, row.build_over_frame,
                            row.draw_over_frame));
        }
        bench.scenes.push_back(std::move(result));
    }
    bench.batches = measure_batches(shaders, scenes.front(), options);
    bench.builds = measure_builds(shaders, scenes, options);
    return bench;
}

}  // namespace bruma::measure
