#include "app/scene_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/installation.h"
#include "base/nearest_name.h"
#include "io/input_file.h"
#include "io/open.h"
#include "io/volume/grid_source.h"

namespace bruma::app {
namespace {

/// Numbers between separators; empty if any part is no number.
template <class Number>
std::vector<Number> numbers(const std::string& text, char separator) {
    std::vector<Number> result;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(separator, at), text.size());
        Number value{};
        const auto [stop, error] = std::from_chars(text.data() + at, text.data() + end, value);
        if (error != std::errc() || stop != text.data() + end) {
            return {};
        }
        result.push_back(value);
        at = end + 1;
    }
    return result;
}

template <class Enum>
Enum word_value(const std::string& option, const std::string& word) {
    std::vector<std::string> words;
    for (const std::string_view known : scene::enum_words<Enum>()) {
        if (same_word(word, known)) {
            return Enum(words.size());
        }
        words.emplace_back(known);
    }
    throw InputError(option + " " + word + ": unknown" + suggestion(word, words));
}

/// Whether options about headerless volumes have nothing to say to a file.
bool describes_itself(const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return io::is_builtin(file) || ending == ".json" || ending == ".obj" || ending == ".off";
}

glm::dvec3 axis_vector(const std::string& word) {
    static const std::array<std::string, 6> words{"x", "-x", "y", "-y", "z", "-z"};
    for (int n = 0; n < 6; ++n) {
        if (word == words[std::size_t(n)]) {
            glm::dvec3 axis(0.0);
            axis[n / 2] = n % 2 == 0 ? 1.0 : -1.0;
            return axis;
        }
    }
    throw InputError("--up " + word + ": unknown; known are x, -x, y, -y, z, -z");
}

/// Azimuth, elevation (degrees) and zoom of a named or numbered view.
std::array<double, 3> view_angles(const std::string& view) {
    struct Named {
        const char* name;
        double azimuth, elevation;
    };
    static constexpr std::array<Named, 6> views{{{"front", 0.0, 0.0},
                                                 {"back", 180.0, 0.0},
                                                 {"left", -90.0, 0.0},
                                                 {"right", 90.0, 0.0},
                                                 {"top", 0.0, 90.0},
                                                 {"bottom", 0.0, -90.0}}};
    std::vector<std::string> known;
    for (const Named& named : views) {
        if (view == named.name) {
            return {named.azimuth, named.elevation, 1.0};
        }
        known.emplace_back(named.name);
    }
    const std::vector<double> parts = numbers<double>(view, ',');
    if (parts.size() == 2 || parts.size() == 3) {
        const double zoom = parts.size() == 3 ? parts[2] : 1.0;
        if (std::isfinite(parts[0]) && std::abs(parts[1]) <= 90.0 && zoom >= 1e-3 && zoom <= 1e3) {
            return {parts[0], parts[1], zoom};
        }
    }
    throw InputError(fmt::format("--camera {}: neither a side nor AZIMUTH,ELEVATION[,ZOOM] with elevation in -90..90{}",
                                 view, suggestion(view, known)));
}

/// How much nearer a camera that was fitted to a sphere may come until the corners of the scene's box touch the frame,
/// with a twentieth left around.
double room_around(const scene::Scene& scene, const scene::Camera& camera, double aspect) {
    const scene::Bounds bounds = scene::world_bounds(scene);
    const scene::CameraFrame frame = scene::camera_frame(camera);
    const double slope = std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    double distance = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p =
            glm::dvec3(corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                       corner & 4 ? bounds.high.z : bounds.low.z) -
            camera.target_world;
        const double across =
            std::max(std::abs(glm::dot(p, frame.right_world)) / aspect, std::abs(glm::dot(p, frame.up_world)));
        distance = std::max(distance, glm::dot(p, frame.back_world) + across / slope);
    }
    return glm::length(camera.eye_world - camera.target_world) / std::max(1e-300, 1.05 * distance);
}

}  // namespace

void declare_force(CLI::App& app, bool& force) {
    app.add_flag("--force", force, "replace files of another kind; the files that are read never are");
}

