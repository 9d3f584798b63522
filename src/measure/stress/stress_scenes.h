#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "scene/scene.h"

/// Small grids and scenes for the stress suites; private to them.
namespace bruma::measure {

/// Repeatable noise in [0, 1) from an integer hash.
inline double stress_noise(std::size_t n, std::uint32_t seed = 1) {
    std::uint32_t h = std::uint32_t(n) * 0x9E3779B9U + seed * 0x85EBCA6BU;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    return double((h ^ (h >> 15)) & 0xFFFFFFU) / 16777216.0;
}

/// A grid of any type from `sample(n)`, n counting samples with x fastest. Voxels of 1 mm.
template <class T, class Sample>
std::shared_ptr<const scene::VolumeGrid> typed_grid(scene::VoxelType type, glm::ivec3 size, const Sample& sample) {
    auto grid = std::make_shared<scene::VolumeGrid>();
    grid->name = "stress";
    grid->size = size;
    grid->type = type;
    grid->voxels.resize(grid->voxel_count() * sizeof(T));
    for (std::size_t n = 0; n < grid->voxel_count(); ++n) {
        const T value = T(sample(n));
        std::memcpy(grid->voxels.data() + n * sizeof(T), &value, sizeof(T));
    }
    scene::finish_grid(*grid);
    return grid;
}
template <class Sample>
std::shared_ptr<const scene::VolumeGrid> float_grid(glm::ivec3 size, const Sample& sample) {
    return typed_grid<float>(scene::VoxelType::float32, size, sample);
}

/// 16^3 floats in [0, 1]: smooth in the middle, exactly 0 around it, so that there is something to skip.
inline std::shared_ptr<const scene::VolumeGrid> smooth_grid(glm::ivec3 size = glm::ivec3(16)) {
    return float_grid(size, [size](std::size_t n) {
        const std::size_t row = n / std::size_t(size.x), slice = row / std::size_t(size.y);
        const glm::dvec3 at(double(n % std::size_t(size.x)), double(row % std::size_t(size.y)), double(slice));
        const glm::dvec3 p = (at + 0.5) / glm::dvec3(size) * 2.0 - 1.0;
        const double s = 1.0 - glm::dot(p, p) / 0.7;
        return s > 0.0 ? s * s * (0.8 + 0.2 * std::cos(7.0 * p.x) * std::cos(5.0 * p.y)) : 0.0;
    });
}

/// Empty below a tenth of the range, then gently rising; bends at multiples of 1/1020, where tables hold it exactly.
inline scene::TransferFunction gentle_curves() {
    scene::TransferFunction tf;
    tf.opacity = {{0.1, 0.0}, {0.5, 0.1}, {1.0, 0.3}};
    tf.color = {{0.0, {0.2, 0.4, 0.9}}, {1.0, {0.9, 0.6, 0.2}}};
    tf.reference_length = 1e-3;
    return tf;
}

inline scene::Volume& stress_volume(scene::Scene& scene, const std::string& name = "volume") {
    return std::get<scene::Volume>(scene.nodes.at(name).content);
}

inline void add_volume(scene::Scene& scene, const std::string& name, std::shared_ptr<const scene::VolumeGrid> grid,
                       scene::TransferFunction tf, const scene::Transform& transform = {}) {
    scene::Volume volume;
    volume.grid = std::move(grid);
    volume.transfer_function = std::move(tf);
    scene::Node node;
    node.transform = transform;
    node.content = std::move(volume);
    scene.nodes[name] = std::move(node);
}

/// Puts the camera where all is seen.
inline void look_at_all(scene::Scene& scene) {
    scene.camera = scene::fit_camera(scene::world_bounds(scene), 1.5);
}

/// One volume, pre-integrated in steps of a quarter of a voxel without early termination, before a grey background.
inline scene::Scene stress_scene(std::shared_ptr<const scene::VolumeGrid> grid = smooth_grid(),
                                 scene::TransferFunction tf = gentle_curves()) {
    scene::Scene scene;
    add_volume(scene, "volume", std::move(grid), std::move(tf));
    scene.background = scene::Background{.top = {0.1, 0.2, 0.3}, .bottom = {0.3, 0.2, 0.1}};
    scene.rendering.edit([](scene::RenderSettings& s) {
        s.step = 0.25;
        s.early_termination = false;
    });
    look_at_all(scene);
    return scene;
}

}  // namespace bruma::measure
