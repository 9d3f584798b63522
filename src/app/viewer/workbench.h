#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "app/panels/dialogs.h"
#include "app/panels/panel_context.h"
#include "app/panels/volume/layout_dialog.h"
#include "app/panels/volume/transfer_function_panel.h"
#include "app/program.h"
#include "app/viewer/background_loader.h"
#include "app/viewer/edit_history.h"
#include "app/viewer/scene_view.h"
#include "io/output_guard.h"

namespace bruma::app {

/// The viewer without its window: the scene, what is selected, what is being loaded, and one frame of it all.
class Workbench {
  public:
    /// `wake` makes the window's loop turn, from any thread.
    Workbench(const ViewRequest& request, gl::ShaderLibrary& shaders, std::function<void()> wake);

    /// Submits all panels to ImGui, then brings the picture up to date and draws it. `pixels`: of the framebuffer.
    void frame(glm::ivec2 pixels, double now);
    /// Adds files in the background; asks first where they would replace something.
    void open(std::vector<std::string> files, const scene::VolumeSource& hints);
    /// Takes what the background has finished; returns whether there was anything.
    bool take_loaded();
    bool is_loading() const { return loader_.busy(); }

    /// When the next frame is due although nothing happens: a picture to be refined, a notice to be taken away.
    std::optional<double> next_frame_at() const;
    /// The person wants to leave: asks first what becomes of edits that are in no file.
    void ask_to_close();
    bool wants_to_close() const { return wants_to_close_; }
    /// Of the window: the file that saving writes, with a star when the scene is not as it holds it.
    std::string title() const;
    void write_refined_picture(const std::string& path);
    void set_shader_fault(const std::string& fault) { shader_fault_ = fault; }

    /// What the banner or the dialog in front says; empty when neither is there.
    std::string shown_fault() const;

    /// The lines over the lower edge of the picture.
    const std::string& shown_status() const { return shown_status_; }

    const scene::Scene& scene() const { return scene_; }
    SceneView& view() { return view_; }
    const WidgetPlaces& places() const { return places_; }
    glm::ivec2 area() const { return area_; }
    int frames() const { return frames_; }

  private:
    void show_panels();
    /// Moves the scene's time on while it is played.
    void play(double elapsed_s);
    void show_over_picture();
    void show_status();
    void show_nothing_seen(const std::string& why) const;
    std::string words_under_cursor() const;
    void expose();
    void move_camera();
    void obey_keys();
    void obey(const PanelRequests& requests);
    void set_camera(const scene::Camera& camera) { scene_.camera->set(camera); }
    /// By the viewer, not by a hand.
    void place(const scene::Camera& camera);
    double aspect() const { return area_.y > 0 ? double(area_.x) / area_.y : 1.6; }
    bool in_dialog() const { return dialogs_.any() || layout_dialog_.is_open(); }
    void fit();
    void start_loading(std::vector<std::string> files, const scene::VolumeSource& hints);
    void merge(BackgroundLoader::Result result);
    void take_scene(BackgroundLoader::Result result);
    void add_nodes(BackgroundLoader::Result result);
    void select_new(const std::string& newest);
    void place_first_camera(bool made_by_code);
    void show_all_unless_moved();
    void ask_for_layout();
    bool has_unsaved_edits() const { return document_stamp(scene_) != home_->kept; }
    /// Calls `then`, but asks first what becomes of edits that are in no file; `sentence` says what would end them.
    void settle_edits(const std::string& title, const std::string& sentence, const std::function<void()>& then);
    /// Saves to the scene's file, or asks for one, and calls `then` when that was done.
    void save_scene(bool ask, const std::function<void()>& then = {});
    void write_scene(const std::string& path);
    /// Calls `write`, but asks first where a file stands at `path` that is not `own`; refuses what the scene was read
    /// from. Faults become a dialog of the title `fault_title`.
    void write_after_question(const std::string& path, const std::string& own, io::FileContent content,
                              const std::string& fault_title, const std::function<void()>& write);
    void take_screenshot();
    void obey_about_transfer_functions(const PanelRequests& requests);
    /// Calls `act`; a fault becomes a dialog.
    void attempt(const std::string& title, const std::function<void()>& act);
    void notice(const std::string& words);

    ViewRequest request_;
    gl::ShaderLibrary& shaders_;
    std::function<void()> wake_;
    scene::Scene scene_;
    SharedHome home_ = std::make_shared<SceneHome>();
    SceneStamp stamp_at_loading_;  ///< of the scene when the file being read was asked for
    std::string selected_;
    SceneView view_;
    BackgroundLoader loader_;
    EditHistory history_;
    Dialogs dialogs_;
    LayoutDialog layout_dialog_;
    std::deque<BackgroundLoader::UnknownLayout> unknown_;  ///< to be asked about
    WidgetPlaces places_;
    ViewerFacts facts_;
    TransferFunctionPanel transfer_function_panel_;
    glm::ivec2 area_{0};
    double now_ = 0.0;
    bool playing_ = false;
    std::string shader_fault_, notice_, shown_status_;
    double notice_until_ = 0.0;
    int frames_ = 0;
    bool panels_shown_ = true, help_shown_ = false, orbiting_ = false, panning_ = false;
    bool starting_ = true;  ///< until something was opened
    bool wants_to_close_ = false;
};

}  // namespace bruma::app