io::OutputGuard guard_against(const std::vector<std::string>& files, bool force) {
    for (const std::string& file : files) {
        if (!io::is_builtin(file)) {
            io::announce_input(file);
        }
    }
    // Shaders are read by a layer that knows nothing of outputs.
    constexpr int deepest = 2;  // of folders with shaders; any folder may be named
    std::error_code error;
    std::filesystem::recursive_directory_iterator at(installed_folder("shaders"), error);
    for (; !error && at != std::filesystem::recursive_directory_iterator(); at.increment(error)) {
        io::announce_input(at->path());
        if (at.depth() >= deepest) {
            at.disable_recursion_pending();
        }
    }
    return io::OutputGuard(force);
}

void refuse_if_given(const CLI::App& app, const std::vector<std::string>& options, const std::string& why) {
    for (const std::string& name : options) {
        if (const CLI::Option* option = app.get_option_no_throw(name); option != nullptr && option->count() > 0) {
            throw InputError(fmt::format("{}: {}", name, why));
        }
    }
}

void refuse_empty_words(CLI::App& app, const std::vector<std::string>& options) {
    for (const std::string& name : options) {
        app.get_option(name)->check([](const std::string& word) {
            return word.empty() ? std::string("is empty; give it a value or leave it out") : std::string();
        });
    }
}

void SceneArguments::declare(CLI::App& app, bool with_view) {
    app.add_option(
        "files", files,
        "a .json scene, volumes (.raw, .mhd, .nrrd), meshes (.obj, .off), builtin:NAME; several are added to one "
        "scene");
    app.add_option("--set", settings, "PATH=VALUE: any parameter of the scene, e.g. volume.lighting=gradient");
    app.add_flag("--common-coordinates", common_coordinates,
                 "leave files where their own coordinates say, so that a scan and its segmentation lie on one another");
    app.add_option("--dims", dims,
                   "samples of a headerless volume, as 256x256x128; of several files, for those that do not say it");
    app.add_option("--type", type, "type of its samples: uint8, int8, uint16, int16, float32");
    app.add_option("--spacing", spacing, "millimetres between its samples, as 1,1,2");
    app.add_option("--offset", offset, "bytes before its first sample");
    app.add_option("--endian", endian, "byte order: little or big");
    std::vector<std::string> words{"--dims", "--type", "--spacing", "--offset", "--endian"};
    if (with_view) {
        words.insert(words.end(), {"--camera", "--up"});
        app.add_option("--size", size, "pixels of the picture, as 1280x720");
        app.add_option("--camera", camera,
                       "front, back, left, right, top, bottom, or AZIMUTH,ELEVATION[,ZOOM] in degrees");
        app.add_option("--time", time_s, "seconds: the moment that is shown");
        app.add_option("--up", up, "axis that is up in the picture: x, -x, y, -y, z, -z");
    }
    refuse_empty_words(app, words);
}

scene::VolumeSource SceneArguments::hints() const {
    const std::array<std::pair<const char*, const std::string&>, 5> given{
        {{"--dims", dims}, {"--type", type}, {"--spacing", spacing}, {"--offset", offset}, {"--endian", endian}}};
    for (const auto& [name, word] : given) {
        if (!word.empty() && !files.empty() && std::all_of(files.begin(), files.end(), describes_itself)) {
            throw InputError(fmt::format("{} {}: tells the layout of a headerless volume, but {}; leave it out", name,
                                         word, files.size() == 1 ? files[0] + " is none" : "none of the files is one"));
        }
    }
    scene::VolumeSource hints;
    if (!dims.empty()) {
        const std::vector<long long> parts = numbers<long long>(dims, 'x');
        if (parts.size() != 3) {
            throw InputError(fmt::format("--dims {}: not three whole numbers; write them as 256x256x128", dims));
        }
        for (const long long part : parts) {
            if (part < 1 || part > (1LL << 30)) {
                throw InputError(
                    fmt::format("--dims {}: {} is no number of samples; each must be 1 to {}", dims, part, 1LL << 30));
            }
        }
        hints.size = glm::ivec3(parts[0], parts[1], parts[2]);
    }
    if (!type.empty()) {
        hints.type = word_value<scene::VoxelType>("--type", type);
    }
    if (!endian.empty()) {
        hints.endian = word_value<scene::Endian>("--endian", endian);
    }
    if (!spacing.empty()) {
        const std::vector<double> parts = numbers<double>(spacing, ',');
        if (parts.size() != 3 || !(parts[0] > 0.0) || !(parts[1] > 0.0) || !(parts[2] > 0.0) ||
            !std::isfinite(parts[0] + parts[1] + parts[2])) {
            throw InputError(
                fmt::format("--spacing {}: not three positive lengths; write millimetres as 1,1,2", spacing));
        }
        hints.spacing = 1e-3 * glm::dvec3(parts[0], parts[1], parts[2]);
    }
    if (!offset.empty()) {
        const std::vector<std::int64_t> parts = numbers<std::int64_t>(offset, ',');
        if (parts.size() != 1 || parts[0] < 0) {
            throw InputError(
                fmt::format("--offset {}: no number of bytes before the first sample; give 0 or more", offset));
        }
        hints.offset = parts[0];
    }
    return hints;
}

