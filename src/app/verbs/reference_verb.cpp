#include "reference/emission_absorption.h"

#include <fmt/core.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>

#include "app/scene_arguments.h"
#include "app/verbs/verbs.h"
#include "base/error.h"
#include "io/atomic_file.h"
#include "io/picture_file.h"

namespace bruma::app {
namespace {

struct ReferenceArguments {
    SceneArguments scene;
    std::string output;
    double tolerance = 1e-6;
};

int reference(const ReferenceArguments& arguments) {
    const glm::ivec2 pixels = arguments.scene.pixels();
    if (io::picture_format(arguments.output) != io::PictureFormat::exr) {
        throw InputError(
            fmt::format("-o {}: the reference keeps its precision only in .exr; choose that ending", arguments.output));
    }
    io::require_writable(arguments.output);
    const scene::Scene scene = open_scene(arguments.scene);
    reference::ReferenceOptions options;
    options.tolerance = arguments.tolerance;
    const bool talks = ::isatty(2) != 0;
    if (talks) {
        options.progress = [](double share) { fmt::print(stderr, "\r{:3.0f} %", 100.0 * share); };
    }
    const auto start = std::chrono::steady_clock::now();
    const reference::ReferenceImage result = reference::render_emission_absorption(scene, pixels.x, pixels.y, options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    io::write_exr(arguments.output, result.image, {{"error", result.error}});
    fmt::print(stderr,
               "{}stated error: at most {:.2g}, RMS {:.2g} (display range 1); {:.1f} M evaluations in {:.1f} s\n",
               talks ? "\r" : "", result.largest_error, result.rms_error, 1e-6 * double(result.evaluations), seconds);
    return int(ExitCode::done);
}

}  // namespace

Verb declare_reference(CLI::App& app) {
    auto arguments = std::make_shared<ReferenceArguments>();
    arguments->scene.declare(app, true);
    app.add_option("-o,--output", arguments->output,
                   "picture to write, .exr; its channel 'error' holds the stated error")
        ->required();
    app.add_option("--tolerance", arguments->tolerance, "error to aim at in each pixel, radiance")
        ->check(CLI::Range(1e-12, 1.0));
    return [arguments] { return reference(*arguments); };
}

}  // namespace bruma::app
