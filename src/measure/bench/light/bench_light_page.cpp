#include <fmt/core.h>

#include "measure/bench/bench_html.h"
#include "measure/bench/light/bench_light_report.h"
#include "measure/bench/plot.h"

namespace bruma::measure {
namespace {

using scene::LightResolution;

/// Error with two near steps against what it costs, one line per way, one point per resolution.
template <class Error>
LogLogPlot error_plot(const LightBenchScene& scene, const std::string& label, const Error& error) {
    LogLogPlot plot{"build after a light change, frames of emission and absorption", label, {}};
    for (const LightBenchRow& row : scene.rows) {
        if (row.settings.near_steps != 2) {
            continue;
        }
        const std::string name(words_of(row.provider));
        if (plot.lines.empty() || plot.lines.back().name != name) {
            plot.lines.push_back({name, {}, false, int(row.provider)});
        }
        plot.lines.back().points.emplace_back(row.build_over_frame, error(row));
    }
    return plot;
}

BarPlot draw_plot(const LightBenchScene& scene) {
    BarPlot plot{"draw time, frames of emission and absorption (half resolution)", {}};
    for (const LightBenchRow& row : scene.rows) {
        if (row.settings.resolution == LightResolution::half) {
            plot.bars.push_back({fmt::format("{}, near steps {}", words_of(row.provider), row.settings.near_steps),
                                 row.draw_over_frame, int(row.provider), fmt::format(" ({:.1f} ms)", row.draw_ms)});
        }
    }
    return plot;
}

std::string section(const LightBenchScene& scene, const LightBenchOptions& options) {
    std::string text = fmt::format(
        "<section><h2>{}</h2>\n<p>Display range is a radiance of {:.3g} for single and {:.3g} for multiple scattering. "
        "The first reference states an RMS error of {:.1g} of it; the second a standard error of {:.2g} for a pixel "
        "and {:.1g} for the mean of all, which is that of the bias; they took {:.1f} s. A frame of emission and "
        "absorption took {:.1f} ms at {} \u00d7 {} and {:.1f} ms at {} \u00d7 {}.</p>\n<div class=\"plots\">\n",
        html_text(scene.name), scene.single_white, scene.multiple_white, scene.single_rms_error,
        scene.multiple_rms_error, scene.multiple_bias_error, scene.reference_seconds, scene.frame_ms,
        options.frame_pixels.x, options.frame_pixels.y, scene.small_frame_ms, options.pixels.x, options.pixels.y);
    text += figure(
        "Against single scattering",
        svg_of(error_plot(scene, "RMSE, display range 1", [](const LightBenchRow& row) { return row.single.rmse; })),
        finding_single(scene));
    text += figure(
        "Against all of the light",
        svg_of(error_plot(scene, "RMSE, display range 1", [](const LightBenchRow& row) { return row.multiple.rmse; })),
        finding_multiple(scene));
    text += figure("What a picture costs", svg_of(draw_plot(scene)), finding_cost(scene));
    return text + "</div>\n" + folded_html_of(table_of(scene)) + "</section>\n";
}

std::string builds_of(const LightBench& bench) {
    std::string text = "<section><h2>Building after a change of the light</h2>\n<ul>\n";
    for (const LightBuildRow& row : bench.builds) {
        text += "<li>" + html_text(finding_build(row)) + "</li>\n";
    }
    return text + "</ul></section>\n";
}

std::string batches_of(const LightBench& bench) {
    std::string text =
        "<section><h2>Several slices in one launch</h2>\n<p>" + html_text(finding_batches(bench)) +
        ".</p>\n<div class=\"wide\"><table><thead><tr><th>cells<th>light<th>slices per dispatch<th>dispatches<th>ms"
        "<th>time / one slice</tr></thead><tbody>\n";
    for (const LightBatchRow& row : bench.batches) {
        text += fmt::format("<tr><td>{} \u00d7 {} \u00d7 {}<td>{}<td>{}<td>{}<td>{:.2f}<td>{:.2f}</tr>\n", row.cells.x,
                            row.cells.y, row.cells.z, row.diffuse ? "with diffuse" : "direct",
                            row.slices_per_dispatch == 0 ? "chosen" : std::to_string(row.slices_per_dispatch),
                            row.dispatches, row.ms, row.over_one);
    }
    return text + "</tbody></table></div></section>\n";
}

}  // namespace

std::string page_of(const LightBench& bench) {
    std::string text = page_head("Bruma: light in volumes, cost against truth", "Light in volumes: cost against truth");
    text += fmt::format(
        "<p class=\"soft\">{} \u00d7 {} pixels, {} rounds. {}</p>\n"
        "<p>Errors are differences of linear radiance without tone mapping, in units of display range: the 99.5th "
        "percentile, over all pixels, of the brightest channel of the reference. Single scattering is integrated by "
        "quadrature, multiple scattering is the mean of {} random paths per pixel; bias is the mean signed difference "
        "and RMSE against it holds its noise as well. Milliseconds are numbers of this machine on this day; the ratios "
        "are the claim: each is the median over pairs that were timed one after the other. The unit of building is a "
        "frame of the same scene by emission and absorption at {} \u00d7 {}, that of drawing the same at the size of "
        "the pictures. The plots are drawn with two near steps; along each line the resolution is full, half and "
        "quarter.</p>\n",
        bench.options.pixels.x, bench.options.pixels.y, bench.options.repeats, machine_html(bench.machine),
        bench.options.reference_samples, bench.options.frame_pixels.x, bench.options.frame_pixels.y);
    for (const LightBenchScene& scene : bench.scenes) {
        text += section(scene, bench.options);
    }
    return text + builds_of(bench) + batches_of(bench) + "</body></html>\n";
}

}  // namespace bruma::measure
