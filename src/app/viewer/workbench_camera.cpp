#include <GL/glew.h>
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <cmath>

#include "app/scene_arguments.h"
#include "app/viewer/orbit.h"
#include "app/viewer/workbench.h"

// What hands do to the camera, over the picture.
namespace bruma::app {
namespace {

constexpr double radians_per_height = 3.6;  ///< orbit: a drag over the height of the picture
constexpr double zoom_per_notch = 0.87;

}  // namespace

void Workbench::fit() {
    if (!scene_.camera) {
        return;
    }
    const scene::Camera old = **scene_.camera;
    scene::Camera camera =
        scene::fit_camera(scene::world_bounds(scene_), aspect(), scene::camera_frame(old).back_world, old.up_world);
    camera.projection = old.projection;
    place(camera);
}

void Workbench::place(const scene::Camera& camera) {
    set_camera(camera);
    home_->placed_camera = camera;
}

void Workbench::show_all_unless_moved() {
    const bool moved = home_->placed_camera != **scene_.camera;
    if (!home_->has_own_camera) {
        // The first camera was fitted to what was there; it is fitted again, for the key that goes back to it.
        scene::Scene all = scene_;
        all.camera.reset();
        place_camera(all, aspect(), "", "");
        home_->first_camera = **all.camera;
    }
    if (shows(**scene_.camera, scene::world_bounds(scene_), aspect())) {
        return;
    }
    if (moved) {
        notice("Not all of it is in view; F shows everything.");
    } else if (home_->has_own_camera) {
        fit();
    } else {
        place(*home_->first_camera);
    }
}

void Workbench::move_camera() {
    const ImGuiIO& io = ImGui::GetIO();
    if (!ImGui::IsMouseDown(0)) {
        orbiting_ = false;
    }
    if (!ImGui::IsMouseDown(2) && !(panning_ && ImGui::IsMouseDown(0) && io.KeyShift)) {
        panning_ = false;
    }
    if (!scene_.camera || in_dialog()) {
        return;
    }
    scene::Camera camera = **scene_.camera;
    const double height = double(area_.y) / io.DisplayFramebufferScale.y;
    const bool over_picture = !io.WantCaptureMouse;
    if (over_picture && ImGui::IsMouseDoubleClicked(0)) {
        fit();
        return;
    }
    if (over_picture && ImGui::IsMouseClicked(0)) {
        (io.KeyShift ? panning_ : orbiting_) = true;
    }
    if (over_picture && ImGui::IsMouseClicked(2)) {
        panning_ = true;
    }
    const glm::dvec2 moved(io.MouseDelta.x, io.MouseDelta.y);
    if (orbiting_ && moved != glm::dvec2(0.0)) {
        const double angle = radians_per_height / std::max(1.0, height);
        camera = orbited(camera, angle * moved.x, angle * moved.y);
    }
    if (panning_ && moved != glm::dvec2(0.0)) {
        camera = panned(camera, moved, height);
    }
    if (over_picture && io.MouseWheel != 0.0F) {
        camera = zoomed(camera, std::pow(zoom_per_notch, double(io.MouseWheel)));
    }
    set_camera(camera);
}

void Workbench::obey_keys() {
    const ImGuiIO& io = ImGui::GetIO();
    if (in_dialog() || io.WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) {
        return;
    }
    const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
    PanelRequests requests;
    if (io.KeyCtrl) {
        requests.open_file = pressed(GLFW_KEY_O);
        requests.save_scene = pressed(GLFW_KEY_S) && !io.KeyShift;
        requests.save_scene_as = pressed(GLFW_KEY_S) && io.KeyShift;
        requests.undo = pressed(GLFW_KEY_Z) && !io.KeyShift;
        requests.redo = pressed(GLFW_KEY_Y) || (pressed(GLFW_KEY_Z) && io.KeyShift);
        obey(requests);
        if (pressed(GLFW_KEY_Q)) {
            ask_to_close();
        }
        return;
    }
    requests.fit = pressed(GLFW_KEY_F);
    requests.expose = pressed(GLFW_KEY_E);
    requests.screenshot = pressed(GLFW_KEY_P);
    requests.help = pressed(GLFW_KEY_H) || (pressed(GLFW_KEY_SLASH) && io.KeyShift);
    panels_shown_ ^= pressed(GLFW_KEY_TAB);
    obey(requests);
    if (!scene_.camera) {
        return;
    }
    if (pressed(GLFW_KEY_O)) {
        set_camera(with_other_projection(**scene_.camera));
    }
    if (pressed(GLFW_KEY_R) && home_->first_camera) {
        place(*home_->first_camera);
    }
    for (int n = 0; n < 6; ++n) {
        if (pressed(GLFW_KEY_1 + n) || pressed(GLFW_KEY_KP_1 + n)) {
            set_camera(seen_from_side(**scene_.camera, Side(n)));
        }
    }
}

}  // namespace bruma::app
