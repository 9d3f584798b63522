#pragma once
#include "reference/medium/render_scattering.h"
#include "reference_scenes.h"

/// Small scattering scenes for the tests of the reference renderer.
namespace bruma::reference {

/// Makes a volume of a scene scatter.
inline void let_scatter(scene::Scene& scene, double albedo, double g, const std::string& name = "volume") {
    volume_in(scene, name).optics =
        scene::VolumeOptics{.lighting = scene::VolumeLighting::path_traced, .albedo = glm::dvec3(albedo), .g = g};
}

/// A slab of 1 m thickness across z, centred on the origin, so wide that nothing reaches its sides.
inline scene::Scene slab_scene(double optical_depth, double albedo, double g) {
    auto scene = scene_with(homogeneous(glm::ivec3(1), {1e7, 1e7, 1.0}), uniform_extinction(optical_depth));
    let_scatter(scene, albedo, g);
    return scene;
}

/// Noise in a box of 0.8 m with transparent and dense parts, coloured, without emission.
inline scene::Scene noisy_scene(double albedo, double g, glm::dvec3 color = glm::dvec3(1.0)) {
    scene::TransferFunction tf;
    tf.reference_length = 0.3;
    tf.opacity = {{0.3, 0.0}, {0.5, 0.3}, {0.8, 0.05}, {0.8, 0.6}, {1.0, 0.2}};
    tf.color = {{0.0, color}};
    auto scene = scene_with(
        grid_of(glm::ivec3(20, 18, 22), glm::dvec3(0.04), [](glm::ivec3 at) { return noise(at / 3, 5); }), tf);
    let_scatter(scene, albedo, g);
    return scene;
}

inline scene::Light sun(glm::dvec3 direction, glm::dvec3 color = glm::dvec3(1.0)) {
    return {.direction_world = direction, .color = color};
}
inline scene::Light lamp(glm::dvec3 position, double intensity = 1.0) {
    return {.kind = scene::LightKind::point, .position_world = position, .intensity = intensity};
}

/// Of the z-scores of all pixels and channels: how many, their mean, their mean square, which is 1 where the errors are
/// true, and the largest. Pixels of which nearly all or nearly no paths meet matter are left out: a standard error from
/// a handful of events says little.
struct ZScores {
    int count = 0;
    double mean = 0.0, mean_square = 0.0, largest = 0.0;
};
inline ZScores z_scores(const ScatteringImage& measured, const Image& truth) {
    ZScores scores;
    for (std::size_t n = 0; n < measured.error.size(); ++n) {
        for (int channel = 0; channel < 3; ++channel) {
            const double error = measured.error[n][channel];
            const float alpha = measured.image.rgba[4 * n + 3];
            if (error > 0.0 && alpha > 0.1F && alpha < 0.95F) {
                const double z = (double(measured.image.rgba[4 * n + channel]) - truth.rgba[4 * n + channel]) / error;
                ++scores.count;
                scores.mean += z;
                scores.mean_square += z * z;
                scores.largest = std::max(scores.largest, std::abs(z));
            }
        }
    }
    scores.mean /= std::max(scores.count, 1);
    scores.mean_square /= std::max(scores.count, 1);
    return scores;
}

}  // namespace bruma::reference
