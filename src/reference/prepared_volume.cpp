#include "reference/prepared_volume.h"

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
      clip(*volume_of(scene, node_name).clip) {
    const scene::Volume& volume = volume_of(scene, node_name);
    const scene::VolumeGrid& grid = field.grid();
    const glm::dmat4 world_from_texture = scene::world_from_texture(scene, node_name);
    texture_from_world = glm::inverse(world_from_texture);
    clip.low = glm::max(clip.low, glm::dvec3(0.0));
    clip.high = glm::min(clip.high, glm::dvec3(1.0));

    const auto window = scene::effective_window(volume);
    window_low_ = window[0];
    u_per_value_ = 1.0 / (window[1] - window[0]);

    const BlockRanges blocks = block_ranges(grid);
    blocks_ = blocks.size;
    transparent_.reserve(blocks.ranges.size());
    for (const auto& [low, high] : blocks.ranges) {
        const auto [u_low, u_high] = std::minmax({u_of_value(low), u_of_value(high)});
        transparent_.push_back(curves.is_transparent(u_low, u_high) ? 1 : 0);
    }

    if (volume.optics->lighting == scene::VolumeLighting::gradient) {
        double edge = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            edge = std::min(edge, glm::length(glm::dvec3(world_from_texture[axis])) / grid.size[axis]);
        }
        shading.emplace(scene, *volume.optics, edge, grid.largest - grid.smallest);
    } else if (volume.optics->lighting != scene::VolumeLighting::none) {
        const auto words = scene::enum_words<scene::VolumeLighting>();
        throw InputError(fmt::format(
            "nodes.{}.lighting: the emission-absorption reference knows none and gradient, not {}; choose one of them",
            node_name, words[std::size_t(volume.optics->lighting)]));
    }
}

}  // namespace bruma::reference
