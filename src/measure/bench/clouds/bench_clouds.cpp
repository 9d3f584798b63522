#include "measure/bench/clouds/bench_clouds.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "base/installation.h"
#include "reference/clouds/render_clouds.h"
#include "render/renderer.h"
#include "scene/builtin/builtin_clouds.h"

namespace bruma::measure {
namespace {

struct Technique {
    std::string name;
    std::function<void(scene::CloudMarch&)> change;
};

std::vector<Technique> techniques(bool quick) {
    std::vector<Technique> all{
        {"usual", [](auto&) {}},
        {"no skipping", [](auto& march) { march.empty_space_skipping = false; }},
        {"no big steps", [](auto& march) { march.big_steps = false; }},
        {"no early end", [](auto& march) { march.early_termination = false; }},
        {"steps of one length", [](auto& march) { march.optical_step = 0.0; }},
        {"cone", [](auto& march) { march.sun_path = scene::CloudSunPath::cone; }},
        {"detail everywhere", [](auto& march) { march.detail_where_it_shows = false; }},
        {"hashed jitter", [](auto& march) { march.jitter = scene::Jitter::hashed; }},
        {"blue noise", [](auto& march) { march.jitter = scene::Jitter::blue_noise; }},
        {"none of them",
         [](auto& march) {
             march.empty_space_skipping = march.big_steps = march.early_termination = false;
             march.optical_step = 0.0;
         }},
    };
    if (!quick) {
        all.push_back({"fine grid of light", [](auto& march) { march.grid_columns = 512; }});
    }
    return all;
}

/// Lengths of the shortest segment, the usual one first.
std::vector<double> steps_m(bool quick) {
    const double usual = scene::CloudMarch{}.step_m;
    return quick ? std::vector{usual} : std::vector{usual, 4.0 * usual, 2.0 * usual, 0.5 * usual};
}

void set_step(scene::CloudMarch& march, double step_m) {
    const double share = step_m / march.step_m;
    march.step_m = step_m;
    march.step_growth *= share;
    march.optical_step *= std::min(2.0, share);
}

/// Turns the camera a little: a frame that nothing but its view makes new.
void turn(scene::Scene& scene, double degrees) {
    scene.camera->edit([&](scene::Camera& camera) {
        const glm::dvec3 ahead = camera.target_world - camera.eye_world;
        const double angle = glm::radians(degrees);
        camera.target_world =
            camera.eye_world + glm::dvec3(ahead.x * std::cos(angle) - ahead.z * std::sin(angle), ahead.y,
                                          ahead.x * std::sin(angle) + ahead.z * std::cos(angle));
    });
}

struct Timed {
    double ms = 0.0, cpu_ms = 0.0;
};

/// The middle of some frames along a small turn there and back.
Timed timed_frames(render::Renderer& renderer, scene::Scene scene, const render::View& view, int repeats) {
    renderer.render(scene, view);
    std::vector<double> wall, cpu;
    for (int n = 0; n < std::max(3, repeats); ++n) {
        turn(scene, n % 2 == 0 ? 0.2 : -0.2);
        const Duration took = drained([&] { renderer.render(scene, view); });
        wall.push_back(took.wall_ms);
        cpu.push_back(took.cpu_ms);
    }
    return {median(wall), median(cpu)};
}

CloudBenchRow row_of(render::Renderer& renderer, scene::Scene scene, const Technique& technique, double step_m,
                     const Image& truth, const std::vector<std::size_t>& places, const CloudBenchOptions& options) {
    scene::clouds_in(scene).march.edit([&](scene::CloudMarch& march) {
        set_step(march, step_m);
        technique.change(march);
    });
    CloudBenchRow row{.technique = technique.name, .step_m = step_m};
    const render::View view{options.pixels, 1.0};
    renderer.render(scene, view);
    row.error = error_at(places, renderer.read_picture(), truth);
    const Timed took = timed_frames(renderer, scene, view, options.repeats);
    row.ms = took.ms;
    row.cpu_ms = took.cpu_ms;
    const render::CloudTotals totals = renderer.count_clouds(scene, view);
    const double pixels = double(options.pixels.x) * options.pixels.y;
    row.turns = double(totals.turns) / pixels;
    row.weather = double(totals.weather) / pixels;
    row.noise = double(totals.noise) / pixels;
    row.light = double(totals.light) / pixels;
    return row;
}

/// Deviation of each channel over frames at rest, as a root mean square over all of them.
double flicker(render::Renderer& renderer, const scene::Scene& scene, const render::View& view, int frames) {
    std::vector<double> sum, squares;
    for (int n = 0; n < frames; ++n) {
        renderer.render(scene, view);
        const Image image = renderer.read_picture();
        sum.resize(image.rgba.size());
        squares.resize(image.rgba.size());
        for (std::size_t k = 0; k < image.rgba.size(); ++k) {
            sum[k] += image.rgba[k];
            squares[k] += double(image.rgba[k]) * image.rgba[k];
        }
    }
    double total = 0.0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        const double mean = sum[k] / frames;
        total += std::max(0.0, squares[k] / frames - mean * mean);
    }
    return std::sqrt(total / double(std::max<std::size_t>(1, sum.size())));
}

CloudPan pan_of(gl::ShaderLibrary& shaders, scene::Scene scene, const CloudBenchOptions& options) {
    const render::View view{options.pixels, 1.0};
    std::vector<std::size_t> everywhere(std::size_t(options.pixels.x) * options.pixels.y);
    std::iota(everywhere.begin(), everywhere.end(), std::size_t(0));
    render::Renderer full(shaders), reprojected(shaders);
    CloudPan pan;
    const Timed whole = timed_frames(full, scene, view, options.repeats);
    pan.full_ms = whole.ms;
    pan.full_cpu_ms = whole.cpu_ms;
    scene::Scene sparse = scene;
    scene::clouds_in(sparse).march.edit(
        [](scene::CloudMarch& march) { march.reprojection = scene::CloudReprojection::always; });
    reprojected.render(sparse, view);
    std::vector<double> wall, cpu;
    for (int frame = 0; frame < 32; ++frame) {
        // Ten degrees a second at 30 frames a second, under the wind.
        turn(scene, 1.0 / 3.0);
        scene.time.edit([](scene::Timeline& timeline) { timeline.now_s += 1.0 / 30.0; });
        sparse.camera = scene.camera;
        sparse.time = scene.time;
        const Duration took = drained([&] { reprojected.render(sparse, view); });
        wall.push_back(took.wall_ms);
        cpu.push_back(took.cpu_ms);
        if (frame % 8 == 7) {
            full.render(scene, view);
            pan.rmse_in_motion = std::max(pan.rmse_in_motion,
                                          error_at(everywhere, reprojected.read_picture(), full.read_picture()).rmse);
        }
    }
    pan.ms = median(wall);
    pan.cpu_ms = median(cpu);
    const Image truth = full.read_picture();
    while (reprojected.missing_cloud_turns() > 0) {
        reprojected.render(sparse, view);
    }
    pan.rmse_at_rest = error_at(everywhere, reprojected.read_picture(), truth).rmse;
    pan.flicker = flicker(reprojected, sparse, view, options.quick ? 4 : 64);
    return pan;
}

/// What strata cost beside cumulus of the same view, at the error that those have with the usual settings.
void say_costs(const CloudBench& bench) {
    for (const CloudBenchScene& strata : bench.scenes) {
        const auto heap = std::find_if(bench.scenes.begin(), bench.scenes.end(), [&](const CloudBenchScene& other) {
            return other.preset == "cumulus" && other.view == strata.view;
        });
        if (heap == bench.scenes.end()) {
            continue;
        }
        const double rmse = heap->rows.front().error.rmse;
        if (const auto cost = cost_beside(strata, *heap, rmse); cost && strata.preset != "cumulus") {
            bench.options.say(fmt::format("{} {}: {:.2g} times the lookups of cumulus at an RMSE of {:.2g}",
                                          strata.preset, strata.view, *cost, rmse));
        }
    }
}

/// Whether whole words of a name are those: 'cumulus' is not stratocumulus.
bool is_wanted(const std::string& name, const std::string& words) {
    return (" " + name + " ").find(words.empty() ? "" : " " + words + " ") != std::string::npos;
}

}  // namespace

