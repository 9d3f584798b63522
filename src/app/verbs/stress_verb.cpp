#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/scene_arguments.h"
#include "app/sibling.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "measure/stress/stress.h"

namespace bruma::app {
namespace {

struct StressArguments {
    std::string context = "auto";
    measure::StressOptions options;
};

using Suite = std::vector<measure::StressVerdict> (*)(const measure::StressOptions&);

int run_suite(Suite suite, const StressArguments& arguments, const std::vector<std::string>& command_line) {
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    measure::StressOptions options = arguments.options;
    options.say = [](const measure::StressVerdict& verdict) { answer("{}\n", measure::line_of(verdict)); };
    const std::vector<measure::StressVerdict> verdicts = suite(options);
    if (verdicts.empty()) {
        throw InputError(fmt::format("--only {}: no case has this in its name; run without it to see them all",
                                     arguments.options.only));
    }
    answer("\n{}", measure::summary_of(verdicts));
    const bool all_ok = std::all_of(verdicts.begin(), verdicts.end(), [](const auto& verdict) { return verdict.ok; });
    return int(all_ok ? ExitCode::done : ExitCode::answer_is_no);
}

}  // namespace

Verb declare_stress(CLI::App& app, const std::vector<std::string>& command_line) {
    auto arguments = std::make_shared<StressArguments>();
    const auto suite = [&](const char* name, const char* sentence) {
        CLI::App* verb = app.add_subcommand(name, sentence);
        verb->add_option("--context", arguments->context, "auto, egl or osmesa");
        verb->add_option("--only", arguments->options.only, "only cases with this in GROUP/NAME");
        refuse_empty_words(*verb, {"--only"});
        verb->fallthrough();  // --verbose and --shaders stand on the verb itself
        return verb;
    };
    CLI::App* volume = suite("volume", "measured volumes: values, curves, cameras, placement, march, lights");
    volume->add_option("--random", arguments->options.random_scenes, "how many scenes to draw at random")
        ->check(CLI::Range(0, 1000000));
    const CLI::App* light = suite("light", "light that scatters in volumes: optics, lamps, shapes, motion");
    CLI::App* clouds = suite("clouds", "clouds: sun, cameras, layers, weather maps, history");
    clouds->add_option("--random", arguments->options.random_scenes, "how many frames to draw with random parameters")
        ->check(CLI::Range(0, 1000000));
    CLI::App* mesh = suite("mesh", "meshes: files, textures, shapes, placement, matter, lamps, invariants");
    mesh->add_option("--pieces", arguments->options.pieces, "pieces of the mesh that falls into many")
        ->check(CLI::Range(1, 4000000));
    app.require_subcommand(1);
    return [arguments, command_line, light, clouds, mesh] {
        return run_suite(mesh->parsed()     ? measure::run_mesh_stress
                         : clouds->parsed() ? measure::run_cloud_stress
                         : light->parsed()  ? measure::run_light_stress
                                            : measure::run_volume_stress,
                         *arguments, command_line);
    };
}

}  // namespace bruma::app
