#include "app/frame_statistics.h"

#include <GL/glew.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <numbers>

#include "context/context.h"

namespace bruma::app {
namespace {

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Largest source radiance behind a terminated ray: colours with their glow, and the background.
double largest_radiance(const scene::Scene& scene) {
    const auto largest = [](glm::dvec3 v) { return std::max({v.x, v.y, v.z}); };
    double most = std::max(largest(scene.background->top), largest(scene.background->bottom));
    double light = 1.0;
    for (const auto& [name, lamp] : scene.lights) {
        light += scene::shines(*lamp) ? lamp->intensity * largest(lamp->color) / std::numbers::pi : 0.0;
    }
    for (const std::string& name : scene::shown_meshes(scene)) {
        const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(name).content);
        for (std::size_t n = 0; n < (*mesh.triangles)->materials.size(); ++n) {
            const scene::MeshMaterial shown = scene::shown_material(**mesh.triangles, *mesh.surface, n);
            const double around = light + largest(scene.environment->radiance);
            most = std::max(most, largest(shown.diffuse) * (shown.constant ? 1.0 : around) + largest(shown.emission) +
                                      largest(shown.specular) * light);
        }
    }
    for (const std::string& name : scene::shown_volumes(scene)) {
        const auto& volume = std::get<scene::Volume>(scene.nodes.at(name).content);
        const bool lit = volume.optics->lighting != scene::VolumeLighting::none;
        for (int n = 0; n <= 256; ++n) {
            const double c = largest(scene::color_at(*volume.transfer_function, n / 256.0));
            const double e = volume.optics->emission + scene::emission_at(*volume.transfer_function, n / 256.0);
            const double shaded =
                c * (volume.optics->ambient + volume.optics->diffuse * light) + volume.optics->specular * light;
            most = std::max(most, (lit ? std::max(c, shaded) : c) + c * e);
        }
    }
    return most;
}

FrameStatistics measure_paths(gl::ShaderLibrary& shaders, const scene::Scene& scene, const render::View& view) {
    render::Renderer renderer(shaders);
    FrameStatistics statistics;
    statistics.passes = renderer.render(scene, view, true);
    PathFigures figures{renderer.path_standing().value(), 0.0};
    for (const render::PassReport& pass : statistics.passes) {
        figures.ms += pass.name == "path trace" ? pass.gpu_ms : 0.0;
    }
    statistics.paths = figures;
    return statistics;
}

nlohmann::json figures_of_march(const FrameStatistics& s) {
    return {{"step_mm", s.step_mm},
            {"early_termination_error_bound", s.termination_bound},
            {"frame",
             {{"march_ms_median", s.frame_ms},
              {"samples", s.samples.samples},
              {"samples_per_pixel", s.samples.samples_per_pixel},
              {"emptiness_queries", s.samples.emptiness_queries}}},
            {"brute_force",
             {{"march_ms_median", s.brute_ms},
              {"samples", s.brute_samples.samples},
              {"samples_per_pixel", s.brute_samples.samples_per_pixel}}},
            {"ratio",
             {{"time", s.brute_ms / std::max(1e-9, s.frame_ms)},
              {"samples", double(s.brute_samples.samples) / double(std::max<std::uint64_t>(1, s.samples.samples))}}}};
}

nlohmann::json figures_of_paths(const PathFigures& figures) {
    nlohmann::json error;  // null below two paths
    if (figures.standing.standard_error) {
        error = *figures.standing.standard_error;
    }
    return {{"paths",
             {{"samples", figures.standing.samples},
              {"standard_error", error},
              {"ms", figures.ms},
              {"ms_per_sample", figures.ms / std::max(1, figures.standing.samples)}}}};
}

}  // namespace

std::string explanation(const render::RunReport& report) {
    std::size_t width = 4;
    for (const render::PassReport& pass : report) {
        width = std::max(width, pass.name.size());
    }
    std::string text = fmt::format("{:{}}  {:7}  {:>8}  {:>8}  why\n", "pass", width, "", "CPU ms", "GPU ms");
    for (const render::PassReport& pass : report) {
        const std::string cpu = pass.ran ? fmt::format("{:.2f}", pass.cpu_ms) : "-";
        const std::string gpu = pass.ran && pass.gpu_ms >= 0.0 ? fmt::format("{:.2f}", pass.gpu_ms) : "-";
        text += fmt::format("{:{}}  {:7}  {:>8}  {:>8}  {}{}\n", pass.name, width, pass.ran ? "ran" : "skipped", cpu,
                            gpu, pass.reason, pass.note.empty() ? "" : " (" + pass.note + ")");
    }
    return text;
}

