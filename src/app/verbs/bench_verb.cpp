#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "app/scene_arguments.h"
#include "app/sibling.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "io/atomic_file.h"
#include "io/json/json_text.h"
#include "io/open.h"
#include "io/picture/picture_file.h"
#include "measure/bench/bench_frames.h"
#include "measure/bench/clouds/bench_clouds.h"
#include "measure/bench/light/bench_light_report.h"
#include "measure/bench/mesh/bench_mesh_report.h"
#include "measure/bench/volume/bench_findings.h"
#include "measure/bench/volume/bench_report.h"

namespace bruma::app {
namespace {

struct BenchArguments {
    SceneArguments scene;
    std::string output;
    std::string context = "auto";
    std::string picture;
    std::string only;
    int repeats = 3;
    int frames = 9;
    bool passes = false;
    int warmup = 2;
    double azimuth_step_deg = 3.0;
    bool quick = false;
    bool force = false;
};

/// All that a bench writes, judged before anything is computed.
io::OutputGuard guard_results(const BenchArguments& arguments, std::initializer_list<const char*> names) {
    io::require_writable_folder(arguments.output);
    io::OutputGuard outputs = guard_against(arguments.scene.files, arguments.force);
    if (!arguments.picture.empty()) {
        outputs.add("--picture-frame0", arguments.picture, io::FileContent::exr);
    }
    std::error_code error;
    if (!std::filesystem::is_directory(arguments.output, error)) {
        return outputs;  // nothing can be lost in a folder that is not there
    }
    for (const std::filesystem::path name : names) {
        outputs.add("-o", std::filesystem::path(arguments.output) / name,
                    name.extension() == ".csv"    ? io::FileContent::bench_table
                    : name.extension() == ".json" ? io::FileContent::bench_record
                                                  : io::FileContent::bench_page);
    }
    return outputs;
}

/// Each file is a scene of its own here, not a part of one.
scene::Scene open_one(const BenchArguments& arguments, const std::string& file) {
    SceneArguments one = arguments.scene;
    one.files = {file};
    return open_scene(one);
}

std::string scene_name(const std::string& file) {
    return file.starts_with("builtin:") ? file.substr(8) : std::filesystem::path(file).stem().string();
}

int bench_volume(const BenchArguments& arguments, const std::vector<std::string>& command_line) {
    const io::OutputGuard outputs = guard_results(arguments, {"volume.csv", "volume.json", "volume.html"});
    const glm::ivec2 pixels = arguments.scene.pixels();
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    std::vector<measure::BenchScene> scenes = measure::default_bench_scenes(double(pixels.x) / pixels.y);
    for (const std::string& file : arguments.scene.files) {
        scenes.push_back({scene_name(file), open_one(arguments, file)});
    }
    measure::VolumeBenchOptions options;
    options.pixels = pixels;
    options.repeats = arguments.repeats;
    options.quick = arguments.quick;
    options.say = [](const std::string& line) { say("{}\n", line); };
    outputs.check();
    const measure::VolumeBench bench = measure::run_volume_bench(scenes, options);
    measure::write_volume_bench(bench, arguments.output);
    for (const measure::VolumeBenchScene& scene : bench.scenes) {
        answer("{}: {}\n", scene.name, measure::finding_time(scene));
        answer("{}: {}\n", scene.name, measure::finding_order(scene));
        answer("{}: {}\n", scene.name, measure::finding_savings(scene));
    }
    answer("times are numbers of this machine; written: {}\n",
           (std::filesystem::path(arguments.output) / "volume.html").string());
    return int(ExitCode::done);
}

int bench_light(const BenchArguments& arguments, const std::vector<std::string>& command_line) {
    const io::OutputGuard outputs = guard_results(arguments, {"light.csv", "light.json", "light.html"});
    const glm::ivec2 pixels = arguments.scene.pixels();
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    measure::LightBenchOptions options;
    options.pixels = pixels;
    options.repeats = arguments.repeats;
    options.quick = arguments.quick;
    options.say = [](const std::string& line) { say("{}\n", line); };
    std::vector<measure::BenchScene> scenes = measure::default_light_scenes(double(pixels.x) / pixels.y);
    if (options.quick) {
        scenes.resize(1);
    }
    for (const std::string& file : arguments.scene.files) {
        scenes.push_back({scene_name(file), open_one(arguments, file)});
        measure::make_light_scene(scenes.back().scene);
    }
    outputs.check();
    const measure::LightBench bench = measure::run_light_bench(scenes, options);
    measure::write_light_bench(bench, arguments.output);
    for (const measure::LightBenchScene& scene : bench.scenes) {
        answer("{}: {}\n", scene.name, measure::finding_single(scene));
        answer("{}: {}\n", scene.name, measure::finding_multiple(scene));
        answer("{}: {}\n", scene.name, measure::finding_cost(scene));
    }
    for (const measure::LightBuildRow& row : bench.builds) {
        answer("{}\n", measure::finding_build(row));
    }
    answer("{}\ntimes are numbers of this machine; written: {}\n", measure::finding_batches(bench),
           (std::filesystem::path(arguments.output) / "light.html").string());
    return int(ExitCode::done);
}

int bench_mesh(const BenchArguments& arguments, const std::vector<std::string>& command_line) {
    const io::OutputGuard outputs =
        guard_results(arguments, {"mesh.csv", "mesh_sampling.csv", "mesh.json", "mesh.html"});
    const glm::ivec2 pixels = arguments.scene.pixels();
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    measure::MeshBenchOptions options;
    options.pixels = pixels;
    options.repeats = arguments.repeats;
    options.quick = arguments.quick;
    options.say = [](const std::string& line) { say("{}\n", line); };
    std::vector<measure::BenchScene> scenes = measure::default_mesh_scenes(double(pixels.x) / pixels.y);
    if (options.quick) {
        scenes.resize(1);
        options.frame_pixels = {128, 128};
        options.photons = 20'000;
        options.reference_tolerance = 5e-2;
    }
    for (const std::string& file : arguments.scene.files) {
        scenes.push_back({scene_name(file), open_one(arguments, file)});
        measure::make_mesh_scene(file, scenes.back().scene);
    }
    outputs.check();
    const measure::MeshBench bench = measure::run_mesh_bench(scenes, options);
    measure::write_mesh_bench(bench, arguments.output);
    for (const measure::MeshBenchScene& scene : bench.scenes) {
        answer("{}: {}\n", scene.name, measure::finding_quadrature(scene));
        answer("{}: {}\n", scene.name, measure::finding_maps(scene));
        answer("{}: {}\n", scene.name, measure::finding_walk(scene));
        answer("{}: {}\n", scene.name, measure::finding_combination(scene));
    }
    for (const std::string material : {"cream", "marble"}) {
        answer("{}\n", measure::finding_noise(bench.noise, material, true));
        answer("{}\n", measure::finding_noise(bench.noise, material, false));
    }
    for (const measure::SamplingRace& race : bench.races) {
        answer("{}\n", measure::finding_race(race));
    }
    answer("times are numbers of this machine; written: {}\n",
           (std::filesystem::path(arguments.output) / "mesh.html").string());
    return int(ExitCode::done);
}

int bench_clouds(const BenchArguments& arguments, const std::vector<std::string>& command_line) {
    const io::OutputGuard outputs = guard_results(arguments, {"clouds.csv", "clouds.json", "clouds.html"});
    measure::CloudBenchOptions options;
    options.pixels = arguments.scene.pixels();
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    options.repeats = arguments.repeats;
    options.only = arguments.only;
    options.quick = arguments.quick;
    if (options.quick) {
        options.truth_pixels = 84;
        options.bias_pixels = {6, 3};
        options.paths = 8;
    }
    options.say = [](const std::string& line) { say("{}\n", line); };
    options.change = [&](const scene::Scene& scene) {
        return io::with_settings(scene, arguments.scene.settings, {}, preset_folders());
    };
    options.keep = [&](const measure::CloudBench& bench) { measure::write_cloud_bench(bench, arguments.output); };
    measure::write_cloud_bench(measure::run_cloud_bench(options), arguments.output);
    answer("times are numbers of this machine; written: {}\n",
           (std::filesystem::path(arguments.output) / "clouds.html").string());
    return int(ExitCode::done);
}

int bench_frames(const BenchArguments& arguments, const std::vector<std::string>& command_line) {
    if (!arguments.picture.empty() && arguments.scene.files.size() != 1) {
        throw InputError(fmt::format("--picture-frame0 {}: one picture, but {} scenes; give one scene at a time",
                                     arguments.picture, arguments.scene.files.size()));
    }
    if (!arguments.picture.empty() && io::picture_format(arguments.picture) != io::PictureFormat::exr) {
        throw InputError(
            fmt::format("--picture-frame0 {}: only .exr keeps linear floats; choose that ending", arguments.picture));
    }
    const io::OutputGuard outputs = guard_results(arguments, {"frames.json"});
    const glm::ivec2 pixels = arguments.scene.pixels();
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    const measure::FramesBenchOptions options{pixels, arguments.azimuth_step_deg, arguments.frames, arguments.warmup,
                                              arguments.passes};
    nlohmann::json results = nlohmann::json::array();
    for (const std::string& file : arguments.scene.files) {
        const scene::Scene scene = open_one(arguments, file);
        outputs.check();
        const measure::FramesBench bench = measure::run_frames_bench(scene_name(file), scene, options);
        results.push_back(measure::to_json(bench));
        answer("{}\n", io::report_text(results.back(), -1));
        if (!arguments.picture.empty()) {
            io::write_exr(arguments.picture, bench.first_frame);
        }
    }
    const nlohmann::json document = {{"bench", "frames"},
                                     {"machine", measure::to_json(measure::describe_machine())},
                                     {"parameters",
                                      {{"pixels", {pixels.x, pixels.y}},
                                       {"azimuth_step_deg", options.azimuth_step_deg},
                                       {"repeats", options.repeats},
                                       {"warmup", options.warmup}}},
                                     {"scenes", results}};
    std::error_code error;
    std::filesystem::create_directories(arguments.output, error);
    io::write_file_atomically(std::filesystem::path(arguments.output) / "frames.json",
                              io::report_text(document, 1) + "\n");
    return int(ExitCode::done);
}

}  // namespace

Verb declare_bench(CLI::App& app, const std::vector<std::string>& command_line) {
    auto arguments = std::make_shared<BenchArguments>();
    const auto suite = [&](const char* name, const char* sentence, bool with_files = true) {
        CLI::App* verb = app.add_subcommand(name, sentence);
        arguments->scene.size.clear();
        if (with_files) {
            arguments->scene.declare(*verb, true);
        }
        verb->add_option("-o,--output", arguments->output, "folder for the results; made if it is not there")
            ->required();
        verb->add_option("--context", arguments->context, "auto, egl or osmesa");
        declare_force(*verb, arguments->force);
        verb->fallthrough();  // --verbose and --shaders stand on the verb itself
        return verb;
    };
    CLI::App* volume =
        suite("volume", "volumes: run time against error, with plots; FILEs are added to the usual scenes");
    volume->add_option("--repeats", arguments->repeats, "rounds of timed frames")->check(CLI::Range(1, 1000));
    volume->add_flag("--quick", arguments->quick, "fewer steps and settings");
    CLI::App* light = suite("light",
                            "light in volumes: what each way costs and how far it is from the truth; FILEs, of "
                            "one volume each, are added to the usual scenes");
    light->add_option("--repeats", arguments->repeats, "rounds of timed frames")->check(CLI::Range(1, 1000));
    light->add_flag("--quick", arguments->quick, "one scene, without full resolution");
    CLI::App* mesh = suite("mesh",
                           "light inside translucent meshes: what each setting costs and how far it is from the truth; "
                           "FILEs, of one mesh each, are added to the usual scenes");
    mesh->add_option("--repeats", arguments->repeats, "rounds of timed frames")->check(CLI::Range(1, 1000));
    mesh->add_flag("--quick", arguments->quick, "one scene, small maps");
    CLI::App* clouds =
        suite("clouds", "clouds: what each technique of the march costs and how far it is from the truth", false);
    clouds->add_option("--set", arguments->scene.settings, "PATH=VALUE: what is to be different in all scenes");
    clouds->add_option("--size", arguments->scene.size, "pixels of the pictures, as 512x288");
    clouds->add_option("--repeats", arguments->repeats, "timed frames")->check(CLI::Range(1, 1000));
    clouds->add_flag("--quick", arguments->quick, "from below, fewer settings, a rough truth");
    clouds->add_option("--only", arguments->only, "only views with this in 'PRESET VIEW', as in 'stratus below'");
    CLI::App* frames = suite("frames", "frames along an orbit around each scene, as other programs measure theirs");
    frames->add_option("--repeats", arguments->frames, "frames that count")->check(CLI::Range(1, 100000));
    frames->add_flag("--passes", arguments->passes, "also what each pass takes, over as many frames again");
    frames->add_option("--warmup", arguments->warmup, "frames before them")->check(CLI::Range(0, 1000));
    frames->add_option("--azimuth-step", arguments->azimuth_step_deg, "degrees from one frame to the next, about +y")
        ->check(CLI::Range(-360.0, 360.0));
    frames->add_option("--picture-frame0", arguments->picture, ".exr: the first frame, linear");
    refuse_empty_words(*frames, {"--picture-frame0"});
    refuse_empty_words(*clouds, {"--only", "--size"});
    frames->get_option("files")->required();
    app.require_subcommand(1);
    return [arguments, command_line, frames, light, clouds, mesh, volume] {
        if (arguments->scene.files.empty()) {
            for (const CLI::App* verb : {light, mesh, volume}) {
                refuse_if_given(
                    *verb,
                    {"--set", "--dims", "--type", "--spacing", "--offset", "--endian", "--camera", "--time", "--up"},
                    "is about the FILEs, but there are none; name one or leave it out");
            }
        }
        if (arguments->scene.size.empty()) {  // references of light are slow, and smooth light needs few pixels
            arguments->scene.size = light->parsed()    ? "96x96"
                                    : mesh->parsed()   ? "24x24"
                                    : clouds->parsed() ? "512x288"
                                                       : "512x512";
        }
        if (clouds->parsed()) {
            return bench_clouds(*arguments, command_line);
        }
        if (mesh->parsed()) {
            return bench_mesh(*arguments, command_line);
        }
        if (light->parsed()) {
            return bench_light(*arguments, command_line);
        }
        return frames->parsed() ? bench_frames(*arguments, command_line) : bench_volume(*arguments, command_line);
    };
}

}  // namespace bruma::app
