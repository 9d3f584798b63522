#include "measure/bench/light/bench_light_costs.h"

#include "measure/bench/light/light_stand.h"

namespace bruma::measure {
namespace {

/// Multiplies the extinction so that a veil becomes a surface.
constexpr double nearly_opaque = 20.0;

LightBuildRow measure_build(LightStand& lit, LightStand& frame, LightProvider provider,
                            const LightBenchOptions& options) {
    lit.set(provider, {});
    lit.picture(options.pixels);
    std::vector<double> builds, frames, ratios;
    for (int n = 0; n < options.repeats; ++n) {
        const double frame_ms = frame.draw_ms(options.frame_pixels);
        const double build_ms = lit.after_light_change(options.pixels).build_ms;
        builds.push_back(build_ms);
        frames.push_back(frame_ms);
        ratios.push_back(build_ms / frame_ms);
    }
    LightBuildRow row;
    row.diffuse = provider == LightProvider::diffuse;
    row.build_ms = median(builds);
    row.frame_ms = median(frames);
    row.ratio = median(ratios);
    return row;
}

}  // namespace

std::vector<LightBatchRow> measure_batches(gl::ShaderLibrary& shaders, const BenchScene& scene,
                                           const LightBenchOptions& options) {
    LightStand stand(shaders, scene.scene);
    std::vector<LightBatchRow> rows;
    for (const bool diffuse : {false, true}) {
        for (const scene::LightResolution resolution :
             {scene::LightResolution::full, scene::LightResolution::half, scene::LightResolution::quarter}) {
            std::vector<LightBatchRow> group;
            std::vector<std::vector<double>> times, ratios;
            for (const int slices : {1, 4, 16, 0}) {
                group.push_back({stand.grid_cells(1 << int(resolution)), diffuse, slices, 0, 0.0, 1.0});
            }
            times.resize(group.size());
            ratios.resize(group.size());
            for (int round = -1; round < 2 * options.repeats; ++round) {  // the first compiles
                for (std::size_t n = 0; n < group.size(); ++n) {
                    scene::LightVolumeSettings settings;
                    settings.resolution = resolution;
                    settings.slices_per_dispatch = group[n].slices_per_dispatch;
                    stand.set(diffuse ? LightProvider::diffuse : LightProvider::direct, settings);
                    const LightTimes built = stand.after_light_change({16, 16});
                    group[n].dispatches = built.dispatches;
                    if (round >= 0) {
                        times[n].push_back(built.build_ms);
                        ratios[n].push_back(built.build_ms / times[0].back());
                    }
                }
            }
            for (std::size_t n = 0; n < group.size(); ++n) {
                group[n].ms = median(times[n]);
                group[n].over_one = median(ratios[n]);
            }
            rows.insert(rows.end(), group.begin(), group.end());
        }
    }
    return rows;
}

std::vector<LightBuildRow> measure_builds(gl::ShaderLibrary& shaders, const std::vector<BenchScene>& scenes,
                                          const LightBenchOptions& options) {
    std::vector<LightBuildRow> rows;
    for (const BenchScene& scene : scenes) {
        if (scene::has_position(*scene.scene.lights.begin()->second)) {
            continue;
        }
        for (const double density : {1.0, nearly_opaque}) {
            LightStand lit(shaders, scene.scene), frame(shaders, scene.scene);
            lit.multiply_density(density);
            frame.multiply_density(density);
            frame.set_unlit();
            frame.picture(options.frame_pixels);
            for (const LightProvider provider : {LightProvider::direct, LightProvider::diffuse}) {
                LightBuildRow row = measure_build(lit, frame, provider, options);
                row.scene = scene.name;
                row.transfer_function = density == 1.0 ? "suggested" : "nearly opaque";
                rows.push_back(row);
            }
        }
    }
    return rows;
}

}  // namespace bruma::measure
