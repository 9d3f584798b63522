#include "render/paths/path_volume_passes.h"

#include <fmt/core.h>

namespace bruma::render {
namespace {

struct TableSettings {
    glm::dvec3 albedo{1.0};
    double emission = 0.0;
    bool operator==(const TableSettings&) const = default;
};
struct Window {
    std::array<double, 2> ends{0.0, 1.0};
    bool operator==(const Window&) const = default;
};

gl::Texture upload(const std::string& label, const std::vector<glm::vec4>& entries) {
    if (entries.empty()) {
        return {};
    }
    gl::Texture texture = gl::Texture::make_1d(label, GL_RGBA32F, int(entries.size()));
    texture.upload({GL_RGBA, GL_FLOAT}, entries.data());
    return texture;
}

}  // namespace

PathVolumePasses::PathVolumePasses(FrameGraph& graph, const std::string& name, const VolumePasses& volume)
    : graph_(graph),
      transfer_function_(volume.transfer_function),
      ranges_(volume.cell_ranges()),
      voxels_(volume.voxels) {
    tables = graph.add_product<ScatteringTextures>(name + ": scattering tables");
    bounds = graph.add_product<BoundsTexture>(name + ": bounds of extinction");
    tabulate_ = graph.add_pass({name + ": scattering tables",
                                "tabulates extinction, albedo and glow of single points",
                                {transfer_function_.index},
                                {tables.index},
                                {}});
    bound_ = graph.add_pass({name + ": bounds of extinction",
                             "least and most extinction in each macrocell",
                             {ranges_.index, transfer_function_.index, voxels_.index},
                             {bounds.index},
                             {}});
}

void PathVolumePasses::update(const scene::Volume& volume) {
    const TableSettings settings{volume.optics->albedo, volume.optics->emission};
    graph_.set_parameters(tabulate_, settings);
    graph_.set_execute(tabulate_, [this, settings](const PassAccess& access) {
        const ScatteringTables made =
            make_scattering_tables(access.read(transfer_function_), settings.albedo, settings.emission);
        access.write(tables) = {upload("scattering: optics", made.optics), upload("scattering: glow", made.glow)};
    });
    const Window window{scene::effective_window(volume)};
    graph_.set_parameters(bound_, window);
    graph_.set_execute(bound_, [this, window](const PassAccess& access) {
        const double width = window.ends[1] - window.ends[0];
        const CellRanges& ranges = access.read(ranges_);
        const ExtinctionBounds found = bound_extinction(ranges, tabulate_extinction(access.read(transfer_function_)),
                                                        {1.0 / width, -window.ends[0] / width});
        BoundsTexture& out = access.write(bounds);
        out.cells_from_texture = glm::vec3(access.read(voxels_).texture.size()) / float(ranges.edge);
        out.bounds = gl::Texture::make_3d("bounds of extinction", GL_RG32F, found.cells);
        out.bounds.set_nearest();
        out.bounds.upload({GL_RG, GL_FLOAT}, found.least_most.data());
        access.note(fmt::format("{} x {} x {} macrocells", found.cells.x, found.cells.y, found.cells.z));
    });
}

void PathVolumePasses::remove() {
    graph_.remove_pass(tabulate_);
    graph_.remove_pass(bound_);
}

}  // namespace bruma::render
