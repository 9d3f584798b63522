#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "measure/bench/light/bench_light_report.h"

namespace bruma::measure {

using scene::LightResolution;

const LightBenchRow* row_of(const LightBenchScene& scene, LightProvider provider, LightResolution resolution,
                            std::int64_t near_steps) {
    const auto found = std::find_if(scene.rows.begin(), scene.rows.end(), [&](const LightBenchRow& row) {
        return row.provider == provider && row.settings.resolution == resolution &&
               row.settings.near_steps == near_steps;
    });
    return found == scene.rows.end() ? nullptr : &*found;
}

std::string finding_single(const LightBenchScene& scene) {
    const LightBenchRow* near = row_of(scene, LightProvider::direct, LightResolution::half, 2);
    const LightBenchRow* bare = row_of(scene, LightProvider::direct, LightResolution::half, 0);
    const LightBenchRow* rays = row_of(scene, LightProvider::shadow_rays, LightResolution::half, 2);
    if (!near || !bare || !rays) {
        return "too few settings were measured";
    }
    return fmt::format(
        "direct light at half resolution is {:.4f} (RMSE) from single scattering, {} {:g} of display range; {:.4f} "
        "without near steps, {:.4f} with a shadow ray for each cell",
        near->single.rmse, near->single.rmse <= most_single_rmse ? "within" : "beyond", most_single_rmse,
        bare->single.rmse, rays->single.rmse);
}

std::string finding_multiple(const LightBenchScene& scene) {
    if (scene.rows.empty()) {
        return "nothing was measured";
    }
    const auto nearest = std::min_element(
        scene.rows.begin(), scene.rows.end(),
        [](const LightBenchRow& a, const LightBenchRow& b) { return a.multiple.rmse < b.multiple.rmse; });
    return fmt::format(
        "single scattering is {:.0f} % of the light; nearest to all of it comes {} at {} resolution with {} near "
        "steps: "
        "RMSE {:.3f}, bias {:+.3f} (its standard error {:.1g})",
        100.0 * scene.single_share, words_of(nearest->provider),
        scene::enum_words<LightResolution>()[std::size_t(nearest->settings.resolution)], nearest->settings.near_steps,
        nearest->multiple.rmse, nearest->multiple.bias, scene.multiple_bias_error);
}

std::string finding_cost(const LightBenchScene& scene) {
    const LightBenchRow* usual = row_of(scene, LightProvider::diffuse, LightResolution::half, 2);
    if (!usual) {
        return "too few settings were measured";
    }
    return fmt::format(
        "the usual light volume (half resolution, diffuse) is built in {:.2f} frames of emission and absorption, and a "
        "picture with it takes {:.2f} times as long as one of those",
        usual->build_over_frame, usual->draw_over_frame);
}

std::string finding_build(const LightBuildRow& row) {
    return fmt::format(
        "{}, {} transfer function, {}: after a change of the light it is built anew in {:.2f} frames ({:.0f} ms; a "
        "frame {:.0f} ms), {} {:g}",
        row.scene, row.transfer_function, row.diffuse ? "with diffuse light" : "direct light only", row.ratio,
        row.build_ms, row.frame_ms, row.ratio <= most_build_frames ? "within" : "beyond", most_build_frames);
}

std::string finding_batches(const LightBench& bench) {
    const LightBatchRow* best = nullptr;
    for (const LightBatchRow& row : bench.batches) {
        if (row.slices_per_dispatch == 0 && (!best || row.over_one < best->over_one)) {
            best = &row;
        }
    }
    if (!best) {
        return "no launches were measured";
    }
    return fmt::format(
        "launches as the program chooses them take {:.0f} % of the time of launches of one slice at best ({} x {} x {} "
        "cells{})",
        100.0 * best->over_one, best->cells.x, best->cells.y, best->cells.z,
        best->diffuse ? ", with diffuse light" : "");
}

}  // namespace bruma::measure
