#include <fmt/core.h>

#include "io/atomic_file.h"
#include "measure/bench_clouds.h"
#include "measure/bench_html.h"
#include "measure/plot.h"

namespace bruma::measure {
namespace {

std::string csv_of(const CloudBench& bench) {
    std::string text =
        "preset,view,technique,rmse,relative_rmse,bias,ms,cpu_ms,turns_per_pixel,weather_per_pixel,noise_per_pixel,"
        "light_per_pixel\n";
    for (const CloudBenchScene& scene : bench.scenes) {
        for (const CloudBenchRow& row : scene.rows) {
            text += fmt::format("{},{},\"{}\",{:.5g},{:.5g},{:.5g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}\n",
                                scene.preset, scene.view, row.technique, row.rmse, row.relative_rmse, row.bias, row.ms,
                                row.cpu_ms, row.turns, row.weather, row.noise, row.light);
        }
    }
    return text;
}

nlohmann::json json_of(const CloudBenchScene& scene) {
    nlohmann::json rows = nlohmann::json::array();
    for (const CloudBenchRow& row : scene.rows) {
        rows.push_back(
            {{"technique", row.technique},
             {"rmse", row.rmse},
             {"relative_rmse", row.relative_rmse},
             {"bias", row.bias},
             {"ms", row.ms},
             {"cpu_ms", row.cpu_ms},
             {"per_pixel",
              {{"turns", row.turns}, {"weather", row.weather}, {"noise", row.noise}, {"light", row.light}}}});
    }
    const CloudPan& pan = scene.pan;
    return {{"preset", scene.preset},
            {"view", scene.view},
            {"reference_seconds", scene.reference_seconds},
            {"finding", finding(scene)},
            {"rows", rows},
            {"pan",
             {{"full_ms", pan.full_ms},
              {"ms", pan.ms},
              {"full_cpu_ms", pan.full_cpu_ms},
              {"cpu_ms", pan.cpu_ms},
              {"rmse_from_full", pan.rmse_from_full},
              {"rmse_at_rest", pan.rmse_at_rest},
              {"flicker", pan.flicker}}}};
}

std::string page_of(const CloudBench& bench) {
    const Machine& m = bench.machine;
    std::string text = page_head("Bruma: clouds, time against error", "Clouds: run time against error");
    text += fmt::format(
        "<p class=\"soft\">{} \u00d7 {} pixels. {}, {} cores; {}. Bruma {}, {}.</p>\n<p>Errors are those of {} \u00d7 "
        "{} "
        "pixels in linear light against the double-precision march of the same field and the same model of light. "
        "Milliseconds are numbers of this machine on this day; lookups are the same everywhere.</p>\n",
        bench.options.pixels.x, bench.options.pixels.y, html_text(m.cpu), m.cores, html_text(m.renderer), m.version,
        m.date, bench.options.reference_pixels.x, bench.options.reference_pixels.y);
    for (const CloudBenchScene& scene : bench.scenes) {
        LogLogPlot plot{"lookups of noise and light per pixel", "RMSE", {}};
        for (std::size_t n = 0; n < scene.rows.size(); ++n) {
            const CloudBenchRow& row = scene.rows[n];
            plot.lines.push_back({row.technique, {{row.noise + row.light, row.rmse}}, false, int(n % 6)});
        }
        text += fmt::format("<section><h2>{}, {}</h2>\n<div class=\"plots\">\n", scene.preset, scene.view);
        text += figure("Error against lookups", svg_of(plot), finding(scene)) + "</div></section>\n";
    }
    return text + "</body></html>\n";
}

}  // namespace

std::string finding(const CloudBenchScene& scene) {
    const CloudBenchRow& usual = scene.rows.front();
    return fmt::format(
        "RMSE {:.2g} (bias {:+.2g}) in {:.0f} ms, {:.0f} turns and {:.0f} lookups of noise per pixel; with "
        "reprojection a "
        "frame of a pan costs {:.2g} of a full one and is {:.2g} from it",
        usual.rmse, usual.bias, usual.ms, usual.turns, usual.noise,
        scene.pan.cpu_ms / std::max(1e-9, scene.pan.full_cpu_ms), scene.pan.rmse_from_full);
}

void write_cloud_bench(const CloudBench& bench, const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);  // a folder that cannot be is told by the first file in it
    nlohmann::json scenes = nlohmann::json::array();
    for (const CloudBenchScene& scene : bench.scenes) {
        scenes.push_back(json_of(scene));
    }
    const nlohmann::json document = {{"bench", "clouds"},
                                     {"machine", to_json(bench.machine)},
                                     {"parameters",
                                      {{"pixels", {bench.options.pixels.x, bench.options.pixels.y}},
                                       {"repeats", bench.options.repeats},
                                       {"quick", bench.options.quick}}},
                                     {"scenes", scenes}};
    io::write_file_atomically(folder / "clouds.csv", csv_of(bench));
    io::write_file_atomically(folder / "clouds.json", document.dump(1) + "\n");
    io::write_file_atomically(folder / "clouds.html", page_of(bench));
}

}  // namespace bruma::measure
