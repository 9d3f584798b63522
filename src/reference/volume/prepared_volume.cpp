#include "reference/volume/prepared_volume.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/error.h"

namespace bruma::reference {
namespace {

const scene::Volume& volume_of(const scene::Scene& scene, const std::string& node_name) {
    return std::get<scene::Volume>(scene.nodes.at(node_name).content);
}

std::shared_ptr<const scene::VolumeGrid> grid_of(const scene::Scene& scene, const std::string& node_name) {
    const auto& grid = *volume_of(scene, node_name).grid;
    if (!grid || grid->voxel_count() == 0) {
        throw InputError(fmt::format("nodes.{}: holds no samples yet; load its volume before rendering", node_name));
    }
    return grid;
}

}  // namespace

PreparedVolume::PreparedVolume(const scene::Scene& scene, const std::string& node_name)
    : field(grid_of(scene, node_name)),
      curves(*volume_of(scene, node_name).transfer_function, volume_of(scene, node_name).optics->density_scale,
             volume_of(scene, node_name).optics->emission),
      clip(*volume_of(scene, node_name).clip),
      lighting(volume_of(scene, node_name).optics->lighting),
      scatters(scene::scatters(lighting)),
      g(volume_of(scene, node_name).optics->g),
      name_(node_name),
      albedo_(volume_of(scene, node_name).optics->albedo) {
    const scene::Volume& volume = volume_of(scene, node_name);
    const scene::VolumeGrid& grid = field.grid();
    const glm::dmat4 world_from_texture = scene::world_from_texture(scene, node_name);
    texture_from_world = glm::inverse(world_from_texture);
    clip.low = glm::max(clip.low, glm::dvec3(0.0));
    clip.high = glm::min(clip.high, glm::dvec3(1.0));

    const auto window = scene::effective_window(volume);
    window_low_ = window[0];
    u_per_value_ = 1.0 / (window[1] - window[0]);

    double diagonal = 0.0;  // of a block, metres
    double edge = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double voxel_edge = glm::length(glm::dvec3(world_from_texture[axis])) / grid.size[axis];
        edge = std::min(edge, voxel_edge);
        diagonal += BlockRanges::edge * voxel_edge;
    }
    const BlockRanges blocks = block_ranges(grid);
    blocks_ = blocks.size;
    transparent_.reserve(blocks.ranges.size());
    majorants_.reserve(blocks.ranges.size());
    for (std::size_t block = 0; block < blocks.ranges.size(); ++block) {
        const auto [low, high] = blocks.ranges[block];
        if (low > high) {  // nothing but absent samples
            transparent_.push_back(1);
            majorants_.push_back(0.0);
            continue;
        }
        const auto [u_low, u_high] = std::minmax({u_of_value(low), u_of_value(high)});
        const bool transparent = curves.is_transparent(u_low, u_high);
        transparent_.push_back(transparent ? 1 : 0);
        const auto [least, largest] = curves.extinction_range(u_low, u_high);
        const double smallest = blocks.has_holes[block] != 0 ? 0.0 : least;
        majorants_.push_back(transparent ? 0.0 : largest);
        largest_null_depth_ = std::max(largest_null_depth_, transparent ? 0.0 : (largest - smallest) * diagonal);
    }
    const scene::VolumeOptics& optics = *volume.optics;
    if (lighting == scene::VolumeLighting::gradient || (scatters && optics.surfaces)) {
        shading.emplace(scene, optics, edge, scene::shading_range(volume));
    }
}

std::vector<PreparedVolume> prepare_volumes(const scene::Scene& scene) {
    scene::check(scene);
    if (!scene.camera) {
        throw InputError("camera: the scene has none, and a reference needs to know where it is seen from; set one");
    }
    std::vector<PreparedVolume> volumes;
    for (const std::string& name : scene::shown_volumes(scene)) {
        volumes.emplace_back(scene, name);
    }
    return volumes;
}

}  // namespace bruma::reference
