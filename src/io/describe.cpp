#include "io/describe.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/error.h"
#include "io/mesh/mesh_source.h"
#include "io/mesh/mesh_text.h"
#include "io/open.h"
#include "io/volume/grid_source.h"
#include "io/volume/raw_proposals.h"
#include "io/volume/raw_volume.h"

namespace bruma::io {
namespace {

std::string bar_chart(const scene::VolumeGrid& grid) {
    constexpr int bins = 16;
    constexpr double columns = 48.0;
    const scene::Histogram histogram = scene::histogram(grid, bins, grid.core);
    const std::uint64_t most =
        std::max<std::uint64_t>(1, *std::max_element(histogram.counts.begin(), histogram.counts.end()));
    std::string text = "histogram (length of a bar: square root of the count)\n";
    for (int bin = 0; bin < bins; ++bin) {
        const std::uint64_t count = histogram.counts[std::size_t(bin)];
        const double from = grid.core[0] + bin * (grid.core[1] - grid.core[0]) / bins;
        // A square root, or the empty space around things would leave nothing else to see.
        const auto length = std::size_t(columns * std::sqrt(double(count) / double(most)) + (count > 0 ? 1.0 : 0.0));
        text += fmt::format("  {:>12.6g} {:>12} {}\n", from, count, std::string(length, '#'));
    }
    return text;
}

double mean_value(const scene::VolumeGrid& grid) {
    return scene::visit_voxels(grid, [&grid](auto samples) {
        double sum = 0.0;
        for (std::size_t n = 0; n < samples.size(); ++n) {
            sum += grid.is_absent(n) ? 0.0 : double(samples[n]);
        }
        return sum / double(std::max<std::uint64_t>(1, grid.present_count()));
    });
}

std::string absence_text(const scene::VolumeGrid& grid) {
    std::string text;
    const auto share = [&grid](std::uint64_t count) { return 100.0 * double(count) / double(grid.voxel_count()); };
    for (const scene::FillValue& fill : grid.fills) {
        text += fmt::format("fill     {:.9g}: {} samples ({:.3g} %), left out and drawn as nothing\n", fill.value,
                            fill.count, share(fill.count));
    }
    text += fmt::format("faults   {}\n", grid.nonfinite == 0
                                             ? std::string("none")
                                             : fmt::format("{} of {} samples are not finite, drawn as nothing",
                                                           grid.nonfinite, grid.voxel_count()));
    return text;
}

std::string values_text(const scene::VolumeGrid& grid) {
    const glm::dvec3 extent = grid.extent();
    std::string text = fmt::format("extent   {:.6g} x {:.6g} x {:.6g} m\n", extent.x, extent.y, extent.z);
    text += fmt::format("range    {:.9g} to {:.9g}{}\n", grid.smallest, grid.largest,
                        grid.smallest == grid.largest ? " (constant: it shows no structure)" : "");
    if (grid.has_outliers()) {
        text += fmt::format("bulk     {:.9g} to {:.9g}; the few samples beyond lie far apart and decide nothing\n",
                            grid.core[0], grid.core[1]);
    }
    if (scene::bytes_per_voxel(grid.type) > 1) {
        text +=
            fmt::format("window   {:.9g} to {:.9g} suggested\n", grid.suggested_window[0], grid.suggested_window[1]);
    }
    text += fmt::format("mean     {:.9g}\n", mean_value(grid));
    return text + absence_text(grid) + bar_chart(grid);
}

std::string raw_text(const std::string& path, const scene::VolumeSource& hints) {
    const LoadedVolume loaded = load_raw_volume(path, hints);
    const RawLayout& layout = loaded.layout;
    const auto word = [](auto value) { return scene::enum_words<decltype(value)>()[std::size_t(value)]; };
    std::string text = fmt::format("{}: volume\n", path);
    text += fmt::format("size     {} x {} x {} ({})\n", layout.size.x, layout.size.y, layout.size.z, layout.size_from);
    text += fmt::format("type     {} ({})\n", word(layout.type), layout.type_from);
    if (scene::bytes_per_voxel(layout.type) > 1) {
        text += fmt::format("endian   {} ({})\n", word(layout.endian), layout.endian_from);
    }
    text += fmt::format("offset   {} bytes ({})\n", layout.offset, layout.offset_from);
    text += fmt::format("spacing  {:.6g} x {:.6g} x {:.6g} mm ({})\n", 1e3 * layout.spacing_m.x,
                        1e3 * layout.spacing_m.y, 1e3 * layout.spacing_m.z, layout.spacing_from);
    if (layout.rotation_deg != glm::dvec3(0.0)) {
        text += fmt::format("rotation {:.6g}, {:.6g}, {:.6g} degrees about x, y, z ({})\n", layout.rotation_deg.x,
                            layout.rotation_deg.y, layout.rotation_deg.z, layout.rotation_from);
    }
    text += values_text(*loaded.grid);
    for (const std::string& remark : loaded.remarks) {
        text += fmt::format("remark   {}\n", remark);
    }
    return text;
}

std::string proposals_text(const std::string& path, const std::vector<RawProposal>& proposals) {
    std::string text = fmt::format("{}: headerless file of unknown layout\n", path);
    text += proposals.empty() ? "no usual layout fits its length\n" : "likely layouts, best first:\n";
    for (const RawProposal& proposal : proposals) {
        text += fmt::format("  {}  ({})\n", as_options(proposal), proposal.reason);
    }
    return text;
}

std::string scene_text(const std::string& path, std::span<const std::string> settings,
                       const std::vector<std::filesystem::path>& preset_folders) {
    const scene::Scene scene = open_files(std::span(&path, 1), {}, settings, {}, preset_folders);
    std::string text =
        fmt::format("{}: scene of {} nodes and {} lights\n", path, scene.nodes.size(), scene.lights.size());
    for (const auto& [name, node] : scene.nodes) {
        if (const auto* volume = std::get_if<scene::Volume>(&node.content)) {
            const scene::VolumeGrid& grid = **volume->grid;
            text += fmt::format("  volume {}: {}, {}, values {:.6g} to {:.6g}\n", name, volume->source.file,
                                layout_words(grid.size, grid.type), grid.smallest, grid.largest);
        } else if (const auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
            const scene::TriangleMesh& triangles = **mesh->triangles;
            const glm::dvec3 extent_mm = 1e3 * (triangles.high - triangles.low);
            text += fmt::format("  mesh   {}: {}, {} triangles, {:.4g} x {:.4g} x {:.4g} mm\n", name, mesh->source.file,
                                triangles.triangles.size(), extent_mm.x, extent_mm.y, extent_mm.z);
        } else if (const auto* clouds = std::get_if<scene::Clouds>(&node.content)) {
            text +=
                fmt::format("  clouds {}: {:g} to {:g} m, coverage {:g}, weather {}\n", name, clouds->layer->bottom_m,
                            clouds->layer->top_m, clouds->layer->coverage, (*clouds->map)->name);
        } else {
            text += fmt::format("  group  {}\n", name);
        }
    }
    for (const auto& [name, light] : scene.lights) {
        text += fmt::format("  light  {}: {}\n", name, scene::enum_words<scene::LightKind>()[std::size_t(light->kind)]);
    }
    return text;
}

}  // namespace

std::string describe_file(const std::string& argument, const scene::VolumeSource& hints,
                          std::span<const std::string> settings,
                          const std::vector<std::filesystem::path>& preset_folders) {
    const bool is_scene = !is_mesh(argument) && (is_builtin(argument) || !is_raw_volume(argument, hints));
    if (!settings.empty() && !is_scene) {
        throw InputError(fmt::format("--set {}: changes a scene, but of {} is told what the file holds; leave it out",
                                     settings.front(), argument));
    }
    if (is_mesh(argument)) {
        return mesh_text(argument, load_mesh({.file = argument}, {}));
    }
    if (is_scene) {
        return scene_text(argument, settings, preset_folders);
    }
    const RawLayoutParts known = known_layout_parts(argument, hints);
    if (!known.complete()) {
        return proposals_text(argument, propose_layouts(argument, known.as_hints(), 5));
    }
    return raw_text(argument, hints);
}

}  // namespace bruma::io
