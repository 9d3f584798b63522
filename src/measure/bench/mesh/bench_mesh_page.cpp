#include <fmt/core.h>

#include "measure/bench/bench_html.h"
#include "measure/bench/mesh/bench_mesh_report.h"
#include "measure/bench/plot.h"

namespace bruma::measure {
namespace {

using scene::SubsurfaceModel;

/// One line for each name that `name` gives to rows that `wanted` lets through, in the order of the rows.
template <class Wanted, class Name, class Point>
LogLogPlot lines_of(const MeshBenchScene& scene, LogLogPlot plot, const Wanted& wanted, const Name& name,
                    const Point& point) {
    for (const MeshBenchRow& row : scene.rows) {
        if (!wanted(row)) {
            continue;
        }
        if (plot.lines.empty() || plot.lines.back().name != name(row)) {
            plot.lines.push_back({name(row), {}, false, int(plot.lines.size() % 6)});
        }
        plot.lines.back().points.push_back(point(row));
    }
    return plot;
}

glm::dvec2 over_evaluations(const MeshBenchRow& row) {
    return {double(row.evaluations), row.quadrature.rmse};
}
glm::dvec2 over_time(const MeshBenchRow& row) {
    return {row.build_over_frame, row.quadrature.rmse};
}

LogLogPlot model_plot(const MeshBenchScene& scene, const MeshBenchRow& best) {
    return lines_of(
        scene, {"evaluations of the BSSRDF", "RMSE, display range 1", {}},
        [&](const MeshBenchRow& row) { return row.maps == best.maps && row.map_size == best.map_size; },
        [](const MeshBenchRow& row) { return std::string(words_of(row.model)); }, over_evaluations);
}

LogLogPlot size_plot(const MeshBenchScene& scene, const MeshBenchRow& best) {
    return lines_of(
        scene, {"time, Blinn-Phong frames", "RMSE, display range 1", {}},
        [&](const MeshBenchRow& row) { return row.model == best.model && row.maps == best.maps; },
        [](const MeshBenchRow& row) { return fmt::format("{} maps of {} texels", row.maps, row.map_size); }, over_time);
}

LogLogPlot maps_plot(const MeshBenchScene& scene, const MeshBenchRow& best) {
    return lines_of(
        scene, {"time, Blinn-Phong frames", "RMSE, display range 1", {}},
        [&](const MeshBenchRow& row) { return row.model == best.model && row.map_size == best.map_size; },
        [](const MeshBenchRow& row) { return fmt::format("{} maps of {} texels", row.maps, row.map_size); }, over_time);
}

BarPlot walk_plot(const MeshBenchScene& scene) {
    BarPlot plot{"RMSE from photons, display range 1", {}};
    for (const SubsurfaceModel model :
         {SubsurfaceModel::standard_dipole, SubsurfaceModel::directional_dipole, SubsurfaceModel::normalised_dipole}) {
        if (const MeshBenchRow* row = finest_row(scene, model)) {
            plot.bars.push_back(
                {std::string(words_of(model)), row->walk.rmse, int(model), fmt::format(" ({:+.3f})", row->walk.bias)});
        }
    }
    plot.bars.push_back({"noise of the photons", scene.walk_rms_error, 5});
    return plot;
}

BarPlot combination_plot(const MeshBenchScene& scene) {
    BarPlot plot{"time of the pass, times that of Blinn-Phong",
                 {{"Blinn-Phong", 1.0, 5, fmt::format(" ({:.1f} ms)", scene.opaque_ms)}}};
    for (const MeshCombination& row : scene.combinations) {
        plot.bars.push_back({fmt::format("{} maps of {} texels", row.maps, row.map_size), row.pass_over_opaque, 0,
                             fmt::format(" ({:.1f} ms)", row.pass_ms)});
    }
    return plot;
}

std::string section(const MeshBenchScene& scene, const MeshBenchOptions& options) {
    const MeshBenchRow* best = finest_row(scene, SubsurfaceModel::normalised_dipole);
    if (!best) {
        return "";
    }
    std::string text = fmt::format(
        "<section><h2>{}</h2>\n<p>Display range is a radiance of {:.3g}. {} pixels are compared. Quadrature states an "
        "RMS error of {:.1g} of display range (three models took {:.1f} s); photons have a standard error of {:.2g} "
        "for "
        "a pixel and {:.1g} for the mean, which is that of the bias ({:.1f} s; {:.2g} of them were lost through "
        "seams). A Blinn-Phong frame at {} \u00d7 {} took {:.1f} ms.</p>\n<div class=\"plots\">\n",
        html_text(scene.name), scene.white, scene.pixels, scene.quadrature_rms_error, scene.quadrature_seconds,
        scene.walk_rms_error, scene.walk_bias_error, scene.walk_seconds, scene.lost_share, options.frame_pixels.x,
        options.frame_pixels.y, scene.frame_ms);
    text += figure("Error against evaluations, by model", svg_of(model_plot(scene, *best)), finding_quadrature(scene));
    text += figure("What larger maps bring", svg_of(size_plot(scene, *best)), finding_maps(scene));
    text += figure("What more maps bring", svg_of(maps_plot(scene, *best)),
                   "along each line passes are added, as a viewer does while nothing moves");
    text += figure("Against all of the light", svg_of(walk_plot(scene)), finding_walk(scene));
    text += figure("What a moved camera costs", svg_of(combination_plot(scene)), finding_combination(scene));
    return text + "</div>\n" + folded_html_of(table_of(scene)) + html_of(table_of(scene.combinations)) + "</section>\n";
}

BarPlot noise_plot(const MeshBench& bench, bool is_lit) {
    BarPlot plot{"times fewer evaluations than the cut disk, for the same noise", {}};
    const double wanted = is_lit ? most_wanted_lit : most_wanted_behind;
    plot.bars.push_back({"wanted", wanted, 5});
    for (const SamplingNoise& noise : bench.noise) {
        if (noise.is_lit == is_lit && noise.channel == 1) {
            plot.bars.push_back({noise.material + ", " + (noise.place.size() > 12 ? "behind" : noise.place),
                                 noise.over_cut_disk(), noise.material == "cream" ? 0 : 1,
                                 fmt::format(" ({:.3g})", noise.over_disk())});
        }
    }
    for (const SamplingRace& race : bench.races) {
        if (race.is_lit == is_lit) {
            plot.bars.push_back({race.material + ", renderer", race.ratio(), race.material == "cream" ? 2 : 3});
        }
    }
    return plot;
}

std::string sampling_section(const MeshBench& bench) {
    std::string text =
        "<section><h2>Where points of light are drawn</h2>\n<p>Each estimate draws points in the plane across the "
        "light "
        "and evaluates the BSSRDF once for each; for a given noise their number goes with the square of what one point "
        "deviates. Compared are this program's densities (a core as narrow as the model's peak with a tail as long as "
        "its reach; behind the body another one) and the exponential disk that was published with the maps, as it is "
        "and cut at the body's diameter. Deviations are integrals in double precision, without chance, for a "
        "half-space and for a ball of 10 mm radius; the bars of the renderer are pictures drawn with both, "
        "whose points are spread evenly instead of left to chance, which helps smooth estimates more. In brackets: "
        "beside "
        "the disk that is not cut. Bars show green light.</p>\n<ul>\n";
    for (const std::string material : {"cream", "marble"}) {
        for (const bool is_lit : {true, false}) {
            text += "<li>" + html_text(finding_noise(bench.noise, material, is_lit)) + ".</li>\n";
        }
    }
    for (const SamplingRace& race : bench.races) {
        text += "<li>" + html_text(finding_race(race)) + ".</li>\n";
    }
    text += "</ul>\n<div class=\"plots\">\n";
    text += figure("On the lit side", svg_of(noise_plot(bench, true)),
                   fmt::format("wanted are {:g} times fewer", most_wanted_lit));
    text += figure("Behind the body", svg_of(noise_plot(bench, false)),
                   fmt::format("wanted are {:g} times fewer", most_wanted_behind));
    return text + "</div>\n" + folded_html_of(table_of(bench.noise)) + html_of(table_of(bench.races)) + "</section>\n";
}

}  // namespace

std::string page_of(const MeshBench& bench) {
    std::string text = page_head("Bruma: light inside meshes, cost against truth",
                                 "Light inside translucent meshes: cost against truth");
    text += fmt::format(
        "<p class=\"soft\">{} \u00d7 {} pixels, {} rounds. {}</p>\n"
        "<p>The light inside a body is kept on maps around it: each of their texels is a mean over points where light "
        "enters, a few more in every pass, and a picture blends the maps. Errors are differences of linear radiance in "
        "units of display range: the 99.5th percentile, over all pixels, of the brightest channel of the normalised "
        "model. Quadrature integrates the very same model over the lit surface, so it shows what maps and points leave "
        "wrong; photons that wander without any model show what the models leave wrong, and RMSE against them holds "
        "their noise as well. Pixels at the outline are left out, where photons are counted over a pixel's area. "
        "Evaluations of the BSSRDF are counted where they are started. Milliseconds are numbers of this machine on "
        "this day; the ratios are the claim: the unit is a frame of the same scene with Blinn-Phong shading at {} "
        "\u00d7 {}, drawn in turn with what is compared to it.</p>\n",
        bench.options.pixels.x, bench.options.pixels.y, bench.options.repeats, machine_html(bench.machine),
        bench.options.frame_pixels.x, bench.options.frame_pixels.y);
    for (const MeshBenchScene& scene : bench.scenes) {
        text += section(scene, bench.options);
    }
    return text + sampling_section(bench) + "</body></html>\n";
}

}  // namespace bruma::measure
