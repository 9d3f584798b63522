#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>

#include "app/exposure.h"
#include "app/frame_statistics.h"
#include "app/nothing_seen.h"
#include "app/scene_arguments.h"
#include "app/sibling.h"
#include "app/verbs/contact_sheet.h"
#include "app/verbs/verbs.h"
#include "base/console.h"
#include "base/error.h"
#include "base/installation.h"
#include "base/log.h"
#include "base/memory.h"
#include "io/atomic_file.h"
#include "io/json/json_text.h"
#include "io/picture/picture_file.h"
#include "render/compose/presenter.h"
#include "render/paths/path_trace_pass.h"

namespace bruma::app {
namespace {

struct RenderArguments {
    SceneArguments scene;
    std::string output;
    std::string context = "auto";
    std::string stats;
    std::string graph;
    std::string frames;
    std::string across, down;
    bool explain = false;
    bool auto_exposure = false;
    bool force = false;
    int repeats = 5;
    render::PathGoal paths;
};

/// Refuses a picture that would not fit before anything is loaded.
void check_room(glm::ivec2 pixels) {
    const context::DriverInfo driver = context::driver_info();
    if (std::max(pixels.x, pixels.y) > driver.largest_2d_texture) {
        throw InputError(fmt::format("--size {}x{}: this driver draws at most {} pixels along an edge; choose less",
                                     pixels.x, pixels.y, driver.largest_2d_texture));
    }
    // Picture, its copy in memory and the display values.
    const std::uint64_t needed = std::uint64_t(pixels.x) * pixels.y * (16 + 32 + 12);
    if (needed > available_memory()) {
        throw InputError(fmt::format("--size {}x{}: needs {} MiB, but {} MiB are free; choose less", pixels.x, pixels.y,
                                     needed >> 20, available_memory() >> 20));
    }
}

/// Numbers of the first and the last picture of --frames.
struct FrameRange {
    int first = 0, last = 0;
};

std::optional<FrameRange> frame_range(const std::string& words) {
    if (words.empty()) {
        return std::nullopt;
    }
    FrameRange range;
    const char* const end = words.data() + words.size();
    const auto first = std::from_chars(words.data(), end, range.first);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ':') {
        const auto last = std::from_chars(first.ptr + 1, end, range.last);
        if (last.ec == std::errc() && last.ptr == end && range.first >= 0 && range.last >= range.first &&
            range.last < 1'000'000) {
            return range;
        }
    }
    throw InputError(
        fmt::format("--frames {}: not two numbers of pictures from 0 to 999999, the first not above the "
                    "last; write them as 0:99",
                    words));
}

/// The names of pictures of many: cloud.png becomes cloud_0007.png. All have as many digits as the last, and at least
/// four, so that their names sort as their numbers do.
std::vector<std::filesystem::path> numbered_names(const std::string& output, const FrameRange& range) {
    const std::filesystem::path path(output);
    const std::size_t digits = std::max<std::size_t>(4, std::to_string(range.last).size());
    std::vector<std::filesystem::path> names;
    for (int frame = range.first; frame <= range.last; ++frame) {
        names.push_back(path.parent_path() /
                        fmt::format("{}_{:0{}}{}", path.stem().string(), frame, digits, path.extension().string()));
    }
    return names;
}

/// Gives the scene the exposure that suits its picture, and says which.
void expose(scene::Scene& scene, const Image& picture) {
    if (const std::optional<SuitableExposure> suitable = suitable_exposure(picture, scene)) {
        scene.display.edit([&](scene::Display& display) { display.exposure_ev = suitable->ev; });
        log_note("--set display.exposure={:.2f} gives this exposure again", suitable->ev);
        if (suitable->limited) {
            log_warning("--auto-exposure: {}", limit_words(*suitable));
        }
    } else {
        log_warning("--auto-exposure: the picture is black, so its exposure stays as it was");
    }
}

void write(const std::string& output, const render::Renderer& renderer, render::Presenter& presenter,
           const scene::Scene& scene) {
    if (io::picture_format(output) == io::PictureFormat::png) {
        const glm::ivec2 pixels(renderer.picture().color.size());
        io::write_png(output, {pixels.x, pixels.y, presenter.read(renderer.picture(), *scene.display)});
    } else {
        io::write_picture(output, renderer.read_picture(), {});
    }
}

/// Pictures one by one, `frame_rate` to the second from the scene's moment on. What they share is kept between them.
void write_frames(const FrameRange& range, const std::string& output, scene::Scene& scene, const render::View& view,
                  render::Renderer& renderer, render::Presenter& presenter, gl::ShaderLibrary& shaders) {
    const scene::Timeline timeline = *scene.time;
    const std::vector<std::filesystem::path> names = numbered_names(output, range);
    NothingSeen nothing_seen(shaders);
    for (int frame = range.first; frame <= range.last; ++frame) {
        scene.time.edit([&](scene::Timeline& moved) { moved.now_s = timeline.now_s + frame / timeline.frame_rate; });
        renderer.render(scene, view);
        write(names[std::size_t(frame - range.first)].string(), renderer, presenter, scene);
        nothing_seen.look_at(scene, renderer.picture());
    }
    nothing_seen.say();
}

/// Says which options about light inside matter were given where no light goes inside.
void say_what_plays_no_part(const CLI::App& app, const scene::Scene& scene) {
    const auto meshes = scene::shown_meshes(scene);
    const bool any_translucent = std::any_of(meshes.begin(), meshes.end(), [&](const std::string& name) {
        return std::get<scene::Mesh>(scene.nodes.at(name).content).surface->shading == scene::MeshShading::translucent;
    });
    const bool path_traced = render::is_path_traced(scene);
    if (app.get_option("--samples")->count() > 0 && !path_traced && !any_translucent) {
        log_warning("--samples: plays no part, since nothing is path_traced or translucent in this scene");
    }
    if (app.get_option("--scatterings")->count() > 0 && !path_traced) {
        log_warning("--scatterings: plays no part, since nothing is path_traced in this scene");
    }
}

/// What --across and --down ask for; nothing without them.
std::optional<ContactSheet> contact_sheet(const RenderArguments& arguments) {
    if (arguments.across.empty() && arguments.down.empty()) {
        return std::nullopt;
    }
    if (io::picture_format(arguments.output) != io::PictureFormat::png || !arguments.frames.empty() ||
        !arguments.stats.empty() || !arguments.graph.empty() || arguments.explain) {
        throw InputError(
            "--across, --down: put many pictures into one .png and do nothing else; leave out --frames, --stats, "
            "--graph and --explain");
    }
    ContactSheet sheet{.auto_exposure = arguments.auto_exposure};
    if (!arguments.across.empty()) {
        sheet.across = sheet_settings("--across", arguments.across);
    }
    if (!arguments.down.empty()) {
        sheet.down = sheet_settings("--down", arguments.down);
    }
    return sheet;
}

/// All that the command writes, each judged before anything is computed.
io::OutputGuard guard_outputs(const RenderArguments& arguments, const std::optional<FrameRange>& frames) {
    io::OutputGuard outputs = guard_against(arguments.scene.files, arguments.force);
    const io::FileContent content = io::picture_content(arguments.output);
    if (frames) {
        outputs.add_sequence("-o", numbered_names(arguments.output, *frames), content);
    } else {
        outputs.add("-o", arguments.output, content);
    }
    if (!arguments.stats.empty()) {
        outputs.add("--stats", arguments.stats, io::FileContent::statistics);
    }
    if (!arguments.graph.empty()) {
        outputs.add("--graph", arguments.graph, io::FileContent::graph);
    }
    return outputs;
}

int render(const RenderArguments& arguments, const std::vector<std::string>& command_line, const CLI::App& app) {
    const glm::ivec2 pixels = arguments.scene.pixels();
    const io::PictureFormat format = io::picture_format(arguments.output);
    if (arguments.auto_exposure && format != io::PictureFormat::png) {
        throw InputError(fmt::format("--auto-exposure: {} holds radiance, which no exposure changes; write a .png",
                                     arguments.output));
    }
    const std::optional<FrameRange> frames = frame_range(arguments.frames);
    const std::optional<ContactSheet> sheet = contact_sheet(arguments);
    if (frames && (arguments.output == "-" || io::is_stream(arguments.output) || !arguments.stats.empty() ||
                   !arguments.graph.empty() || arguments.explain || arguments.auto_exposure)) {
        throw InputError(
            "--frames: writes numbered pictures and nothing else; leave out -o -, --stats, --graph, --explain and "
            "--auto-exposure");
    }
    const io::OutputGuard outputs = guard_outputs(arguments, frames);
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    const context::DriverInfo driver = context::driver_info();
    log_detail("{}: {}, {}", context->way(), driver.renderer, driver.version);
    check_room(pixels);

    gl::ShaderLibrary shaders(installed_folder("shaders"));
    if (sheet) {
        const io::Picture8 picture = draw_sheet(*sheet, arguments.scene, shaders);
        outputs.check();
        io::write_png(arguments.output, picture);
        return int(ExitCode::done);
    }
    scene::Scene scene = open_scene(arguments.scene);
    outputs.check();
    say_what_plays_no_part(app, scene);
    render::Renderer renderer(shaders);
    render::Presenter presenter(shaders);
    const render::View view{pixels, 1.0, arguments.paths};
    if (frames) {
        write_frames(*frames, arguments.output, scene, view, renderer, presenter, shaders);
        return int(ExitCode::done);
    }
    const render::RunReport& report = renderer.render(scene, view, arguments.explain);

    if (arguments.auto_exposure) {
        expose(scene, renderer.read_picture());
    }
    write(arguments.output, renderer, presenter, scene);
    NothingSeen nothing_seen(shaders);
    nothing_seen.look_at(scene, renderer.picture());
    nothing_seen.say();
    if (arguments.explain) {
        say("{} through {}: {}\n{}", driver.renderer, context->way(), driver.version, explanation(report));
    }
    if (!arguments.graph.empty()) {
        io::write_file_atomically(arguments.graph, renderer.graph().drawing());
    }
    if (!arguments.stats.empty()) {
        const FrameStatistics statistics = measure_frame(shaders, scene, view, arguments.repeats);
        say("{}", summary(statistics));
        io::write_file_atomically(arguments.stats, io::report_text(to_json(statistics), 2) + "\n");
    }
    return int(ExitCode::done);
}

}  // namespace

