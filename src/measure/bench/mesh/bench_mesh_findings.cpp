#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "measure/bench/mesh/bench_mesh_report.h"

namespace bruma::measure {
namespace {

using scene::SubsurfaceModel;
constexpr SubsurfaceModel usual = SubsurfaceModel::normalised_dipole;

auto fineness(const MeshBenchRow& row) {
    return std::tuple(row.maps, row.map_size, row.passes);
}

const MeshBenchRow* row_like(const MeshBenchScene& scene, const MeshBenchRow& like, int maps, int size, int passes) {
    const auto found = std::find_if(scene.rows.begin(), scene.rows.end(), [&](const MeshBenchRow& row) {
        return row.model == like.model && row.maps == maps && row.map_size == size && row.passes == passes;
    });
    return found == scene.rows.end() ? nullptr : &*found;
}

/// Of one model the coarsest setting after the most passes.
const MeshBenchRow* coarsest_row(const MeshBenchScene& scene, const MeshBenchRow& finest) {
    const MeshBenchRow* found = nullptr;
    for (const MeshBenchRow& row : scene.rows) {
        if (row.model == finest.model && row.passes == finest.passes && (!found || fineness(row) < fineness(*found))) {
            found = &row;
        }
    }
    return found;
}

}  // namespace

const MeshBenchRow* finest_row(const MeshBenchScene& scene, SubsurfaceModel model) {
    const MeshBenchRow* found = nullptr;
    for (const MeshBenchRow& row : scene.rows) {
        if (row.model == model && (!found || fineness(*found) < fineness(row))) {
            found = &row;
        }
    }
    return found;
}

std::string finding_quadrature(const MeshBenchScene& scene) {
    const MeshBenchRow* best = finest_row(scene, usual);
    if (!best) {
        return "nothing was measured";
    }
    std::string text = fmt::format(
        "with {} maps of {} texels and {} samples per texel the picture is {:.4f} (RMSE, bias {:+.4f}) from quadrature "
        "of the same model, for {:.3g} M evaluations and the time of {:.1f} Blinn-Phong frames",
        best->maps, best->map_size, best->samples, best->quadrature.rmse, best->quadrature.bias,
        1e-6 * double(best->evaluations), best->build_over_frame);
    const MeshBenchRow* first = nullptr;
    for (const MeshBenchRow& row : scene.rows) {
        first = row.model == usual && row.maps == best->maps && row.map_size == best->map_size && !first ? &row : first;
    }
    if (first != best) {
        text += fmt::format("; {} samples give {:.4f} for {:.1f} frames", first->samples, first->quadrature.rmse,
                            first->build_over_frame);
    }
    return text;
}

std::string finding_maps(const MeshBenchScene& scene) {
    const MeshBenchRow* best = finest_row(scene, usual);
    const MeshBenchRow* least = best ? coarsest_row(scene, *best) : nullptr;
    if (!best || least == best) {
        return "one setting of the maps was measured";
    }
    const MeshBenchRow* few = row_like(scene, *best, least->maps, best->map_size, best->passes);
    const MeshBenchRow* small = row_like(scene, *best, best->maps, least->map_size, best->passes);
    return fmt::format(
        "after {} samples per texel: {} maps of {} texels {:.4f}, {} of {} {:.4f}, {} of {} {:.4f}, {} of {} {:.4f}",
        best->samples, best->maps, best->map_size, best->quadrature.rmse, few->maps, few->map_size,
        few->quadrature.rmse, small->maps, small->map_size, small->quadrature.rmse, least->maps, least->map_size,
        least->quadrature.rmse);
}

std::string finding_walk(const MeshBenchScene& scene) {
    std::string text;
    for (const SubsurfaceModel model : {SubsurfaceModel::standard_dipole, SubsurfaceModel::directional_dipole, usual}) {
        if (const MeshBenchRow* row = finest_row(scene, model)) {
            text += fmt::format("{}{} {:.3f} (bias {:+.3f})", text.empty() ? "" : ", ", words_of(model), row->walk.rmse,
                                row->walk.bias);
        }
    }
    return fmt::format("RMSE from photons, whose own standard error is {:.3f} (of the bias {:.1g}): {}",
                       scene.walk_rms_error, scene.walk_bias_error, text);
}

std::string finding_combination(const MeshBenchScene& scene) {
    if (scene.combinations.empty()) {
        return "no combination was measured";
    }
    const auto [least, most] = std::minmax_element(
        scene.combinations.begin(), scene.combinations.end(),
        [](const MeshCombination& a, const MeshCombination& b) { return a.pass_over_opaque < b.pass_over_opaque; });
    const MeshCombination& finest = scene.combinations.back();
    return fmt::format(
        "blending the maps into a picture takes {:.1f} times as long as the same pass with Blinn-Phong shading at {} "
        "maps of {} texels, and {:.1f} times at {} of {}; of {} texels the picture looks up {}, which is {:.0f} % of "
        "the "
        "evaluations for all",
        least->pass_over_opaque, least->maps, least->map_size, most->pass_over_opaque, most->maps, most->map_size,
        finest.all_texels, finest.read_texels, 100.0 * finest.read_share());
}

std::string finding_noise(const std::vector<SamplingNoise>& noise, const std::string& material, bool is_lit) {
    double published[2] = {1e300, 0.0}, cut[2] = {1e300, 0.0};
    for (const SamplingNoise& one : noise) {
        if (one.material == material && one.is_lit == is_lit) {
            published[0] = std::min(published[0], one.over_disk());
            published[1] = std::max(published[1], one.over_disk());
            cut[0] = std::min(cut[0], one.over_cut_disk());
            cut[1] = std::max(cut[1], one.over_cut_disk());
        }
    }
    const auto times = [](double value) {
        return fmt::format(fmt::runtime(value < 10.0 ? "{:.1f}" : "{:.0f}"), value);
    };
    const double wanted = is_lit ? most_wanted_lit : most_wanted_behind;
    const auto verdict = [wanted](double least) { return least >= wanted ? "at least" : "not everywhere"; };
    return fmt::format(
        "{}, {}: for the same noise {} to {} times fewer evaluations than the published disk ({} the {:g} wanted), {} "
        "to "
        "{} times fewer than that disk cut at the body ({} {:g})",
        material, is_lit ? "lit side" : "behind", times(published[0]), times(published[1]), verdict(published[0]),
        wanted, times(cut[0]), times(cut[1]), verdict(cut[0]), wanted);
}

std::string finding_race(const SamplingRace& race) {
    return fmt::format(
        "{}, {}, through all passes: with {:.3g} M evaluations each, noise {:.2g} beside {:.2g} with the cut disk, "
        "which makes {:.0f} times fewer for the same",
        race.material, race.place, 1e-6 * double(race.evaluations), race.ours, race.disk, race.ratio());
}

}  // namespace bruma::measure
