#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <filesystem>

#include "app/exposure.h"
#include "app/scene_arguments.h"
#include "app/viewer/orbit.h"
#include "app/viewer/workbench.h"
#include "base/log.h"
#include "io/open.h"
#include "io/picture_file.h"
#include "io/scene_file.h"

// Files in and out, and what panels and keys ask for.
namespace bruma::app {
namespace {

std::string names_of(const std::vector<std::string>& files) {
    const std::string first = std::filesystem::path(files.front()).filename().string();
    return files.size() == 1 ? first : fmt::format("{} and {} more", first, files.size() - 1);
}

/// A name that no file has yet, from the time of day.
std::string picture_path() {
    const std::string stem = fmt::format("bruma-{:%Y%m%d-%H%M%S}", fmt::localtime(std::time(nullptr)));
    std::string path = stem + ".png";
    for (int n = 2; std::filesystem::exists(path); ++n) {
        path = fmt::format("{}-{}.png", stem, n);
    }
    return path;
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
    if (!replaces || scene_.nodes.empty()) {
        start_loading(std::move(files), hints);
        return;
    }
    dialogs_.confirm("Open another scene",
                     fmt::format("{} is a whole scene and takes the place of the present one.", names_of(files)),
                     "Open it", [this, files, hints] { start_loading(files, hints); });
}

void Workbench::start_loading(std::vector<std::string> files, const scene::VolumeSource& hints) {
    const std::string title = "Reading " + names_of(files);
    // Saving goes to the file that the scene came from, once it has come.
    const auto whole = std::find_if(files.begin(), files.end(), is_whole_scene);
    path_being_read_ = whole == files.end() || whole->starts_with("builtin:") ? "" : *whole;
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
    if (!result.scene || (result.scene->nodes.empty() && !result.replaces)) {
        return;
    }
    const bool was_empty = scene_.nodes.empty();
    scene::Scene loaded = std::move(*result.scene);
    attempt("The settings do not fit", [&] {
        std::string newest;
        if (result.replaces || was_empty) {
            if (was_empty && !request_.settings.empty()) {
                loaded = io::with_settings(loaded, std::exchange(request_.settings, {}), {}, preset_folders());
            }
            scene_ = std::move(loaded);
            scene_path_ = path_being_read_;
            selected_.clear();
            newest = scene_.nodes.empty() ? "" : scene_.nodes.begin()->first;
        } else {
            // What a person changed while the file was read stays as they left it.
            for (auto& [name, node] : loaded.nodes) {
                if (scene_.nodes.emplace(name, node).second) {
                    newest = name;
                }
            }
            for (auto& [name, light] : loaded.lights) {
                if (scene_.lights.empty()) {
                    scene_.lights.emplace(name, light);
                }
            }
        }
        for (const auto& [name, node] : scene_.nodes) {
            const bool is_volume = std::holds_alternative<scene::Volume>(node.content);
            selected_ = newest == name || (selected_.empty() && is_volume) ? name : selected_;
        }
        const double aspect = area_.y > 0 ? double(area_.x) / area_.y : 1.6;
        constexpr double usual_aspect = 16.0 / 9.0;
        if (result.replaces && scene_.camera && path_being_read_.empty() && aspect < usual_aspect) {
            // Scenes made by code are framed for a wide picture; what stands at its sides is not cut off.
            set_camera(zoomed(**scene_.camera, usual_aspect / aspect));
        }
        place_camera(scene_, aspect, std::exchange(request_.camera, ""), std::exchange(request_.up, ""));
        first_camera_ = **scene_.camera;
    });
}

void Workbench::obey(const PanelRequests& requests) {
    if (requests.open_file) {
        dialogs_.ask_path("Open",
                          "A .json scene, a .raw volume, or builtin:NAME. Files can also be dropped on the window.", "",
                          [this](const std::string& path) { open({path}, {}); });
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
        history_.undo(scene_);
    }
    if (requests.redo) {
        history_.redo(scene_);
    }
    if (requests.count_samples && scene_.camera) {
        attempt("Samples could not be counted", [&] { facts_.samples = view_.count_samples(scene_); });
    }
    help_shown_ ^= requests.help;
    obey_about_transfer_functions(requests);
}

void Workbench::obey_about_transfer_functions(const PanelRequests& requests) {
    const auto edited = [this]() -> scene::Volume* {
        const std::string name = edited_volume(scene_, selected_);
        return name.empty() ? nullptr : &std::get<scene::Volume>(scene_.nodes.at(name).content);
    };
    const auto load = [this, edited](const std::string& path) {
        attempt("The transfer function was not loaded", [&] {
            if (scene::Volume* volume = edited()) {
                volume->transfer_function.set(io::load_transfer_function(path));
            }
        });
    };
    if (!requests.transfer_function_file.empty()) {
        load(requests.transfer_function_file);
    }
    if (requests.load_transfer_function) {
        dialogs_.ask_path("Load a transfer function", "Path of a transfer function's .json file.", "", load);
    }
    if (requests.save_transfer_function) {
        dialogs_.ask_path("Save the transfer function", "Path of the .json file; an existing one is replaced.",
                          "transfer-function.json", [this, edited](const std::string& path) {
                              attempt("The transfer function was not saved", [&] {
                                  if (const scene::Volume* volume = edited()) {
                                      io::save_transfer_function(*volume->transfer_function, path);
                                      notice("Saved " + std::filesystem::absolute(path).string());
                                  }
                              });
                          });
    }
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

void Workbench::save_scene(bool ask) {
    const auto write = [this](const std::string& path) {
        attempt("The scene was not saved", [&] {
            io::save_scene_file(scene_, path);
            scene_path_ = path;
            notice("Saved " + std::filesystem::absolute(path).string());
        });
    };
    if (!ask && !scene_path_.empty()) {
        write(scene_path_);
        return;
    }
    dialogs_.ask_path("Save the scene", "Path of the .json file; an existing one is replaced.",
                      scene_path_.empty() ? "scene.json" : scene_path_, write);
}

void Workbench::write_refined_picture(const std::string& path) {
    io::write_png(path, view_.refined_picture(scene_, area_));
}

void Workbench::expose() {
    if (const std::optional<SuitableExposure> suitable = suitable_exposure(view_.linear_picture(), scene_)) {
        scene_.display.edit([&](scene::Display& display) { display.exposure_ev = suitable->ev; });
        notice(suitable->limited ? fmt::format("Exposure {:+.2f} EV: {}.", suitable->ev, limit_words(*suitable))
                                 : fmt::format("Exposure {:+.2f} EV", suitable->ev));
    } else {
        notice("The picture is black: no exposure suits it.");
    }
}

void Workbench::take_screenshot() {
    if (!scene_.camera) {
        return;
    }
    attempt("The picture was not written", [&] {
        const std::string path = picture_path();
        write_refined_picture(path);
        notice("Wrote " + std::filesystem::absolute(path).string());
    });
}

}  // namespace bruma::app
