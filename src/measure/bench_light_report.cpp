#include "measure/bench_light_report.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"

namespace bruma::measure {
namespace {

std::string_view resolution_of(const LightBenchRow& row) {
    return scene::enum_words<scene::LightResolution>()[std::size_t(row.settings.resolution)];
}

/// JSON knows no infinity.
nlohmann::json number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json json_of_row(const LightBenchRow& row) {
    return {{"way", words_of(row.provider)},
            {"resolution", resolution_of(row)},
            {"near_steps", row.settings.near_steps},
            {"rmse_single", number(row.single.rmse)},
            {"bias_single", number(row.single.bias)},
            {"rmse_multiple", number(row.multiple.rmse)},
            {"bias_multiple", number(row.multiple.bias)},
            {"build_ms", row.build_ms},
            {"build_over_frame", row.build_over_frame},
            {"draw_ms", row.draw_ms},
            {"draw_over_frame", row.draw_over_frame},
            {"dispatches", row.dispatches},
            {"cells", row.cells},
            {"megabytes", row.megabytes}};
}

nlohmann::json json_of_scene(const LightBenchScene& scene) {
    nlohmann::json rows = nlohmann::json::array();
    for (const LightBenchRow& row : scene.rows) {
        rows.push_back(json_of_row(row));
    }
    return {{"name", scene.name},
            {"reference",
             {{"display_range_single", scene.single_white},
              {"display_range_multiple", scene.multiple_white},
              {"rms_error_single", scene.single_rms_error},
              {"standard_error_multiple", scene.multiple_rms_error},
              {"standard_error_of_bias", scene.multiple_bias_error},
              {"single_share", scene.single_share},
              {"seconds", scene.reference_seconds}}},
            {"frame_ms", scene.frame_ms},
            {"small_frame_ms", scene.small_frame_ms},
            {"findings", {finding_single(scene), finding_multiple(scene), finding_cost(scene)}},
            {"rows", rows}};
}

}  // namespace

std::string csv_of(const LightBench& bench) {
    std::string text =
        "scene,way,resolution,near_steps,rmse_single,bias_single,rmse_multiple,bias_multiple,"
        "standard_error_of_bias,build_ms,build_over_frame,draw_ms,draw_over_frame,dispatches,cells,megabytes\n";
    for (const LightBenchScene& scene : bench.scenes) {
        for (const LightBenchRow& row : scene.rows) {
            text += fmt::format("\"{}\",\"{}\",{},{},{:.5g},{:.5g},{:.5g},{:.5g},{:.3g},", scene.name,
                                words_of(row.provider), resolution_of(row), row.settings.near_steps, row.single.rmse,
                                row.single.bias, row.multiple.rmse, row.multiple.bias, scene.multiple_bias_error);
            text += fmt::format("{:.4g},{:.4g},{:.4g},{:.4g},{},{},{:.4g}\n", row.build_ms, row.build_over_frame,
                                row.draw_ms, row.draw_over_frame, row.dispatches, row.cells, row.megabytes);
        }
    }
    return text;
}

std::string json_of(const LightBench& bench) {
    nlohmann::json scenes = nlohmann::json::array();
    for (const LightBenchScene& scene : bench.scenes) {
        scenes.push_back(json_of_scene(scene));
    }
    nlohmann::json batches = nlohmann::json::array();
    for (const LightBatchRow& row : bench.batches) {
        batches.push_back({{"cells", {row.cells.x, row.cells.y, row.cells.z}},
                           {"diffuse", row.diffuse},
                           {"slices_per_dispatch", row.slices_per_dispatch},
                           {"dispatches", row.dispatches},
                           {"ms", row.ms},
                           {"over_one_slice", row.over_one}});
    }
    nlohmann::json builds = nlohmann::json::array();
    for (const LightBuildRow& row : bench.builds) {
        builds.push_back({{"scene", row.scene},
                          {"transfer_function", row.transfer_function},
                          {"diffuse", row.diffuse},
                          {"build_ms", row.build_ms},
                          {"frame_ms", row.frame_ms},
                          {"frames", row.ratio},
                          {"finding", finding_build(row)}});
    }
    const LightBenchOptions& options = bench.options;
    const nlohmann::json document = {
        {"bench", "light"},
        {"machine", to_json(bench.machine)},
        {"parameters",
         {{"pixels", {options.pixels.x, options.pixels.y}},
          {"frame_pixels", {options.frame_pixels.x, options.frame_pixels.y}},
          {"repeats", options.repeats},
          {"quick", options.quick},
          {"reference_tolerance", options.reference_tolerance},
          {"reference_samples", options.reference_samples}}},
        {"note",
         "errors are in units of display range, the 99.5th percentile of the reference's brightest channel; times are "
         "medians of this machine, ratios medians over pairs drawn in turn"},
        {"scenes", scenes},
        {"launches", batches},
        {"builds", builds}};
    return document.dump(1) + "\n";
}

void write_light_bench(const LightBench& bench, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);  // a folder that cannot be is told by the first file in it
    io::write_file_atomically(folder / "light.csv", csv_of(bench));
    io::write_file_atomically(folder / "light.json", json_of(bench));
    io::write_file_atomically(folder / "light.html", page_of(bench));
}

}  // namespace bruma::measure
