#include <fmt/core.h>

#include <cmath>

#include "measure/bench/bench_html.h"
#include "measure/bench/bench_table.h"
#include "measure/bench/plot.h"
#include "measure/bench/volume/bench_findings.h"
#include "measure/bench/volume/bench_report.h"

namespace bruma::measure {
namespace {

using scene::Classification;

std::string stop_text(const scene::RenderSettings& settings) {
    return settings.early_termination ? fmt::format("1/{:.0f}", 1.0 / settings.stop_transmittance) : "off";
}

std::string name_of(Classification classification) {
    return classification == Classification::post ? "post-classified" : "pre-integrated";
}

template <class X>
LogLogPlot error_plot(const VolumeBenchScene& scene, double stop, const std::string& x_label, const X& x) {
    LogLogPlot plot{x_label, "RMSE, display range 1", {}};
    for (const Classification classification : {Classification::post, Classification::preintegrated}) {
        PlotLine line{name_of(classification), {}, false, classification == Classification::post ? 1 : 0};
        for (const VolumeBenchRow& row : rows_by_step(scene, classification, true, stop)) {
            line.points.emplace_back(x(row), row.error.rmse);
        }
        plot.lines.push_back(std::move(line));
    }
    return plot;
}

LogLogPlot convergence_plot(const VolumeBenchScene& scene) {
    LogLogPlot plot =
        error_plot(scene, 0.0, "step, voxels", [](const VolumeBenchRow& row) { return row.settings.step; });
    for (const Classification classification : {Classification::post, Classification::preintegrated}) {
        const auto rows = rows_by_step(scene, classification, true, 0.0);
        const Fit fit = fit_order(rows);
        if (fit.points < 2) {
            continue;
        }
        PlotLine line{fmt::format("slope {:.2f}", fit.order), {}, true, classification == Classification::post ? 1 : 0};
        for (const VolumeBenchRow& row : rows) {
            if (row.error.rmse > 1e-5) {
                line.points.emplace_back(row.settings.step, fit.factor * std::pow(row.settings.step, fit.order));
            }
        }
        plot.lines.push_back(std::move(line));
    }
    return plot;
}

BarPlot savings_plot(const VolumeBenchScene& scene) {
    BarPlot plot{"time, share of the brute-force frame (step 1 voxel)", {}};
    for (const VolumeBenchRow& row : scene.rows) {
        const double stop = row.settings.early_termination ? row.settings.stop_transmittance : 0.0;
        if (row.settings.step != 1.0 || (stop != 0.0 && stop != default_stop)) {
            continue;
        }
        const bool skip = row.settings.empty_space_skipping;
        const std::string what =
            skip ? (stop > 0.0 ? "skipping + stop" : "skipping") : (stop > 0.0 ? "stop" : "brute force");
        const bool post = row.settings.classification == Classification::post;
        plot.bars.push_back({fmt::format("{}, {}", post ? "post" : "pre-integrated", what), row.time_over_brute,
                             post ? 1 : 0, fmt::format(" ({:.0f} ms)", row.time.wall_ms)});
    }
    return plot;
}

std::string html_table_of(const VolumeBenchScene& scene) {
    std::string text =
        "<div class=\"wide\"><table><thead><tr><th>classification<th>step<th>skip<th>stop<th>RMSE<th>rel. MSE"
        "<th>largest<th>PSNR<th>FLIP<th>ms<th>CPU ms<th>time / brute<th>CPU / brute<th>time / default<th>samples / px"
        "<th>queries / px<th>skipped<th>tables ms</tr></thead><tbody>\n";
    for (const VolumeBenchRow& row : scene.rows) {
        text += fmt::format("<tr><td>{}<td>{:g}<td>{}<td>{}<td>{:.3g}<td>{:.3g}<td>{:.3g}<td>{:.1f}<td>{:.4f}",
                            name_of(row.settings.classification), row.settings.step,
                            row.settings.empty_space_skipping ? (row.same_bits ? "yes" : "yes, other bits") : "no",
                            stop_text(row.settings), row.error.rmse, row.error.relative_mse, row.error.largest,
                            row.error.psnr_db, row.error.mean_flip);
        text += fmt::format(
            "<td>{:.1f}<td>{:.1f}<td>{:.3f}<td>{:.3f}<td>{:.3f}<td>{:.1f}<td>{:.1f}<td>{:.1f} %<td>{:.1f}"
            "</tr>\n",
            row.time.wall_ms, row.time.cpu_ms, row.time_over_brute, row.cpu_over_brute, row.time_over_yardstick,
            row.samples_per_pixel, row.queries_per_pixel, 100.0 * row.skipped_share, row.table_ms);
    }
    return text + "</tbody></table></div>\n";
}

std::string section(const VolumeBenchScene& scene) {
    std::string text = fmt::format(
        "<section><h2>{}</h2>\n<p>The reference states an error of at most {:.2g} in any pixel (RMS {:.2g}; it took "
        "{:.1f} s). The default settings took {:.1f} ms a frame.</p>\n<div class=\"plots\">\n",
        html_text(scene.name), scene.reference_largest_error, scene.reference_rms_error, scene.reference_seconds,
        scene.yardstick.wall_ms);
    text += figure("Error against time",
                   svg_of(error_plot(scene, default_stop, "time / time of the default settings",
                                     [](const VolumeBenchRow& row) { return row.time_over_yardstick; })),
                   finding_time(scene));
    text += figure("Error against samples",
                   svg_of(error_plot(scene, default_stop, "samples per pixel",
                                     [](const VolumeBenchRow& row) { return row.samples_per_pixel; })),
                   finding_samples(scene));
    text += figure("Convergence", svg_of(convergence_plot(scene)), finding_order(scene));
    text += figure("What skipping and stopping save", svg_of(savings_plot(scene)), finding_savings(scene));
    return text + "</div>\n<details><summary>All numbers</summary>\n" + html_table_of(scene) + "</details></section>\n";
}

}  // namespace

std::string page_of(const VolumeBench& bench) {
    std::string text = page_head("Bruma: volumes, time against error", "Volumes: run time against error");
    text += fmt::format(
        "<p class=\"soft\">{} pixels, {} rounds. {}</p>\n"
        "<p>Error is measured in linear light against the double-precision reference. Milliseconds are numbers of this "
        "machine on this day; the ratios are the claim: in every round the frames to be compared are drawn in turn, "
        "and "
        "the median ratio is given. Brute force takes every sample at the same step. The default settings are "
        "pre-integrated, one voxel, skipping, stop below 1/1024. The two plots of error against cost are drawn with "
        "skipping and that stop, the convergence without a stop.</p>\n",
        fmt::format("{} \u00d7 {}", bench.options.pixels.x, bench.options.pixels.y), bench.options.repeats,
        machine_html(bench.machine));
    for (const VolumeBenchScene& scene : bench.scenes) {
        text += section(scene);
    }
    return text + "</body></html>\n";
}

}  // namespace bruma::measure
