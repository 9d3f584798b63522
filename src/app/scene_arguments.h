#pragma once
#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/output_guard.h"
#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::app {

/// The arguments that every verb shares which takes a scene: files, what headerless files do not say, settings, view.
struct SceneArguments {
    std::vector<std::string> files;
    std::vector<std::string> settings;
    std::string dims, type, spacing, endian, offset;
    std::string size = "1280x720";
    std::string camera;
    std::string up;
    std::optional<double> time_s;
    bool common_coordinates = false;

    void declare(CLI::App& app, bool with_view);
    /// Throws InputError for words that are no layout.
    scene::VolumeSource hints() const;
    glm::ivec2 pixels() const;
    /// `settings` between those that --common-coordinates and --time stand for. Throws InputError for what is no
    /// moment.
    std::vector<std::string> all_settings() const;
};

/// The flag of every verb that writes files.
void declare_force(CLI::App& app, bool& force);
/// The guard of what a command writes, which reads `files` (builtin:NAME among them): see output_guard.h.
io::OutputGuard guard_against(const std::vector<std::string>& files, bool force);
/// An empty word, as of a shell's variable that is not set, would pass for an option that was not given: it is refused.
void refuse_empty_words(CLI::App& app, const std::vector<std::string>& options);
/// Refuses options that were given where nothing looks at them: `why` goes on after the option's name, as in
/// "--repeats: counts frames for --stats; ...".
void refuse_if_given(const CLI::App& app, const std::vector<std::string>& options, const std::string& why);

/// Opens the files as one scene, with a camera: the scene's own, or one that shows everything.
scene::Scene open_scene(const SceneArguments& arguments, const io::Progress& progress = {});

/// The folders where presets are looked up by name.
std::vector<std::filesystem::path> preset_folders();

/// Puts a camera that shows everything into a scene that has none, or when `view` names one: a side (front, back, left,
/// right, top, bottom), or 'AZIMUTH,ELEVATION[,ZOOM]' in degrees. `up` is an axis of the world: x, -x, y, -y, z or -z.
void place_camera(scene::Scene& scene, double aspect, const std::string& view, const std::string& up);

}  // namespace bruma::app