scene::Scene cloud_view(scene::CloudType type, const std::string& view) {
    scene::Scene scene = scene::builtin_cloud_scene(type);
    const scene::CloudLayer& layer = *scene::clouds_in(scene).layer;
    if (view != "below") {
        const bool inside = view == "inside";
        const double altitude = layer.bottom_m + (inside ? 0.25 : 1.3) * (layer.top_m - layer.bottom_m);
        scene.camera->edit([&](scene::Camera& camera) {
            camera.eye_world = {0.0, altitude, 0.0};
            camera.target_world = camera.eye_world + glm::dvec3(0.5, inside ? 0.02 : -0.3, -0.8);
        });
    }
    return scene;
}

CloudBench run_cloud_bench(const CloudBenchOptions& options) {
    CloudBench bench{describe_machine(), options, {}};
    gl::ShaderLibrary shaders(installed_folder("shaders"));
    const std::vector<std::string> views = options.quick && options.only.empty()
                                               ? std::vector<std::string>{"below"}
                                               : std::vector<std::string>{"below", "inside", "above"};
    for (const scene::CloudType type :
         {scene::CloudType::cumulus, scene::CloudType::stratocumulus, scene::CloudType::stratus}) {
        for (const std::string& view : views) {
            CloudBenchScene result{
                std::string(scene::enum_words<scene::CloudType>()[std::size_t(type)]), view, 0.0, {}, {}};
            if (!is_wanted(fmt::format("{} {}", result.preset, view), options.only)) {
                continue;
            }
            const scene::Scene scene = options.change ? options.change(cloud_view(type, view)) : cloud_view(type, view);
            const auto start = std::chrono::steady_clock::now();
            reference::CloudImageOptions exact;
            exact.fixed_step_m = options.quick ? 24.0 : 8.0;
            exact.fixed_sun_samples = options.quick ? 32 : 96;
            exact.march.stop_transmittance = 1e-4;
            const std::vector<std::size_t> places = spread_pixels(options.pixels, options.truth_pixels);
            exact.wanted.assign(std::size_t(options.pixels.x) * options.pixels.y, 0);
            for (const std::size_t place : places) {
                exact.wanted[place] = 1;
            }
            const Image truth = reference::render_clouds(scene, options.pixels.x, options.pixels.y, exact).image;
            result.reference_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            render::Renderer renderer(shaders);  // one for all, so that noise and grids are made once
            for (const double step_m : steps_m(options.quick)) {
                for (const Technique& technique : techniques(options.quick)) {
                    result.rows.push_back(row_of(renderer, scene, technique, step_m, truth, places, options));
                }
            }
            result.pan = pan_of(shaders, scene, options);
            if (options.paths > 0) {
                result.bias = multiple_scattering_bias(scene, options.bias_pixels, options.paths);
            }
            if (options.say) {
                options.say(fmt::format("{} {}: {}", result.preset, result.view, finding(result)));
                options.say(fmt::format("{} {}: {}", result.preset, result.view, finding_bias(result)));
            }
            bench.scenes.push_back(std::move(result));
            if (options.keep) {
                options.keep(bench);
            }
        }
    }
    if (bench.scenes.empty()) {
        throw InputError(fmt::format(
            "--only '{}': no such view; there are cumulus, stratocumulus and stratus, each below, inside and above",
            options.only));
    }
    if (options.say) {
        say_costs(bench);
    }
    return bench;
}

}  // namespace bruma::measure
