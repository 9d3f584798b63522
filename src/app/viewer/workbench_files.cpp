#include <fmt/core.h>

#include <algorithm>
#include <filesystem>

#include "app/exposure.h"
#include "app/scene_arguments.h"
#include "app/viewer/orbit.h"
#include "app/viewer/typed_path.h"
#include "app/viewer/workbench.h"
#include "base/log.h"
#include "io/open.h"

// Files in and out, and what panels and keys ask for.
namespace bruma::app {
namespace {

std::string names_of(const std::vector<std::string>& files) {
    const std::string first = std::filesystem::path(files.front()).filename().string();
    return files.size() == 1 ? first : fmt::format("{} and {} more", first, files.size() - 1);
}

}  // namespace

void Workbench::open(std::vector<std::string> files, const scene::VolumeSource& hints) {
    if (files.empty()) {
        return;
    }
    if (loader_.busy()) {
        dialogs_.tell("One at a time", "Another file is still being read; wait for it, or cancel it first.");
        return;
    }
    const bool replaces = std::any_of(files.begin(), files.end(), is_whole_scene);
    if (replaces && has_unsaved_edits()) {
        settle_edits("Open another scene",
                     fmt::format("{} is a whole scene and takes the place of the present one", names_of(files)),
                     [this, files, hints] { start_loading(files, hints); });
    } else if (replaces && !scene_.nodes.empty()) {
        dialogs_.confirm("Open another scene",
                         fmt::format("{} is a whole scene and takes the place of the present one.", names_of(files)),
                         "Open it", [this, files, hints] { start_loading(files, hints); });
    } else {
        start_loading(std::move(files), hints);
    }
}

void Workbench::start_loading(std::vector<std::string> files, const scene::VolumeSource& hints) {
    if (loader_.busy()) {
        dialogs_.tell("One at a time", "Another file is still being read; wait for it, or cancel it first.");
        return;
    }
    const std::string title = "Reading " + names_of(files);
    stamp_at_loading_ = document_stamp(scene_);
    loader_.start(title, add_files_job(scene_, std::move(files), hints, request_.settings), wake_);
}

bool Workbench::take_loaded() {
    std::optional<BackgroundLoader::Result> result = loader_.take();
    if (!result) {
        return false;
    }
    if (result->cancelled) {
        notice("Reading was cancelled; the scene is as it was.");
    } else if (!result->fault.empty()) {
        log_error("{}", result->fault);
        dialogs_.tell("This could not be opened", result->fault);
    } else {
        unknown_.insert(unknown_.end(), result->unknown.begin(), result->unknown.end());
        merge(std::move(*result));
    }
    return true;
}

void Workbench::merge(BackgroundLoader::Result result) {
    if (!result.scene || (result.added_nodes.empty() && !result.replaces)) {
        return;
    }
    if (result.replaces && has_unsaved_edits() && document_stamp(scene_) != stamp_at_loading_) {
        settle_edits("Edits while a scene was read", "The scene that was read takes the place of the present one",
                     [this, result] {
                         stamp_at_loading_ = document_stamp(scene_);
                         merge(result);
                     });
        return;
    }
    attempt("The settings do not fit", [&] {
        const bool is_empty = scene_.nodes.empty() && document_stamp(scene_) == stamp_at_loading_;
        if (result.replaces || is_empty) {
            take_scene(std::move(result));
        } else {
            add_nodes(std::move(result));
        }
    });
}

void Workbench::take_scene(BackgroundLoader::Result result) {
    const bool was_unsaved = has_unsaved_edits();
    const bool had_camera = scene_.camera.has_value();
    scene::Scene loaded = std::move(*result.scene);
    if (!request_.settings.empty()) {
        loaded = io::with_settings(loaded, std::exchange(request_.settings, {}), {}, preset_folders());
    }
    scene_ = std::move(loaded);
    if (result.replaces) {
        home_ = std::make_shared<SceneHome>();
        home_->path = result.scene_file;
    }
    // What the program was started with is no edit, and neither is a look at files that no scene's file stands for.
    const bool is_as_kept =
        starting_ || (result.replaces ? result.added_nodes.empty() : home_->path.empty() && !was_unsaved);
    home_->kept = is_as_kept ? document_stamp(scene_) : SceneStamp();
    selected_.clear();
    select_new(scene_.nodes.empty() ? "" : scene_.nodes.begin()->first);
    if (result.replaces || !had_camera) {
        place_first_camera(result.replaces && result.scene_file.empty());
    } else {
        show_all_unless_moved();
    }
    if (std::exchange(starting_, false)) {
        history_.restart(scene_, home_);
    }
}

void Workbench::place_first_camera(bool made_by_code) {
    constexpr double usual_aspect = 16.0 / 9.0;
    if (made_by_code && scene_.camera && aspect() < usual_aspect) {
        // Scenes made by code are framed for a wide picture; what stands at its sides is not cut off.
        set_camera(zoomed(**scene_.camera, usual_aspect / aspect()));
    }
    home_->has_own_camera = scene_.camera || !request_.camera.empty();
    place_camera(scene_, aspect(), std::exchange(request_.camera, ""), std::exchange(request_.up, ""));
    home_->first_camera = home_->placed_camera = **scene_.camera;
}

void Workbench::add_nodes(BackgroundLoader::Result result) {
    // What a person changed while the file was read stays as they left it.
    const bool stays_kept = home_->path.empty() && !has_unsaved_edits();
    std::string newest;
    for (const std::string& name : result.added_nodes) {
        newest = name;
        for (int n = 2; scene_.nodes.contains(newest); ++n) {
            newest = fmt::format("{}_{}", name, n);
        }
        scene_.nodes.emplace(newest, result.scene->nodes.at(name));
    }
    if (scene_.lights.empty()) {
        for (const std::string& name : result.added_lights) {
            scene_.lights.emplace(name, result.scene->lights.at(name));
        }
    }
    if (stays_kept) {
        home_->kept = document_stamp(scene_);
    }
    select_new(newest);
    if (scene_.camera) {
        show_all_unless_moved();
    }
}

void Workbench::select_new(const std::string& newest) {
    for (const auto& [name, node] : scene_.nodes) {
        const bool is_volume = std::holds_alternative<scene::Volume>(node.content);
        selected_ = newest == name || (selected_.empty() && is_volume) ? name : selected_;
    }
}

void Workbench::obey(const PanelRequests& requests) {
    if (requests.open_file) {
        dialogs_.ask_path("Open",
                          "A .json scene, a .raw volume, or builtin:NAME. Files can also be dropped on the window.", "",
                          [this](const std::string& path) { open({typed_path(path)}, {}); });
    }
    if (requests.save_scene || requests.save_scene_as) {
        save_scene(requests.save_scene_as);
    }
    if (requests.screenshot) {
        take_screenshot();
    }
    if (requests.fit) {
        fit();
    }
    if (requests.expose) {
        expose();
    }
    if (requests.undo) {
        history_.undo(scene_, home_);
    }
    if (requests.redo) {
        history_.redo(scene_, home_);
    }
    if (requests.count_samples && scene_.camera) {
        attempt("Samples could not be counted", [&] { facts_.samples = view_.count_samples(scene_); });
    }
    help_shown_ ^= requests.help;
    obey_about_transfer_functions(requests);
}

void Workbench::ask_for_layout() {
    if (dialogs_.any()) {
        return;
    }
    if (!layout_dialog_.is_open() && !unknown_.empty() && !loader_.busy()) {
        layout_dialog_.open(unknown_.front().file, unknown_.front().proposals);
        unknown_.pop_front();
    }
    const LayoutDialog::Answer answer = layout_dialog_.show(places_);
    if (answer == LayoutDialog::Answer::load && !loader_.busy()) {
        start_loading({layout_dialog_.file()}, layout_dialog_.chosen());
    }
    if (answer != LayoutDialog::Answer::none) {
        layout_dialog_.close();
    }
}

}  // namespace bruma::app
