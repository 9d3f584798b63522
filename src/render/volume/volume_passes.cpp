#include "render/volume/volume_passes.h"

#include <fmt/core.h>

namespace bruma::render {
namespace {

using Grid = std::shared_ptr<const scene::VolumeGrid>;

struct WindowParameters {
    std::array<double, 2> window{0.0, 1.0};
    bool operator==(const WindowParameters&) const = default;
};

gl::Texture upload_1d(const std::string& label, GLenum format, GLenum channels, const void* data) {
    gl::Texture texture = gl::Texture::make_1d(label, format, depth_entries);
    texture.upload({channels, GL_FLOAT}, data);
    return texture;
}

gl::Texture upload_2d(const std::string& label, const std::vector<glm::vec4>& data) {
    if (data.empty()) {
        return {};
    }
    gl::Texture texture = gl::Texture::make_2d(label, GL_RGBA32F, {source_entries, source_entries});
    texture.upload({GL_RGBA, GL_FLOAT}, data.data());
    return texture;
}

}  // namespace

VolumePasses::VolumePasses(FrameGraph& graph, const std::string& name) : graph_(graph) {
    grid_ = graph.add_source<Grid>(name + ": data");
    transfer_function = graph.add_source<scene::TransferFunction>(name + ": transfer function");
    voxels = graph.add_product<VolumeTexture>(name + ": voxels");
    gradients = graph.add_product<GradientTexture>(name + ": gradients");
    ranges_ = graph.add_product<CellRanges>(name + ": cell ranges");
    tables = graph.add_product<TableTextures>(name + ": tables");
    emptiness = graph.add_product<EmptinessTexture>(name + ": emptiness");

    upload_ = graph.add_pass({name + ": upload",
                              "puts the samples into a 3-D texture",
                              {grid_.index},
                              {voxels.index},
                              [this](const PassAccess& access) {
                                  const auto& grid = access.read(grid_);
                                  access.write(voxels) = make_volume_texture(*grid);
                                  access.note(fmt::format("{} x {} x {}", grid->size.x, grid->size.y, grid->size.z));
                              }});
    differentiate_ = graph.add_pass(
        {name + ": differentiate", "central differences for lighting", {grid_.index}, {gradients.index}, {}});
    range_ = graph.add_pass({name + ": cell ranges",
                             "smallest and largest value in each macrocell",
                             {grid_.index},
                             {ranges_.index},
                             [this](const PassAccess& access) {
                                 CellRanges& ranges = access.write(ranges_);
                                 ranges = make_cell_ranges(*access.read(grid_));
                                 access.note(fmt::format("{} x {} x {} cells of {}^3 voxels", ranges.cells.x,
                                                         ranges.cells.y, ranges.cells.z, ranges.edge));
                             }});
    tabulate_ = graph.add_pass({name + ": tables",
                                "tabulates the transfer function, pre-integrated for this step",
                                {transfer_function.index},
                                {tables.index},
                                {}});
    find_empty_ = graph.add_pass({name + ": occupancy",
                                  "which macrocells hold anything visible, and how far the next is",
                                  {ranges_.index, transfer_function.index, grid_.index},
                                  {emptiness.index},
                                  {}});
}

void VolumePasses::update(const scene::Volume& volume, const scene::RenderSettings& settings, double step_world) {
    graph_.set_source(grid_, *volume.grid, volume.grid.revision());
    graph_.set_source(transfer_function, *volume.transfer_function, volume.transfer_function.revision());

    // Refined segments are halves where they are not finer still, so that is the length to be exact for.
    const double segment = step_world * (settings.refine ? 0.5 : 1.0);
    const TableParameters parameters{
        volume.optics->density_scale * segment / volume.transfer_function->reference_length,
        settings.classification == scene::Classification::preintegrated,
        volume.optics->lighting != scene::VolumeLighting::none,
        volume.optics->emission,
        scene::scatters(volume.optics->lighting),
        volume.optics->albedo};
    graph_.set_parameters(tabulate_, parameters);
    graph_.set_execute(tabulate_, [this, parameters](const PassAccess& access) {
        TableTextures& out = access.write(tables);
        out.tables = make_transfer_tables(access.read(transfer_function), parameters);
        out.optics = upload_1d("optics table", GL_RGBA32F, GL_RGBA, out.tables.optics.data());
        out.depth = upload_1d("depth table", GL_RG32F, GL_RG, out.tables.depth.data());
        out.source = upload_2d("source table", out.tables.source);
        out.glow = upload_2d("glow table", out.tables.glow);
    });

    const GradientStorage storage = gradient_storage(volume);
    graph_.set_parameters(differentiate_, storage);
    graph_.set_execute(differentiate_, [this, storage](const PassAccess& access) {
        access.write(gradients) = make_gradient_texture(*access.read(grid_), storage);
    });

    const WindowParameters window{scene::effective_window(volume)};
    graph_.set_parameters(find_empty_, window);
    graph_.set_execute(find_empty_, [this, window](const PassAccess& access) {
        const double width = window.window[1] - window.window[0];
        const CellRanges& ranges = access.read(ranges_);
        const TransferTables curves = make_transfer_tables(access.read(transfer_function), {.preintegrated = false});
        const Emptiness found = find_emptiness(ranges, curves, {1.0 / width, -window.window[0] / width});
        EmptinessTexture& out = access.write(emptiness);
        out.edge = ranges.edge;
        out.voxels = access.read(grid_)->size;
        out.occupied_share = found.occupied_share;
        out.distance = gl::Texture::make_3d("emptiness", GL_R8UI, found.cells);
        out.distance.set_nearest();
        out.distance.upload({GL_RED_INTEGER, GL_UNSIGNED_BYTE}, found.distance.data());
        access.note(fmt::format("{:.1f} % of the cells are occupied", 100.0 * found.occupied_share));
    });
}

void VolumePasses::remove() {
    for (const PassId pass : {upload_, differentiate_, range_, tabulate_, find_empty_}) {
        graph_.remove_pass(pass);
    }
    graph_.remove_source(grid_.index);
    graph_.remove_source(transfer_function.index);
}

}  // namespace bruma::render
