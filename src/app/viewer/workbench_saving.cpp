#include <fmt/chrono.h>
#include <fmt/core.h>

#include <ctime>
#include <filesystem>

#include "app/exposure.h"
#include "app/viewer/typed_path.h"
#include "app/viewer/workbench.h"
#include "base/error.h"
#include "io/picture/picture_file.h"
#include "io/scene/scene_file.h"

// Files out, and what becomes of edits.
namespace bruma::app {
namespace {

std::string absolute(const std::string& path) {
    return std::filesystem::absolute(path).string();
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

std::string Workbench::title() const {
    const std::string star = has_unsaved_edits() ? "*" : "";
    if (home_->path.empty()) {
        return star.empty() ? "Bruma" : "unsaved scene* - Bruma";
    }
    const std::filesystem::path path = absolute(home_->path);
    return fmt::format("{}{} - {} - Bruma", path.filename().string(), star, path.parent_path().string());
}

void Workbench::settle_edits(const std::string& title, const std::string& sentence, const std::function<void()>& then) {
    if (!has_unsaved_edits()) {
        then();
        return;
    }
    if (dialogs_.holds(title)) {
        return;
    }
    const std::string edits =
        home_->path.empty() ? "the scene as it stands is in no file" : "its edits are not in " + home_->path;
    dialogs_.ask_about_edits(
        title, fmt::format("{}, but {}.", sentence, edits), [this, then] { save_scene(false, then); }, then);
}

void Workbench::ask_to_close() {
    settle_edits("Close", "The window closes", [this] { wants_to_close_ = true; });
}

void Workbench::write_scene(const std::string& path) {
    io::save_scene_file(scene_, path);
    home_->path = path;
    home_->kept = document_stamp(scene_);
    history_.was_saved(*home_);
    notice("Saved " + absolute(path));
}

void Workbench::write_after_question(const std::string& path, const std::string& own, io::FileContent content,
                                     const std::string& fault_title, const std::function<void()>& write) {
    attempt(fault_title, [&] {
        const io::OutputVerdict verdict = io::judge_output(path, content);
        if (verdict.standing == io::OutputStanding::input) {
            throw InputError(verdict.sentence + "; choose another name");
        }
        const bool asks = verdict.standing == io::OutputStanding::another_kind ||
                          (verdict.standing == io::OutputStanding::same_kind && !same_file(path, own));
        if (!asks) {
            write();
            return;
        }
        const std::string there = verdict.sentence.empty()
                                      ? fmt::format("{}: holds {} already", path, io::content_words(content))
                                      : verdict.sentence;
        dialogs_.confirm("Replace a file", there + ". Replace it?", "Replace it",
                         [this, fault_title, write] { attempt(fault_title, write); });
    });
}

void Workbench::save_scene(bool ask, const std::function<void()>& then) {
    const auto write = [this, then](const std::string& path) {
        write_after_question(path, home_->path, io::FileContent::scene, "The scene was not saved", [this, path, then] {
            write_scene(path);
            if (then) {
                then();
            }
        });
    };
    if (!ask && !home_->path.empty()) {
        write(home_->path);
        return;
    }
    dialogs_.ask_path("Save the scene", "Path of the .json file.", home_->path.empty() ? "scene.json" : home_->path,
                      [write](const std::string& path) { write(typed_path(path)); });
}

void Workbench::obey_about_transfer_functions(const PanelRequests& requests) {
    const auto edited = [this]() -> scene::Volume* {
        const std::string name = edited_volume(scene_, selected_);
        return name.empty() ? nullptr : &std::get<scene::Volume>(scene_.nodes.at(name).content);
    };
    const auto load = [this, edited](const std::string& typed) {
        const std::string path = typed_path(typed);
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
        dialogs_.ask_path("Save the transfer function", "Path of the .json file.", "transfer-function.json",
                          [this, edited](const std::string& typed) {
                              const std::string path = typed_path(typed);
                              write_after_question(path, "", io::FileContent::transfer_function,
                                                   "The transfer function was not saved", [this, edited, path] {
                                                       if (const scene::Volume* volume = edited()) {
                                                           io::save_transfer_function(*volume->transfer_function, path);
                                                           notice("Saved " + absolute(path));
                                                       }
                                                   });
                          });
    }
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