Verb declare_render(CLI::App& app, const std::vector<std::string>& command_line) {
    auto arguments = std::make_shared<RenderArguments>();
    arguments->scene.declare(app, true);
    app.add_option("-o,--output", arguments->output,
                   "picture to write: .png, .hdr or .exr; '-' is PNG on standard output")
        ->required();
    app.add_option("--context", arguments->context, "auto, egl or osmesa");
    app.add_option("--frames", arguments->frames,
                   "A:B: pictures A to B, numbered, time.frame_rate to the second from the scene's moment on");
    app.add_option("--across", arguments->across,
                   "'PATH=VALUE ... | PATH=VALUE ...': pictures under these settings, side by side in one .png");
    app.add_option("--down", arguments->down, "the same below one another; with --across all pairs of both");
    app.add_option("--stats", arguments->stats, "JSON file: what each pass did, samples, time beside brute force");
    app.add_option("--repeats", arguments->repeats, "how often --stats draws each frame")->check(CLI::Range(1, 1000));
    app.add_option("--samples", arguments->paths.samples,
                   "path_traced lighting: paths for each pixel; translucent meshes: passes over their maps at most")
        ->check(CLI::Range(1, 1 << 20));
    app.add_option("--scatterings", arguments->paths.scatterings,
                   "path_traced lighting: leave out light that was scattered more often; 1 is single scattering")
        ->check(CLI::Range(0, render::PathGoal::all));
    app.add_option("--graph", arguments->graph, "Graphviz file: the frame graph as a drawing");
    app.add_flag("--auto-exposure", arguments->auto_exposure,
                 "expose a .png so that its brightest hundredth is at 0.9 or above, and say how");
    declare_force(app, arguments->force);
    refuse_empty_words(app, {"--stats", "--graph", "--frames", "--across", "--down"});
    app.add_flag("--explain", arguments->explain, "print what each pass did, for how long, and why");
    return [arguments, command_line, &app] {
        if (arguments->stats.empty()) {
            refuse_if_given(app, {"--repeats"}, "counts the frames that --stats measures; add --stats or leave it out");
        }
        for (std::string* output : {&arguments->stats, &arguments->graph}) {
            *output = *output == "-" ? "/dev/stdout" : *output;
        }
        return render(*arguments, command_line, app);
    };
}

}  // namespace bruma::app