FrameStatistics measure_frame(gl::ShaderLibrary& shaders, const scene::Scene& scene, const render::View& view,
                              int repeats) {
    if (render::is_path_traced(scene)) {
        return measure_paths(shaders, scene, view);
    }
    struct Stand {
        render::Renderer renderer;
        scene::Scene scene;
        std::vector<double> ms;
    };
    Stand fast{render::Renderer(shaders), scene, {}};
    Stand brute{render::Renderer(shaders), scene, {}};
    brute.scene.rendering.edit([](scene::RenderSettings& settings) {
        settings.empty_space_skipping = false;
        settings.early_termination = false;
    });
    FrameStatistics statistics;
    statistics.passes = fast.renderer.render(fast.scene, view, true);
    statistics.inside = fast.renderer.translucent_standing();
    statistics.samples = fast.renderer.count_samples(fast.scene, view);
    brute.renderer.render(brute.scene, view);
    statistics.brute_samples = brute.renderer.count_samples(brute.scene, view);
    statistics.step_mm = 1e3 * render::Renderer::step_world(scene) * view.step_scale;
    if (scene.rendering->early_termination) {
        statistics.termination_bound = scene.rendering->stop_transmittance * largest_radiance(scene);
    }
    for (int n = 0; n < repeats; ++n) {
        for (Stand* stand : {&fast, &brute}) {
            // A background of another colour makes the picture stale, and nothing but the picture.
            stand->scene.background.edit([](scene::Background& b) { b.top.x += b.top.x < 1e-9 ? 1e-9 : -1e-9; });
            glFinish();
            const auto start = std::chrono::steady_clock::now();
            stand->renderer.render(stand->scene, view);
            glFinish();
            stand->ms.push_back(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
    }
    statistics.frame_ms = median(fast.ms);
    statistics.brute_ms = median(brute.ms);
    return statistics;
}

nlohmann::json to_json(const FrameStatistics& s) {
    const context::DriverInfo driver = context::driver_info();
    nlohmann::json passes = nlohmann::json::array();
    for (const render::PassReport& pass : s.passes) {
        passes.push_back({{"name", pass.name},
                          {"computes", pass.sentence},
                          {"ran", pass.ran},
                          {"reason", pass.reason},
                          {"cpu_ms", pass.cpu_ms},
                          {"gpu_ms", pass.gpu_ms},
                          {"note", pass.note}});
    }
    nlohmann::json json = s.paths ? figures_of_paths(*s.paths) : figures_of_march(s);
    if (s.inside) {
        nlohmann::json noise;  // null below two passes
        if (s.inside->noise < 1e29) {
            noise = s.inside->noise;
        }
        json["translucent"] = {{"passes", s.inside->passes},
                               {"noise", noise},
                               {"settled", s.inside->settled},
                               {"pixels_that_no_map_sees", s.inside->unseen_pixels}};
    }
    json["driver"] = {{"vendor", driver.vendor}, {"renderer", driver.renderer}, {"version", driver.version}};
    json["passes"] = passes;
    return json;
}

std::string summary(const FrameStatistics& s) {
    if (s.paths) {
        const render::PathStanding& standing = s.paths->standing;
        const std::string error =
            standing.standard_error ? fmt::format("{:.3g}", *standing.standard_error) : "unknown below two";
        return fmt::format("{} paths per pixel in {:.0f} ms, standard error {}\n", standing.samples, s.paths->ms,
                           error);
    }
    return fmt::format(
        "march {:.1f} ms, {:.1f} samples per pixel ({:.2f} M, {:.2f} M queries of emptiness)\n"
        "without skipping and early termination {:.1f} ms, {:.1f} samples per pixel ({:.2f} M): {:.2f} x the time, "
        "{:.2f} x the samples\n"
        "early termination changes no pixel by more than {:.2g}; skipping changes none\n",
        s.frame_ms, s.samples.samples_per_pixel, 1e-6 * double(s.samples.samples),
        1e-6 * double(s.samples.emptiness_queries), s.brute_ms, s.brute_samples.samples_per_pixel,
        1e-6 * double(s.brute_samples.samples), s.brute_ms / std::max(1e-9, s.frame_ms),
        double(s.brute_samples.samples) / double(std::max<std::uint64_t>(1, s.samples.samples)), s.termination_bound);
}

}  // namespace bruma::app
