#include "measure/bench_report.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "io/json_fields.h"
#include "measure/bench_findings.h"

namespace bruma::measure {
namespace {

double stop_of(const VolumeBenchRow& row) {
    return row.settings.early_termination ? row.settings.stop_transmittance : 0.0;
}

std::string_view classification_of(const VolumeBenchRow& row) {
    return scene::enum_words<scene::Classification>()[std::size_t(row.settings.classification)];
}

/// JSON knows no infinity.
nlohmann::json number(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json json_of_row(const VolumeBenchRow& row) {
    nlohmann::json settings;
    io::write_fields(row.settings, settings);
    return {{"settings", settings},
            {"rmse", number(row.error.rmse)},
            {"relative_mse", number(row.error.relative_mse)},
            {"largest_error", number(row.error.largest)},
            {"psnr_db", number(row.error.psnr_db)},
            {"flip", row.error.mean_flip},
            {"non_finite_pixels", row.error.non_finite},
            {"wall_ms", row.time.wall_ms},
            {"cpu_ms", row.time.cpu_ms},
            {"time_over_brute_force", row.time_over_brute},
            {"cpu_over_brute_force", row.cpu_over_brute},
            {"time_over_default", row.time_over_yardstick},
            {"samples_per_pixel", row.samples_per_pixel},
            {"emptiness_queries_per_pixel", row.queries_per_pixel},
            {"skipped_share", row.skipped_share},
            {"table_ms", row.table_ms},
            {"same_bits_as_without_skipping", row.same_bits}};
}

}  // namespace

std::string csv_of(const VolumeBench& bench) {
    std::string text =
        "scene,classification,step_voxels,skipping,stop_transmittance,rmse,relative_mse,largest_error,psnr_db,flip,"
        "wall_ms,cpu_ms,time_over_brute_force,cpu_over_brute_force,time_over_default,samples_per_pixel,"
        "emptiness_queries_per_pixel,skipped_share,table_ms,same_bits_as_without_skipping,reference_largest_error\n";
    for (const VolumeBenchScene& scene : bench.scenes) {
        for (const VolumeBenchRow& row : scene.rows) {
            text += fmt::format("\"{}\",{},{},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.5g},{:.5g},", scene.name,
                                classification_of(row), row.settings.step, int(row.settings.empty_space_skipping),
                                stop_of(row), row.error.rmse, row.error.relative_mse, row.error.largest,
                                row.error.psnr_db, row.error.mean_flip);
            text += fmt::format("{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.5g},{:.5g},{:.5g},{:.4g},{},{:.4g}\n",
                                row.time.wall_ms, row.time.cpu_ms, row.time_over_brute, row.cpu_over_brute,
                                row.time_over_yardstick, row.samples_per_pixel, row.queries_per_pixel,
                                row.skipped_share, row.table_ms, int(row.same_bits), scene.reference_largest_error);
        }
    }
    return text;
}

std::string json_of(const VolumeBench& bench) {
    nlohmann::json scenes = nlohmann::json::array();
    for (const VolumeBenchScene& scene : bench.scenes) {
        nlohmann::json rows = nlohmann::json::array();
        for (const VolumeBenchRow& row : scene.rows) {
            rows.push_back(json_of_row(row));
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
    return document.dump(1) + "\n";
}

void write_volume_bench(const VolumeBench& bench, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);  // a folder that cannot be is told by the first file in it
    io::write_file_atomically(folder / "volume.csv", csv_of(bench));
    io::write_file_atomically(folder / "volume.json", json_of(bench));
    io::write_file_atomically(folder / "volume.html", page_of(bench));
}

}  // namespace bruma::measure
