#include "app/scene_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "base/installation.h"
#include "base/nearest_name.h"
#include "io/open.h"

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

void SceneArguments::declare(CLI::App& app, bool with_view) {
    app.add_option("files", files,
                   "a .json scene, .raw volumes, .obj and .off meshes, builtin:NAME; several are added to one scene");
    app.add_option("--set", settings, "PATH=VALUE: any parameter of the scene, e.g. volume.lighting=gradient");
    app.add_flag("--common-coordinates", common_coordinates,
                 "leave files where their own coordinates say, so that a scan and its segmentation lie on one another");
    app.add_option("--dims", dims, "samples of a headerless volume, as 256x256x128");
    app.add_option("--type", type, "type of its samples: uint8, int8, uint16, int16, float32");
    app.add_option("--spacing", spacing, "millimetres between its samples, as 1,1,2");
    app.add_option("--offset", offset, "bytes before its first sample");
    app.add_option("--endian", endian, "byte order: little or big");
    if (with_view) {
        app.add_option("--size", size, "pixels of the picture, as 1280x720");
        app.add_option("--camera", camera,
                       "front, back, left, right, top, bottom, or AZIMUTH,ELEVATION[,ZOOM] in degrees");
        app.add_option("--time", time_s, "seconds: the moment that is shown");
        app.add_option("--up", up, "axis that is up in the picture: x, -x, y, -y, z, -z");
    }
}

std::vector<std::string> SceneArguments::all_settings() const {
    std::vector<std::string> all = settings;
    if (common_coordinates) {
        all.insert(all.begin(), "placement.common_coordinates=true");
    }
    return all;
}

scene::VolumeSource SceneArguments::hints() const {
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
    if (offset != -1) {
        if (offset < 0) {
            throw InputError(fmt::format("--offset {}: a file has no bytes before its first; give 0 or more", offset));
        }
        hints.offset = offset;
    }
    return hints;
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
    if (arguments.time_s) {
        if (!std::isfinite(*arguments.time_s)) {
            throw InputError(fmt::format("--time {}: no moment; give seconds", *arguments.time_s));
        }
        scene.time.edit([&](scene::Timeline& timeline) { timeline.now_s = *arguments.time_s; });
    }
    scene::check(scene);
    return scene;
}

}  // namespace bruma::app
