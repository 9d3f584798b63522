#pragma once
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "app/panels/dialogs.h"
#include "app/panels/layout_dialog.h"
#include "app/panels/panel_context.h"
#include "app/panels/transfer_function_panel.h"
#include "app/program.h"
#include "app/viewer/background_loader.h"
#include "app/viewer/edit_history.h"
#include "app/viewer/scene_view.h"

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
    bool wants_to_close() const { return wants_to_close_; }
    void write_refined_picture(const std::string& path);
    void set_shader_fault(const std::string& fault) { shader_fault_ = fault; }

    /// What the banner or the dialog in front says; empty when neither is there.
    std::string shown_fault() const;

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
    std::string words_under_cursor() const;
    void expose();
    void move_camera();
    void obey_keys();
    void obey(const PanelRequests& requests);
    void set_camera(const scene::Camera& camera) { scene_.camera->set(camera); }
    bool in_dialog() const { return dialogs_.any() || layout_dialog_.is_open(); }
    void fit();
    void start_loading(std::vector<std::string> files, const scene::VolumeSource& hints);
    void merge(BackgroundLoader::Result result);
    void ask_for_layout();
    void save_scene(bool ask);
    void take_screenshot();
    void obey_about_transfer_functions(const PanelRequests& requests);
    /// Calls `act`; a fault becomes a dialog.
    void attempt(const std::string& title, const std::function<void()>& act);
    void notice(const std::string& words);

    ViewRequest request_;
    gl::ShaderLibrary& shaders_;
    std::function<void()> wake_;
    scene::Scene scene_;
    std::string scene_path_, path_being_read_, selected_;
    std::optional<scene::Camera> first_camera_;
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
    std::string shader_fault_, notice_;
    double notice_until_ = 0.0;
    int frames_ = 0;
    bool panels_shown_ = true, help_shown_ = false, wants_to_close_ = false, orbiting_ = false, panning_ = false;
};

}  // namespace bruma::app
