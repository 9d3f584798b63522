#include "measure/bench/bench_frames.h"

#include <algorithm>
#include <cmath>

#include "base/installation.h"
#include "measure/bench/bench_stand.h"

namespace bruma::measure {

scene::Camera orbited(const scene::Camera& camera, double azimuth_deg) {
    const double angle = glm::radians(azimuth_deg);
    const auto turned = [&](glm::dvec3 v) {
        return glm::dvec3(std::cos(angle) * v.x + std::sin(angle) * v.z, v.y,
                          std::cos(angle) * v.z - std::sin(angle) * v.x);
    };
    scene::Camera result = camera;
    if (azimuth_deg != 0.0) {
        result.eye_world = camera.target_world + turned(camera.eye_world - camera.target_world);
        result.up_world = turned(camera.up_world);
    }
    return result;
}

namespace {

/// Medians over frames further along the orbit.
std::map<std::string, double> time_passes(BenchStand& stand, const scene::Camera& camera,
                                          const FramesBenchOptions& options) {
    std::map<std::string, std::vector<double>> times;
    for (int n = 0; n < options.repeats; ++n) {
        for (const render::PassReport& pass :
             stand.passes(orbited(camera, options.azimuth_step_deg * (options.repeats + n)))) {
            if (pass.ran) {
                times[pass.name].push_back(pass.gpu_ms);
            }
        }
    }
    std::map<std::string, double> medians;
    for (const auto& [name, all] : times) {
        if (2 * int(all.size()) > options.repeats) {
            medians[name] = median(all);
        }
    }
    return medians;
}

}  // namespace

FramesBench run_frames_bench(const std::string& name, const scene::Scene& scene, const FramesBenchOptions& options) {
    gl::ShaderLibrary shaders(installed_folder("shaders"));
    BenchStand stand(shaders, scene, options.pixels);
    stand.prepare(*scene.rendering);
    FramesBench bench;
    bench.scene = name;
    bench.first_frame = stand.picture();
    std::vector<double> wall, cpu;
    for (int n = -options.warmup; n < options.repeats; ++n) {
        const Duration time = stand.timed(orbited(**scene.camera, options.azimuth_step_deg * n));
        if (n >= 0) {
            wall.push_back(time.wall_ms);
            cpu.push_back(time.cpu_ms);
        }
    }
    bench.frames = int(wall.size());
    bench.ms_median = median(wall);
    bench.ms_min = *std::min_element(wall.begin(), wall.end());
    bench.ms_max = *std::max_element(wall.begin(), wall.end());
    bench.cpu_ms_median = median(cpu);
    if (options.passes) {
        bench.pass_ms = time_passes(stand, **scene.camera, options);
    }
    stand.timed(**scene.camera);
    bench.samples_per_pixel = stand.count(*scene.rendering).samples_per_pixel;
    return bench;
}

nlohmann::json to_json(const FramesBench& bench) {
    nlohmann::json line = {{"scene", bench.scene},
                           {"ms_median", bench.ms_median},
                           {"ms_min", bench.ms_min},
                           {"ms_max", bench.ms_max},
                           {"cpu_ms_median", bench.cpu_ms_median},
                           {"n", bench.frames},
                           {"samples_per_pixel", bench.samples_per_pixel}};
    if (!bench.pass_ms.empty()) {
        line["pass_ms"] = bench.pass_ms;
    }
    return line;
}

}  // namespace bruma::measure
