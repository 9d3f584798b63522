#include "measure/bench/mesh/bench_mesh_report.h"
#include "io/json/json_text.h"

#include <algorithm>

namespace bruma::measure {
namespace {

nlohmann::json findings_of(const MeshBenchScene& scene) {
    return {finding_quadrature(scene), finding_maps(scene), finding_walk(scene), finding_combination(scene)};
}

nlohmann::json json_of(const MeshBenchScene& scene) {
    return {{"name", scene.name},
            {"display_range", scene.white},
            {"pixels_compared", scene.pixels},
            {"quadrature", {{"rms_error", scene.quadrature_rms_error}, {"seconds", scene.quadrature_seconds}}},
            {"random_walk",
             {{"standard_error", scene.walk_rms_error},
              {"standard_error_of_bias", scene.walk_bias_error},
              {"lost_share", scene.lost_share},
              {"seconds", scene.walk_seconds}}},
            {"blinn_phong", {{"frame_ms", scene.frame_ms}, {"pass_ms", scene.opaque_ms}}},
            {"findings", findings_of(scene)},
            {"rows", json_of(table_of(scene))},
            {"combinations", json_of(table_of(scene.combinations))}};
}

}  // namespace

std::string_view words_of(scene::SubsurfaceModel model) {
    switch (model) {
        case scene::SubsurfaceModel::standard_dipole:
            return "standard dipole";
        case scene::SubsurfaceModel::directional_dipole:
            return "directional dipole";
        case scene::SubsurfaceModel::normalised_dipole:
            break;
    }
    return "directional, normalised";
}

BenchTable table_of(const MeshBenchScene& scene) {
    using Row = MeshBenchRow;
    return bench_table<Row>(
        {{"model", "model", {}, [](const Row& row) { return words_of(row.model); }},
         {"maps", "maps", {}, [](const Row& row) { return row.maps; }},
         {"map_size", "map size", {}, [](const Row& row) { return row.map_size; }},
         {"passes", "passes", {}, [](const Row& row) { return row.passes; }},
         {"samples_per_texel", "samples / texel", {}, [](const Row& row) { return row.samples; }},
         {"evaluations", "evaluations", {}, [](const Row& row) { return row.evaluations; }},
         {"rmse_quadrature", "RMSE, quadrature", "{:.4f}", [](const Row& row) { return row.quadrature.rmse; }},
         {"bias_quadrature", "bias, quadrature", "{:+.4f}", [](const Row& row) { return row.quadrature.bias; }},
         {"rmse_walk", "RMSE, random walk", "{:.4f}", [](const Row& row) { return row.walk.rmse; }},
         {"bias_walk", "bias, random walk", "{:+.4f}", [](const Row& row) { return row.walk.bias; }},
         {"standard_error_walk", "", {}, [&](const Row&) { return scene.walk_rms_error; }},
         {"build_over_frame", "time / frame", "{:.2f}", [](const Row& row) { return row.build_over_frame; }},
         {"build_ms", "ms", "{:.1f}", [](const Row& row) { return row.build_ms; }}},
        scene.rows);
}

BenchTable table_of(const std::vector<MeshCombination>& combinations) {
    using Row = MeshCombination;
    return bench_table<Row>(
        {{"maps", "maps", {}, [](const Row& row) { return row.maps; }},
         {"map_size", "map size", {}, [](const Row& row) { return row.map_size; }},
         {"pass_over_blinn_phong", "pass / pass", "{:.2f}", [](const Row& row) { return row.pass_over_opaque; }},
         {"frame_over_blinn_phong", "frame / frame", "{:.2f}", [](const Row& row) { return row.frame_over_frame; }},
         {"pass_ms", "pass ms", "{:.1f}", [](const Row& row) { return row.pass_ms; }},
         {"read_texels", "texels read", {}, [](const Row& row) { return row.read_texels; }},
         {"all_texels", "texels", {}, [](const Row& row) { return row.all_texels; }},
         {"read_share", "share", "{:.3f}", [](const Row& row) { return row.read_share(); }}},
        combinations);
}

BenchTable table_of(const std::vector<SamplingNoise>& noise) {
    using Row = SamplingNoise;
    return bench_table<Row>(
        {{"material", "material", {}, [](const Row& row) { return row.material; }},
         {"place", "place", {}, [](const Row& row) { return row.place; }},
         {"channel", "channel", {}, [](const Row& row) { return std::string(1, "RGB"[row.channel]); }},
         {"deviation_ours", "deviation, ours", "{:.3f}", [](const Row& row) { return row.ours; }},
         {"deviation_disk", "published disk", "{:.3f}", [](const Row& row) { return row.disk; }},
         {"deviation_cut_disk", "disk cut at the body", "{:.3f}", [](const Row& row) { return row.cut_disk; }},
         {"times_fewer_than_disk", "times fewer than disk", "{:.1f}", [](const Row& row) { return row.over_disk(); }},
         {"times_fewer_than_cut_disk", "than cut disk", "{:.1f}", [](const Row& row) { return row.over_cut_disk(); }}},
        noise);
}

BenchTable table_of(const std::vector<SamplingRace>& races) {
    using Row = SamplingRace;
    return bench_table<Row>(
        {{"material", "material", {}, [](const Row& row) { return row.material; }},
         {"place", "place", {}, [](const Row& row) { return row.place; }},
         {"evaluations", "evaluations", {}, [](const Row& row) { return row.evaluations; }},
         {"noise_ours", "noise, ours", "{:.4f}", [](const Row& row) { return row.ours; }},
         {"noise_disk", "noise, cut disk", "{:.4f}", [](const Row& row) { return row.disk; }},
         {"times_fewer", "times fewer for the same noise", "{:.1f}", [](const Row& row) { return row.ratio(); }}},
        races);
}

void write_mesh_bench(const MeshBench& bench, const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, BenchTable>> tables;
    nlohmann::json scenes = nlohmann::json::array();
    for (const MeshBenchScene& scene : bench.scenes) {
        tables.emplace_back(scene.name, table_of(scene));
        scenes.push_back(json_of(scene));
    }
    nlohmann::json findings = nlohmann::json::array();
    for (const std::string material : {"cream", "marble"}) {
        findings.push_back(finding_noise(bench.noise, material, true));
        findings.push_back(finding_noise(bench.noise, material, false));
    }
    for (const SamplingRace& race : bench.races) {
        findings.push_back(finding_race(race));
    }
    nlohmann::json document =
        begun_document("mesh", bench,
                       "errors are in units of display range, the 99.5th percentile of the brightest channel of the "
                       "normalised model's "
                       "quadrature; times are of this machine, ratios against Blinn-Phong frames of the same run");
    document["parameters"]["photons_per_channel"] = bench.options.photons;
    document["scenes"] = scenes;
    document["sampling"] = {
        {"findings", findings}, {"noise", json_of(table_of(bench.noise))}, {"races", json_of(table_of(bench.races))}};
    write_bench_files(folder, {{"mesh.csv", csv_of(stacked("scene", tables))},
                               {"mesh_sampling.csv", csv_of(table_of(bench.noise))},
                               {"mesh.json", io::report_text(document, 1) + "\n"},
                               {"mesh.html", page_of(bench)}});
}

}  // namespace bruma::measure