std::vector<std::string> SceneArguments::all_settings() const {
    std::vector<std::string> all = settings;
    if (common_coordinates) {
        all.insert(all.begin(), "placement.common_coordinates=true");
    }
    if (time_s) {
        const scene::Timeline timeline;
        scene::visit_fields(timeline, [&](const scene::Field& field, const auto&) {
            if (field.name == "now" && !(*time_s >= field.min && *time_s <= field.max)) {
                throw InputError(fmt::format("--time {}: no moment of a scene; give {:g} to {:g} seconds", *time_s,
                                             field.min, field.max));
            }
        });
        all.push_back(fmt::format("time.now={}", *time_s));
    }
    return all;
}

glm::ivec2 SceneArguments::pixels() const {
    const std::vector<long long> parts = numbers<long long>(size, 'x');
    if (parts.size() != 2 || parts[0] < 1 || parts[1] < 1) {
        throw InputError(fmt::format("--size {}: not two numbers of pixels above 0; write them as 1280x720", size));
    }
    constexpr long long most = 16384;
    if (parts[0] > most || parts[1] > most) {
        throw InputError(
            fmt::format("--size {}: a picture has at most {} pixels along an edge; choose a smaller one", size, most));
    }
    return {int(parts[0]), int(parts[1])};
}

std::vector<std::filesystem::path> preset_folders() {
    return {installed_folder("assets") / "presets"};
}

void place_camera(scene::Scene& scene, double aspect, const std::string& view, const std::string& up) {
    if (scene.camera && view.empty() && up.empty()) {
        return;
    }
    const glm::dvec3 up_world = axis_vector(up.empty() ? "y" : up);
    // An orthonormal frame around 'up' in which azimuth 0 looks from the front (+z when y is up).
    glm::dvec3 front = std::abs(up_world.z) > 0.5 ? glm::dvec3(0.0, -up_world.z, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right = glm::cross(up_world, front);
    const std::array<double, 3> angles = view.empty() ? std::array{29.0, 19.0, 1.0} : view_angles(view);
    const double azimuth = glm::radians(angles[0]);
    const double elevation = glm::radians(angles[1]);
    const glm::dvec3 back =
        std::cos(elevation) * (std::sin(azimuth) * right + std::cos(azimuth) * front) + std::sin(elevation) * up_world;
    scene::Camera camera = scene::fit_camera(scene::world_bounds(scene), aspect, back, up_world);
    if (std::abs(angles[1]) == 90.0) {
        camera.up_world = angles[1] > 0.0 ? -front : front;
    }
    // The eye comes nearer; an orthographic view would shrink its height alike.
    const double zoom = angles[2] * room_around(scene, camera, aspect);
    camera.eye_world = camera.target_world + (camera.eye_world - camera.target_world) / zoom;
    camera.view_height /= zoom;
    scene.camera = camera;
}

scene::Scene open_scene(const SceneArguments& arguments, const io::Progress& progress) {
    if (arguments.files.empty()) {
        throw InputError("no file to show; name a .json scene, a .raw volume or builtin:demo");
    }
    // Settings of the camera wait until there is one.
    std::vector<std::string> scene_settings, camera_settings;
    for (const std::string& setting : arguments.all_settings()) {
        (setting.starts_with("camera") ? camera_settings : scene_settings).push_back(setting);
    }
    const auto presets = preset_folders();
    scene::Scene scene = io::open_files(arguments.files, arguments.hints(), scene_settings, progress, presets);
    const glm::ivec2 pixels = arguments.pixels();
    place_camera(scene, double(pixels.x) / pixels.y, arguments.camera, arguments.up);
    if (!camera_settings.empty()) {
        scene = io::with_settings(scene, camera_settings, progress, presets);
    }
    scene::check(scene);
    return scene;
}

}  // namespace bruma::app
