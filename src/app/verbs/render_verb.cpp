#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <memory>
#include <optional>

#include "app/exposure.h"
#include "app/frame_statistics.h"
#include "app/scene_arguments.h"
#include "app/sibling.h"
#include "app/verbs/contact_sheet.h"
#include "app/verbs/verbs.h"
#include "base/error.h"
#include "base/installation.h"
#include "base/log.h"
#include "io/atomic_file.h"
#include "io/picture_file.h"
#include "io/raw_volume.h"
#include "render/presenter.h"

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
    if (needed > io::available_memory()) {
        throw InputError(fmt::format("--size {}x{}: needs {} MiB, but {} MiB are free; choose less", pixels.x, pixels.y,
                                     needed >> 20, io::available_memory() >> 20));
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

/// The name of one picture of many: cloud.png becomes cloud_0007.png.
std::string numbered(const std::string& output, int frame) {
    const std::filesystem::path path(output);
    const std::string name = fmt::format("{}_{:04}{}", path.stem().string(), frame, path.extension().string());
    return (path.parent_path() / name).string();
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
                  render::Renderer& renderer, render::Presenter& presenter) {
    const scene::Timeline timeline = *scene.time;
    for (int frame = range.first; frame <= range.last; ++frame) {
        scene.time.edit([&](scene::Timeline& moved) { moved.now_s = timeline.now_s + frame / timeline.frame_rate; });
        renderer.render(scene, view);
        write(numbered(output, frame), renderer, presenter, scene);
    }
}

/// What --across and --down ask for; nothing without them.
std::optional<ContactSheet> contact_sheet(const RenderArguments& arguments) {
    if (arguments.across.empty() && arguments.down.empty()) {
        return std::nullopt;
    }
    if (io::picture_format(arguments.output) != io::PictureFormat::png || !arguments.frames.empty() ||
        !arguments.stats.empty() || arguments.explain) {
        throw InputError(
            "--across, --down: put many pictures into one .png and do nothing else; leave out --frames, --stats and "
            "--explain");
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

int render(const RenderArguments& arguments, const std::vector<std::string>& command_line) {
    const glm::ivec2 pixels = arguments.scene.pixels();
    const io::PictureFormat format = io::picture_format(arguments.output);
    if (arguments.auto_exposure && format != io::PictureFormat::png) {
        throw InputError(fmt::format("--auto-exposure: {} holds radiance, which no exposure changes; write a .png",
                                     arguments.output));
    }
    const std::optional<FrameRange> frames = frame_range(arguments.frames);
    const std::optional<ContactSheet> sheet = contact_sheet(arguments);
    if (frames &&
        (arguments.output == "-" || !arguments.stats.empty() || arguments.explain || arguments.auto_exposure)) {
        throw InputError(
            "--frames: writes numbered pictures and nothing else; leave out -o -, --stats, --explain and "
            "--auto-exposure");
    }
    for (const std::string& output : {arguments.output, arguments.stats, arguments.graph}) {
        if (!output.empty() && output != "-") {
            io::require_writable(output);
        }
    }
    const auto context = open_context_or_run_sibling(context_kind(arguments.context), command_line);
    const context::DriverInfo driver = context::driver_info();
    log_detail("{}: {}, {}", context->way(), driver.renderer, driver.version);
    check_room(pixels);

    gl::ShaderLibrary shaders(installed_folder("shaders"));
    if (sheet) {
        io::write_png(arguments.output, draw_sheet(*sheet, arguments.scene, shaders));
        return int(ExitCode::done);
    }
    scene::Scene scene = open_scene(arguments.scene);
    render::Renderer renderer(shaders);
    render::Presenter presenter(shaders);
    const render::View view{pixels, 1.0, arguments.paths};
    if (frames) {
        write_frames(*frames, arguments.output, scene, view, renderer, presenter);
        return int(ExitCode::done);
    }
    const render::RunReport& report = renderer.render(scene, view, arguments.explain);

    if (arguments.auto_exposure) {
        expose(scene, renderer.read_picture());
    }
    write(arguments.output, renderer, presenter, scene);
    if (arguments.explain) {
        fmt::print(stderr, "{} through {}: {}\n{}", driver.renderer, context->way(), driver.version,
                   explanation(report));
    }
    if (!arguments.graph.empty()) {
        io::write_file_atomically(arguments.graph, renderer.graph().drawing());
    }
    if (!arguments.stats.empty()) {
        const FrameStatistics statistics = measure_frame(shaders, scene, view, arguments.repeats);
        fmt::print(stderr, "{}", summary(statistics));
        io::write_file_atomically(arguments.stats, to_json(statistics).dump(2) + "\n");
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
    app.add_flag("--explain", arguments->explain, "print what each pass did, for how long, and why");
    return [arguments, command_line] { return render(*arguments, command_line); };
}

}  // namespace bruma::app
