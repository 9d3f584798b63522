#include "measure/bench/light/bench_light_report.h"
#include "io/json/json_text.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

namespace bruma::measure {
namespace {

std::string_view resolution_of(const LightBenchRow& row) {
    return scene::enum_words<scene::LightResolution>()[std::size_t(row.settings.resolution)];
}

nlohmann::json json_of_scene(const LightBenchScene& scene) {
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
            {"rows", json_of(table_of(scene))}};
}

}  // namespace

BenchTable table_of(const LightBenchScene& scene) {
    using Row = LightBenchRow;
    return bench_table<Row>(
        {{"way", "way", {}, [](const Row& row) { return words_of(row.provider); }},
         {"resolution", "resolution", {}, [](const Row& row) { return resolution_of(row); }},
         {"near_steps", "near steps", {}, [](const Row& row) { return row.settings.near_steps; }},
         {"rmse_single", "RMSE, single", "{:.4f}", [](const Row& row) { return row.single.rmse; }},
         {"bias_single", "bias, single", "{:+.4f}", [](const Row& row) { return row.single.bias; }},
         {"rmse_multiple", "RMSE, multiple", "{:.4f}", [](const Row& row) { return row.multiple.rmse; }},
         {"bias_multiple", "bias, multiple", "{:+.4f}", [](const Row& row) { return row.multiple.bias; }},
         {"standard_error_of_bias", "", {}, [&scene](const Row&) { return scene.multiple_bias_error; }},
         {"build_ms", "build ms", "{:.1f}", [](const Row& row) { return row.build_ms; }},
         {"build_over_frame", "build / frame", "{:.3f}", [](const Row& row) { return row.build_over_frame; }},
         {"draw_ms", "draw ms", "{:.1f}", [](const Row& row) { return row.draw_ms; }},
         {"draw_over_frame", "draw / frame", "{:.2f}", [](const Row& row) { return row.draw_over_frame; }},
         {"dispatches", "dispatches", {}, [](const Row& row) { return row.dispatches; }},
         {"cells", "cells", {}, [](const Row& row) { return row.cells; }},
         {"megabytes", "MB", "{:.1f}", [](const Row& row) { return row.megabytes; }}},
        scene.rows);
}

std::string csv_of(const LightBench& bench) {
    std::vector<std::pair<std::string, BenchTable>> tables;
    for (const LightBenchScene& scene : bench.scenes) {
        tables.emplace_back(scene.name, table_of(scene));
    }
    return csv_of(stacked("scene", tables));
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
    nlohmann::json document = begun_document(
        "light", bench,
        "errors are in units of display range, the 99.5th percentile of the reference's brightest channel; times are "
        "medians of this machine, ratios medians over pairs drawn in turn");
    document["parameters"]["reference_samples"] = bench.options.reference_samples;
    document["scenes"] = scenes;
    document["launches"] = batches;
    document["builds"] = builds;
    return io::report_text(document, 1) + "\n";
}

void write_light_bench(const LightBench& bench, const std::filesystem::path& folder) {
    write_bench_files(folder,
                      {{"light.csv", csv_of(bench)}, {"light.json", json_of(bench)}, {"light.html", page_of(bench)}});
}

}  // namespace bruma::measure
