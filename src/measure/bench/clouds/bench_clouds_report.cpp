#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/json/json_text.h"
#include "measure/bench/bench_html.h"
#include "measure/bench/bench_table.h"
#include "measure/bench/clouds/bench_clouds.h"
#include "measure/bench/plot.h"

namespace bruma::measure {
namespace {

BenchTable table_of(const CloudBenchScene& scene) {
    using Row = CloudBenchRow;
    return bench_table<Row>(
        {{"technique", "technique", {}, [](const Row& row) { return row.technique; }},
         {"step_m", "step, m", "{:.0f}", [](const Row& row) { return row.step_m; }},
         {"rmse", "RMSE", "{:.4f}", [](const Row& row) { return row.error.rmse; }},
         {"rmse_standard_error", "±", "{:.4f}", [](const Row& row) { return row.error.standard_error; }},
         {"relative_rmse", "relative RMSE", "{:.4f}", [](const Row& row) { return row.error.relative_rmse; }},
         {"bias", "bias", "{:+.4f}", [](const Row& row) { return row.error.bias; }},
         {"ms", "ms", "{:.1f}", [](const Row& row) { return row.ms; }},
         {"cpu_ms", "CPU ms", "{:.1f}", [](const Row& row) { return row.cpu_ms; }},
         {"turns_per_pixel", "turns / px", "{:.1f}", [](const Row& row) { return row.turns; }},
         {"weather_per_pixel", "weather / px", "{:.1f}", [](const Row& row) { return row.weather; }},
         {"noise_per_pixel", "noise / px", "{:.1f}", [](const Row& row) { return row.noise; }},
         {"light_per_pixel", "light / px", "{:.1f}", [](const Row& row) { return row.light; }}},
        scene.rows);
}

nlohmann::json json_of(const CloudBenchScene& scene) {
    const CloudPan& pan = scene.pan;
    const CloudBias& bias = scene.bias;
    return {{"preset", scene.preset},
            {"view", scene.view},
            {"reference_seconds", scene.reference_seconds},
            {"finding", finding(scene)},
            {"rows", json_of(table_of(scene))},
            {"pan",
             {{"full_ms", pan.full_ms},
              {"ms", pan.ms},
              {"full_cpu_ms", pan.full_cpu_ms},
              {"cpu_ms", pan.cpu_ms},
              {"rmse_in_motion", pan.rmse_in_motion},
              {"rmse_at_rest", pan.rmse_at_rest},
              {"flicker", pan.flicker}}},
            {"multiple_scattering",
             {{"mean", bias.modelled},
              {"mean_of_paths", bias.paths},
              {"standard_error", bias.standard_error},
              {"rms_difference", bias.rms}}}};
}

/// A line of each technique through its lengths of steps, over what they cost.
LogLogPlot curves(const CloudBenchScene& scene, const std::string& label, double (*cost)(const CloudBenchRow&)) {
    LogLogPlot plot{label, "RMSE", {}};
    for (const CloudBenchRow& row : scene.rows) {
        auto line = std::find_if(plot.lines.begin(), plot.lines.end(),
                                 [&](const PlotLine& one) { return one.name == row.technique; });
        if (line == plot.lines.end()) {
            const std::size_t n = plot.lines.size();
            plot.lines.push_back({row.technique, {}, n >= 6, int(n % 6)});  // there are six colours
            line = plot.lines.end() - 1;
        }
        line->points.emplace_back(cost(row), row.error.rmse);
    }
    for (PlotLine& line : plot.lines) {
        std::sort(line.points.begin(), line.points.end(), [](auto a, auto b) { return a.x < b.x; });
    }
    return plot;
}

std::string page_of(const CloudBench& bench) {
    std::string text = page_head("Bruma: clouds, time against error", "Clouds: run time against error");
    text += fmt::format(
        "<p class=\"soft\">{} \u00d7 {} pixels. {}</p>\n<p>Errors are those of {} pixels spread over the picture, in "
        "linear light "
        "against the double-precision march of the same field and the same model of light. Milliseconds are numbers of "
        "this machine on this day; lookups are the same everywhere.</p>\n",
        bench.options.pixels.x, bench.options.pixels.y, machine_html(bench.machine), bench.options.truth_pixels);
    for (const CloudBenchScene& scene : bench.scenes) {
        text += fmt::format("<section><h2>{}, {}</h2>\n<div class=\"plots\">\n", scene.preset, scene.view);
        text += figure("Error against time",
                       svg_of(curves(scene, "CPU milliseconds of a frame whose view is new",
                                     [](const CloudBenchRow& row) { return row.cpu_ms; })),
                       finding(scene)) +
                figure("Error against lookups",
                       svg_of(curves(scene, "lookups of noise and light per pixel",
                                     [](const CloudBenchRow& row) { return row.noise + row.light; })),
                       "The same pictures, by counts that are the same on every machine") +
                "</div>\n<p>" + html_text(finding_bias(scene)) + "</p>\n" + folded_html_of(table_of(scene)) +
                "</section>\n";
    }
    return text + "</body></html>\n";
}

/// Lookups that a scene needs for an error, between its settings of the step, on straight lines in logarithms.
std::optional<double> cost_at(const CloudBenchScene& scene, double rmse) {
    std::vector<std::pair<double, double>> line;  // lookups, RMSE
    for (const CloudBenchRow& row : scene.rows) {
        if (row.technique == "usual") {
            line.emplace_back(row.noise + row.light, row.error.rmse);
        }
    }
    std::sort(line.begin(), line.end());
    if (line.front().second <= rmse) {
        return line.front().first;
    }
    for (std::size_t n = 1; n < line.size(); ++n) {
        const auto [cheap, far] = line[n - 1];
        const auto [dear, near] = line[n];
        if (near <= rmse) {
            const double share = std::log(far / rmse) / std::log(far / near);
            return cheap * std::pow(dear / cheap, share);
        }
    }
    return std::nullopt;
}

}  // namespace

std::string finding(const CloudBenchScene& scene) {
    const CloudBenchRow& usual = scene.rows.front();
    return fmt::format(
        "RMSE {:.2g} ± {:.1g} (bias {:+.2g}) in {:.0f} ms, {:.0f} turns and {:.0f} lookups of noise per pixel; with "
        "reprojection a "
        "frame of a pan costs {:.2g} of a full one and is {:.2g} from it",
        usual.error.rmse, usual.error.standard_error, usual.error.bias, usual.ms, usual.turns, usual.noise,
        scene.pan.cpu_ms / std::max(1e-9, scene.pan.full_cpu_ms), scene.pan.rmse_in_motion);
}

std::string finding_bias(const CloudBenchScene& scene) {
    const CloudBias& bias = scene.bias;
    if (bias.paths <= 0.0) {
        return "light scattered more than once was not judged";
    }
    return fmt::format(
        "all scattered light gives {:.3g} where random paths give {:.3g} ± {:.1g}: {:+.0f} ± {:.1g} %; single pixels "
        "differ by {:.2g}",
        bias.modelled, bias.paths, bias.standard_error, 100.0 * (bias.modelled / bias.paths - 1.0),
        100.0 * bias.modelled / bias.paths * bias.standard_error / bias.paths, bias.rms);
}

std::optional<double> cost_beside(const CloudBenchScene& scene, const CloudBenchScene& other, double rmse) {
    const std::optional<double> own = cost_at(scene, rmse), others = cost_at(other, rmse);
    return own && others ? std::optional(*own / *others) : std::nullopt;
}

void write_cloud_bench(const CloudBench& bench, const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, BenchTable>> tables;
    nlohmann::json scenes = nlohmann::json::array();
    for (const CloudBenchScene& scene : bench.scenes) {
        scenes.push_back(json_of(scene));
        tables.emplace_back(scene.preset + ", " + scene.view, table_of(scene));
    }
    const nlohmann::json document = {{"bench", "clouds"},
                                     {"machine", to_json(bench.machine)},
                                     {"parameters",
                                      {{"pixels", {bench.options.pixels.x, bench.options.pixels.y}},
                                       {"repeats", bench.options.repeats},
                                       {"quick", bench.options.quick}}},
                                     {"scenes", scenes}};
    write_bench_files(folder, {{"clouds.csv", csv_of(stacked("scene", tables))},
                               {"clouds.json", io::report_text(document, 1) + "\n"},
                               {"clouds.html", page_of(bench)}});
}

}  // namespace bruma::measure
