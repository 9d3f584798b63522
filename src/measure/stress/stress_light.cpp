#include "measure/stress/stress_light.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace bruma::measure {
namespace {

double brightest_scattered(const Image& image) {
    double most = 0.0;
    for (std::size_t n = 0; n < image.rgba.size(); ++n) {
        if (n % 4 != 3) {
            if (image.rgba[n] < 0.0F) {
                throw std::runtime_error(fmt::format("radiance of {:.2g}", image.rgba[n]));
            }
            most = std::max(most, double(image.rgba[n]));
        }
    }
    return most;
}

}  // namespace

scene::Scene scattering_scene(const scene::Light& light, std::shared_ptr<const scene::VolumeGrid> grid) {
    scene::Scene scene = stress_scene(std::move(grid));
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    scene.lights["light"] = light;
    stress_volume(scene).optics.edit([](auto& optics) { optics.lighting = scene::VolumeLighting::light_volume; });
    return scene;
}

scene::Scene uniform_scene(double depth) {
    scene::Scene scene = scattering_scene({.direction_world = {0.0, 0.0, 1.0}},
                                          float_grid(glm::ivec3(16), [](std::size_t) { return 1.0; }));
    scene::Volume& volume = stress_volume(scene);
    volume.transfer_function.edit([](scene::TransferFunction& tf) {
        const double opacity = 1.0 - std::exp(-1.0);  // depth 1 over an edge
        tf.opacity = {{0.0, opacity}, {1.0, opacity}};
        tf.color = {{0.0, glm::dvec3(1.0)}};
        tf.reference_length = 16e-3;
    });
    volume.optics.edit([depth](scene::VolumeOptics& optics) { optics.density_scale = depth; });
    scene.camera = scene::fit_camera(scene::world_bounds(scene), 1.5, {0.0, 0.0, 1.0});
    scene.camera->edit([](scene::Camera& camera) {
        camera.projection = scene::Projection::orthographic;
        camera.view_height = 20e-3;
    });
    return scene;
}

double uniform_radiance(double depth) {
    return -0.125 * std::expm1(-2.0 * depth);
}

void take_way(scene::Scene& scene, int way) {
    scene::Volume& volume = stress_volume(scene);
    volume.light_volume.edit([way](scene::LightVolumeSettings& settings) {
        settings.mode = way == 2 ? scene::SweepMode::paper : scene::SweepMode::physical;
        settings.diffuse = way == 1;
    });
    volume.optics.edit([way](scene::VolumeOptics& optics) {
        optics.lighting = way == 3 ? scene::VolumeLighting::shadow_rays : scene::VolumeLighting::light_volume;
    });
}

double share_of_allowed(StressRig& rig, scene::Scene scene, double irradiance) {
    const double g = std::abs(stress_volume(scene).optics->g);
    const double largest_phase = (1.0 + g) / ((1.0 - g) * (1.0 - g));  // times 4 pi
    const double per_phase = irradiance / (4.0 * std::numbers::pi);
    double most = 0.0;
    for (int way = 0; way < light_ways; ++way) {
        take_way(scene, way);
        const double allowed =
            way == 2 ? irradiance / std::numbers::pi : per_phase * (largest_phase + (way == 1 ? 1.0 : 0.0));
        const double radiance = brightest_scattered(rig.draw(scene));
        most = std::max(most, allowed > 0.0 ? radiance / allowed : radiance);
    }
    return most;
}

double difference_in_all_ways(StressRig& rig, scene::Scene a, scene::Scene b) {
    double most = 0.0;
    for (int way = 0; way < light_ways; ++way) {
        take_way(a, way);
        take_way(b, way);
        const Image expected = rig.draw(b);
        most =
            std::max(most, largest_difference(rig.draw(a), expected) / std::max(1e-30, brightest_scattered(expected)));
    }
    return most;
}

std::vector<StressVerdict> run_light_stress(const StressOptions& options) {
    StressRig rig(options);
    stress_light_optics(rig);
    stress_light_lamps(rig);
    stress_light_shapes(rig);
    stress_light_motion(rig);
    return rig.verdicts();
}

}  // namespace bruma::measure
