#include "measure/bench/volume/bench_report.h"

#include <nlohmann/json.hpp>

#include "io/json/json_fields.h"
#include "io/json/json_text.h"
#include "measure/bench/bench_table.h"
#include "measure/bench/volume/bench_findings.h"

namespace bruma::measure {
namespace {

double stop_of(const VolumeBenchRow& row) {
    return row.settings.early_termination ? row.settings.stop_transmittance : 0.0;
}

std::string_view classification_of(const VolumeBenchRow& row) {
    return scene::enum_words<scene::Classification>()[std::size_t(row.settings.classification)];
}

/// The page has a table of its own, with fewer columns.
BenchTable table_of(const VolumeBenchScene& scene) {
    using Row = VolumeBenchRow;
    return bench_table<Row>(
        {{"classification", "", {}, [](const Row& row) { return classification_of(row); }},
         {"step_voxels", "", {}, [](const Row& row) { return row.settings.step; }},
         {"skipping", "", {}, [](const Row& row) { return row.settings.empty_space_skipping; }},
         {"stop_transmittance", "", {}, [](const Row& row) { return stop_of(row); }},
         {"rmse", "", {}, [](const Row& row) { return row.error.rmse; }},
         {"relative_mse", "", {}, [](const Row& row) { return row.error.relative_mse; }},
         {"largest_error", "", {}, [](const Row& row) { return row.error.largest; }},
         {"psnr_db", "", {}, [](const Row& row) { return row.error.psnr_db; }},
         {"flip", "", {}, [](const Row& row) { return row.error.mean_flip; }},
         {"non_finite_pixels", "", {}, [](const Row& row) { return row.error.non_finite; }},
         {"wall_ms", "", {}, [](const Row& row) { return row.time.wall_ms; }},
         {"cpu_ms", "", {}, [](const Row& row) { return row.time.cpu_ms; }},
         {"time_over_brute_force", "", {}, [](const Row& row) { return row.time_over_brute; }},
         {"cpu_over_brute_force", "", {}, [](const Row& row) { return row.cpu_over_brute; }},
         {"time_over_default", "", {}, [](const Row& row) { return row.time_over_yardstick; }},
         {"samples_per_pixel", "", {}, [](const Row& row) { return row.samples_per_pixel; }},
         {"emptiness_queries_per_pixel", "", {}, [](const Row& row) { return row.queries_per_pixel; }},
         {"skipped_share", "", {}, [](const Row& row) { return row.skipped_share; }},
         {"table_ms", "", {}, [](const Row& row) { return row.table_ms; }},
         {"same_bits_as_without_skipping", "", {}, [](const Row& row) { return row.same_bits; }},
         {"reference_largest_error", "", {}, [&scene](const Row&) { return scene.reference_largest_error; }}},
        scene.rows);
}

}  // namespace

std::string csv_of(const VolumeBench& bench) {
    std::vector<std::pair<std::string, BenchTable>> tables;
    for (const VolumeBenchScene& scene : bench.scenes) {
        tables.emplace_back(scene.name, table_of(scene));
    }
    return csv_of(stacked("scene", tables));
}

std::string json_of(const VolumeBench& bench) {
    nlohmann::json scenes = nlohmann::json::array();
    for (const VolumeBenchScene& scene : bench.scenes) {
        nlohmann::json rows = json_of(table_of(scene));
        for (std::size_t n = 0; n < rows.size(); ++n) {
            io::write_fields(scene.rows[n].settings, rows[n]["settings"]);
        }
        scenes.push_back(
            {{"name", scene.name},
             {"reference",
              {{"rms_error", scene.reference_rms_error},
               {"largest_error", scene.reference_largest_error},
               {"seconds", scene.reference_seconds}}},
             {"default_settings", {{"wall_ms", scene.yardstick.wall_ms}, {"cpu_ms", scene.yardstick.cpu_ms}}},
             {"findings", {finding_time(scene), finding_samples(scene), finding_order(scene), finding_savings(scene)}},
             {"rows", rows}});
    }
    const nlohmann::json document = {
        {"bench", "volume"},
        {"machine", to_json(bench.machine)},
        {"parameters",
         {{"pixels", {bench.options.pixels.x, bench.options.pixels.y}},
          {"repeats", bench.options.repeats},
          {"quick", bench.options.quick},
          {"reference_tolerance", bench.options.reference_tolerance}}},
        {"note", "times are medians of this machine; ratios are medians over rounds in which the frames alternate"},
        {"scenes", scenes}};
    return io::report_text(document, 1) + "\n";
}

void write_volume_bench(const VolumeBench& bench, const std::filesystem::path& folder) {
    write_bench_files(
        folder, {{"volume.csv", csv_of(bench)}, {"volume.json", json_of(bench)}, {"volume.html", page_of(bench)}});
}

}  // namespace bruma::measure
