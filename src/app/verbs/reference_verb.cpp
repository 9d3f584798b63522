#include "reference/volume/emission_absorption.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "app/scene_arguments.h"
#include "app/verbs/reference_body.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "base/log.h"
#include "io/picture/picture_file.h"
#include "reference/clouds/render_clouds.h"
#include "reference/medium/render_scattering.h"
#include "reference/sky/sky_picture.h"
#include "scene/sky/sun_lamp.h"

namespace bruma::app {
namespace {

struct ReferenceArguments {
    SceneArguments scene;
    std::string output;
    std::optional<double> tolerance;
    std::string light;
    std::string inside = "quadrature";
    bool force = false;
    std::uint64_t photons = 1'000'000;
    reference::ScatteringOptions scattering;
};

bool anything_scatters(const scene::Scene& scene) {
    const auto volumes = scene::shown_volumes(scene);
    return std::any_of(volumes.begin(), volumes.end(), [&](const std::string& name) {
        return scene::scatters(std::get<scene::Volume>(scene.nodes.at(name).content).optics->lighting);
    });
}

/// Surfaces are a look, not a medium: paths know phase functions only.
void say_what_paths_leave_out(const scene::Scene& scene) {
    for (const std::string& name : scene::shown_volumes(scene)) {
        const scene::VolumeOptics& optics = *std::get<scene::Volume>(scene.nodes.at(name).content).optics;
        if (scene::scatters(optics.lighting) && optics.surfaces) {
            log_warning("nodes.{}.surfaces: plays no part in multiple scattering; --light single shows it", name);
        }
    }
}

using Drawn = DrawnReference;

Drawn draw_emission_absorption(const ReferenceArguments& arguments, const scene::Scene& scene,
                               const std::function<void(double)>& progress) {
    if (!arguments.light.empty()) {
        log_warning("--light {}: nothing in this scene scatters light; set volume.lighting=path_traced",
                    arguments.light);
    }
    reference::ReferenceOptions options{.progress = progress};
    options.tolerance = arguments.tolerance.value_or(options.tolerance);
    const glm::ivec2 pixels = arguments.scene.pixels();
    auto result = reference::render_emission_absorption(scene, pixels.x, pixels.y, options);
    return {std::move(result.image), std::move(result.error),
            fmt::format("stated error: at most {:.2g}, RMS {:.2g} (display range 1); {:.1f} M evaluations",
                        result.largest_error, result.rms_error, 1e-6 * double(result.evaluations))};
}

Drawn draw_scattering(const ReferenceArguments& arguments, const scene::Scene& scene,
                      const std::function<void(double)>& progress) {
    reference::ScatteringOptions options = arguments.scattering;
    options.paths = arguments.light == "single" ? reference::LightPaths::single : reference::LightPaths::multiple;
    options.tolerance = arguments.tolerance.value_or(options.tolerance);
    options.progress = progress;
    const bool multiple = options.paths == reference::LightPaths::multiple;
    if (multiple) {
        say_what_paths_leave_out(scene);
    }
    const glm::ivec2 pixels = arguments.scene.pixels();
    auto result = reference::render_scattering(scene, pixels.x, pixels.y, options);
    std::vector<float> error;
    error.reserve(result.error.size());
    for (const glm::vec3& channels : result.error) {
        error.push_back(std::max({channels.x, channels.y, channels.z}));
    }
    if (!multiple) {
        return {std::move(result.image), std::move(error),
                fmt::format("single scattering, stated error: at most {:.2g}, RMS {:.2g} (display range 1); {:.1f} M "
                            "evaluations",
                            result.largest_error, result.rms_error, 1e-6 * double(result.evaluations))};
    }
    const std::string cut_off =
        result.cut_off_share > 0.0
            ? fmt::format("; {:.2g} of all paths cut off after {} bounces", result.cut_off_share, options.max_bounces)
            : "";
    return {std::move(result.image), std::move(error),
            fmt::format("multiple scattering, standard error: at most {:.2g}, RMS {:.2g} (display range 1){}; {} "
                        "samples a pixel, {:.1f} M collisions",
                        result.largest_error, result.rms_error, cut_off, options.samples,
                        1e-6 * double(result.evaluations))};
}

/// The volumes were drawn over black: adds the sky behind them, and says how well it is known.
void add_sky(Drawn& drawn, const scene::Scene& scene, const std::function<void(double)>& progress) {
    const auto sky = reference::render_sky(scene, drawn.image.width, drawn.image.height, 1000, progress);
    for (std::size_t n = 0; n < drawn.image.pixel_count(); ++n) {
        const float seen = 1.0F - drawn.image.rgba[4 * n + 3];
        for (std::size_t k = 4 * n; k < 4 * n + 3; ++k) {
            drawn.image.rgba[k] += seen * sky.image.rgba[k];
        }
        drawn.error[n] += seen * sky.error[n];
    }
    drawn.findings += fmt::format("; sky: half as many steps change it by at most {:.2g}, RMS {:.2g}",
                                  sky.largest_error, sky.rms_error);
}

/// The model of light of the scene's clouds by a fine march, or all orders of scattering by random paths.
Drawn draw_clouds(const ReferenceArguments& arguments, const scene::Scene& scene,
                  const std::function<void(double)>& progress) {
    reference::CloudImageOptions options;
    options.progress = progress;
    const bool multiple = arguments.light == "multiple";
    options.paths = multiple ? reference::LightPaths::multiple : reference::LightPaths::single;
    options.march.tolerance = arguments.tolerance.value_or(1e-3);
    options.samples = std::uint32_t(arguments.scattering.samples);
    const glm::ivec2 pixels = arguments.scene.pixels();
    auto result = reference::render_clouds(scene, pixels.x, pixels.y, options);
    std::vector<float> error;
    error.reserve(result.error.size());
    for (const glm::vec3& channels : result.error) {
        error.push_back(std::max({channels.x, channels.y, channels.z}));
    }
    return {std::move(result.image), std::move(error),
            fmt::format("clouds {}: at most {:.2g}, RMS {:.2g} (display range 1); {:.1f} M {}",
                        multiple ? "by all orders of scattering, standard error" : "as modelled, stated error",
                        result.largest_error, result.rms_error, 1e-6 * double(result.evaluations),
                        multiple ? "collisions" : "samples")};
}

Drawn draw_body(const ReferenceArguments& arguments, const scene::Scene& scene,
                const std::function<void(double)>& progress) {
    return draw_body_reference(scene, arguments.scene.pixels(),
                               {arguments.inside == "photons" ? reference::SubsurfaceMethod::random_walk
                                                              : reference::SubsurfaceMethod::quadrature,
                                arguments.tolerance, arguments.photons, arguments.scattering.seed, progress});
}

/// Says which of the given options the way that is taken does not read.
void say_what_plays_no_part(const CLI::App& app, const std::vector<std::string>& read) {
    std::string names;
    for (const char* const name :
         {"--light", "--tolerance", "--samples", "--inside", "--photons", "--max-bounces", "--seed"}) {
        if (app.get_option(name)->count() > 0 && std::find(read.begin(), read.end(), name) == read.end()) {
            names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
        }
    }
    if (!names.empty()) {
        log_warning("{}: plays no part in the reference of this scene; see 'bruma reference --help'", names);
    }
}

/// The options that the reference of a scene reads.
std::vector<std::string> options_read(const ReferenceArguments& arguments, bool clouds, bool meshes, bool scatters) {
    const bool paths = clouds ? arguments.light == "multiple" : scatters && arguments.light != "single";
    if (!clouds && meshes) {
        return arguments.inside == "photons" ? std::vector<std::string>{"--inside", "--photons", "--seed"}
                                             : std::vector<std::string>{"--inside", "--tolerance"};
    }
    if (!paths) {
        return {"--light", "--tolerance"};
    }
    return clouds ? std::vector<std::string>{"--light", "--samples"}
                  : std::vector<std::string>{"--light", "--samples", "--max-bounces", "--seed"};
}

int reference(const ReferenceArguments& arguments, const CLI::App& app) {
    if (io::picture_format(arguments.output) != io::PictureFormat::exr) {
        throw InputError(
            fmt::format("-o {}: the reference keeps its precision only in .exr; choose that ending", arguments.output));
    }
    io::OutputGuard outputs = guard_against(arguments.scene.files, arguments.force);
    outputs.add("-o", arguments.output, io::FileContent::exr);
    scene::Scene scene = scene::with_sun_as_lamp(open_scene(arguments.scene));
    outputs.check();
    const bool has_clouds = !scene::shown_clouds(scene).empty();
    if (scene.outdoors) {
        scene.background = scene::Background{};
    }
    const bool has_meshes = !scene::shown_meshes(scene).empty();
    say_what_plays_no_part(app, options_read(arguments, has_clouds, has_meshes, anything_scatters(scene)));
    const bool talks = ::isatty(2) != 0;
    std::function<void(double)> progress;
    if (talks) {
        progress = [](double share) { say("\r{:3.0f} %", 100.0 * share); };
    }
    const auto start = std::chrono::steady_clock::now();
    Drawn drawn = has_clouds                 ? draw_clouds(arguments, scene, progress)
                  : has_meshes               ? draw_body(arguments, scene, progress)
                  : anything_scatters(scene) ? draw_scattering(arguments, scene, progress)
                                             : draw_emission_absorption(arguments, scene, progress);
    if (scene.outdoors) {
        add_sky(drawn, scene, progress);
    }
    io::write_exr(arguments.output, drawn.image, {{"error", drawn.error}});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    say("{}{} in {:.1f} s\n", talks ? "\r" : "", drawn.findings, seconds);
    return int(ExitCode::done);
}

}  // namespace

Verb declare_reference(CLI::App& app) {
    auto arguments = std::make_shared<ReferenceArguments>();
    arguments->scene.declare(app, true);
    app.add_option("-o,--output", arguments->output,
                   "picture to write, .exr; its channel 'error' holds the stated error")
        ->required();
    app.add_option("--light", arguments->light,
                   "which light: multiple (all of it, by random paths; the default where anything scatters) or single "
                   "(scattered once, by quadrature)")
        ->check(CLI::IsMember({"single", "multiple"}));
    app.add_option("--tolerance", arguments->tolerance,
                   "error to aim at in each pixel, radiance (translucent meshes: relative); without: 1e-6, and 1e-3 "
                   "for --light "
                   "single and meshes")
        ->check(CLI::Range(1e-12, 1.0));
    app.add_option("--samples", arguments->scattering.samples,
                   "multiple: paths for each pixel; four times as many halve the error")
        ->check(CLI::Range(2, 1 << 30))
        ->capture_default_str();
    app.add_option("--inside", arguments->inside,
                   "translucent meshes: quadrature of the dipole, or photons, which follow no model")
        ->check(CLI::IsMember({"quadrature", "photons"}))
        ->capture_default_str();
    app.add_option("--photons", arguments->photons, "of each lamp and channel; four times as many halve the error")
        ->check(CLI::Range(std::uint64_t(1000), std::uint64_t(1) << 40))
        ->capture_default_str();
    app.add_option("--max-bounces", arguments->scattering.max_bounces,
                   "multiple: times that light is scattered before its path is cut off; 1 is single scattering")
        ->check(CLI::Range(1, 1 << 30))
        ->capture_default_str();
    app.add_option("--seed", arguments->scattering.seed, "multiple: another number gives an independent picture")
        ->capture_default_str();
    declare_force(app, arguments->force);
    return [arguments, &app] { return reference(*arguments, app); };
}

}  // namespace bruma::app
