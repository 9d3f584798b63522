#include "path_tracing.h"

#include <cmath>

namespace bruma::render {

Traced PathTraced::trace(const scene::Scene& scene, glm::ivec2 pixels, PathGoal goal) {
    Renderer renderer(shaders());
    renderer.render(scene, {pixels, 1.0, goal});
    Traced traced{renderer.read_picture(), renderer.read_standard_error()};
    EXPECT_TRUE(all_finite(traced.mean));
    EXPECT_TRUE(all_finite(traced.error));
    return traced;
}

Estimate estimate(const Traced& traced, int channel) {
    Estimate sum;
    for (std::size_t n = 0; n < traced.mean.pixel_count(); ++n) {
        sum.mean += traced.mean.rgba[4 * n + std::size_t(channel)];
        sum.error += std::pow(double(traced.error.rgba[4 * n + std::size_t(channel)]), 2.0);
    }
    const double pixels = double(traced.mean.pixel_count());
    return {sum.mean / pixels, std::sqrt(sum.error) / pixels};
}

double apart(const Estimate& a, const Estimate& b) {
    return std::abs(a.mean - b.mean) / std::max(1e-30, std::hypot(a.error, b.error));
}

scene::VolumeOptics& path_traced(scene::VolumeOptics& optics) {
    optics.lighting = scene::VolumeLighting::path_traced;
    return optics;
}

scene::Scene wide_slab(double sigma, double height, double albedo, double g) {
    scene::Scene scene =
        scene_with(homogeneous(glm::ivec3(1), {400.0 * height, 400.0 * height, height}), uniform_extinction(sigma));
    volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) {
        path_traced(optics).albedo = glm::dvec3(albedo);
        optics.g = g;
    });
    scene.camera->edit([&](scene::Camera& camera) {
        camera.eye_world.z = 10.0 * height;
        camera.view_height = height;
    });
    return scene;
}

}  // namespace bruma::render
