#pragma once
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scene/scene.h"

/// Small grids and scenes for the tests of the reference renderer.
namespace bruma::reference {

/// A float grid with the value of `sample` at each (i, j, k).
inline std::shared_ptr<const scene::VolumeGrid> grid_of(glm::ivec3 size, glm::dvec3 spacing,
                                                        const std::function<double(glm::ivec3)>& sample) {
    std::vector<float> samples;
    for (int k = 0; k < size.z; ++k) {
        for (int j = 0; j < size.y; ++j) {
            for (int i = 0; i < size.x; ++i) {
                samples.push_back(float(sample({i, j, k})));
            }
        }
    }
    return scene::make_grid("test", size, spacing, samples);
}

/// A box of the given extent in metres, filled with one value.
inline std::shared_ptr<const scene::VolumeGrid> homogeneous(glm::ivec3 size, glm::dvec3 extent) {
    return grid_of(size, extent / glm::dvec3(size), [](glm::ivec3) { return 1.0; });
}

/// Repeatable noise in [0, 1) from an integer hash, with 12 bits so that floats hold it exactly.
inline double noise(glm::ivec3 at, std::uint32_t seed = 1) {
    std::uint32_t h = seed * 0x9E3779B9U + std::uint32_t(at.x) * 0x85EBCA6BU + std::uint32_t(at.y) * 0xC2B2AE35U +
                      std::uint32_t(at.z) * 0x27D4EB2FU;
    h = (h ^ (h >> 15)) * 0x2C1B3C6DU;
    h = (h ^ (h >> 12)) * 0x297A2D39U;
    return double((h ^ (h >> 15)) & 0xFFFU) / 4096.0;
}

/// One extinction for every value; `color` is the source radiance.
inline scene::TransferFunction uniform_extinction(double sigma, glm::dvec3 color = glm::dvec3(1.0)) {
    scene::TransferFunction tf;
    tf.reference_length = 0.5 / sigma;  // opacity well inside (0, 1)
    tf.opacity = {{0.0, -std::expm1(-0.5)}};
    tf.color = {{0.0, color}};
    return tf;
}

/// A transfer function with bends, a jump, an empty stretch and emission.
inline scene::TransferFunction rich_transfer_function(double reference_length) {
    scene::TransferFunction tf;
    tf.reference_length = reference_length;
    tf.opacity = {{0.2, 0.0}, {0.35, 0.4}, {0.5, 0.05}, {0.6, 0.05}, {0.6, 0.3}, {0.8, 0.9}, {1.0, 0.2}};
    tf.color = {{0.1, {0.9, 0.2, 0.1}}, {0.55, {0.2, 0.7, 0.3}}, {0.9, {0.4, 0.5, 1.0}}};
    tf.emission = {{0.7, 0.0}, {0.85, 0.6}, {1.0, 0.0}};
    return tf;
}

/// Seen from +z, orthographic, one metre high; the volume node is called "volume".
inline scene::Scene scene_with(std::shared_ptr<const scene::VolumeGrid> grid, scene::TransferFunction tf) {
    scene::Volume volume;
    volume.grid = std::move(grid);
    volume.transfer_function = std::move(tf);
    scene::Scene scene;
    scene::Node node;
    node.content = std::move(volume);
    scene.nodes["volume"] = std::move(node);
    scene::Camera camera;
    camera.projection = scene::Projection::orthographic;
    camera.eye_world = {0.0, 0.0, 10.0};
    scene.camera.emplace(camera);
    return scene;
}

inline scene::Volume& volume_in(scene::Scene& scene, const std::string& name = "volume") {
    return std::get<scene::Volume>(scene.nodes.at(name).content);
}

/// The ray from one point towards another, from t = 0.
inline scene::Ray ray_from(glm::dvec3 origin, glm::dvec3 towards) {
    return {origin, glm::normalize(towards - origin), 0.0};
}

}  // namespace bruma::reference
