#include "app/viewer/input.h"

#include <GL/glew.h>
#include <GLFW/glfw3.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <optional>
#include <string>

#include "app/panels/number_boxes.h"

namespace bruma::app {
namespace {

constexpr int settling_frames = 3;

Input& of(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

}  // namespace

void Input::listen(bool hands_off) {
    GLFWwindow* window = window_.handle();
    glfwSetWindowUserPointer(window, this);
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).disturbed(); });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).disturbed(); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int) { of(w).disturbed(); });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) {
        glfwSetWindowShouldClose(w, GLFW_FALSE);  // whoever asks about edits decides
        of(w).close_asked();
    });
    if (hands_off) {
        return;
    }
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).mouse_moved({x, y}); });
    glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
        if (!entered && !of(w).any_button_down()) {
            of(w).mouse_moved(glm::dvec2(-1e9));
        }
    });
    glfwSetMouseButtonCallback(
        window, [](GLFWwindow* w, int button, int action, int) { of(w).mouse_button(button, action != GLFW_RELEASE); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) { of(w).scrolled({x, y}); });
    glfwSetKeyCallback(window,
                       [](GLFWwindow* w, int key, int, int action, int) { of(w).key(key, action != GLFW_RELEASE); });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned codepoint) { of(w).typed(codepoint); });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        of(w).dropped(std::vector<std::string>(paths, paths + count));
    });
}

void Input::mouse_moved(glm::dvec2 position) {
    mouse_ = position;
    disturbed();
}

void Input::mouse_button(int button, bool down) {
    if (button >= 0 && button < int(down_.size())) {
        down_[std::size_t(button)] = down;
        pressed_[std::size_t(button)] |= down;
    }
    disturbed();
}

void Input::scrolled(glm::dvec2 notches) {
    ImGui::GetIO().MouseWheelH += float(notches.x);
    ImGui::GetIO().MouseWheel += float(notches.y);
    disturbed();
}

void Input::key(int key, bool down) {
    const bool unseen = std::find(unseen_keys_.begin(), unseen_keys_.end(), key) != unseen_keys_.end();
    if (down) {
        unseen_keys_.push_back(key);
        set_key(key, true);
    } else if (unseen) {
        released_unseen_.push_back(key);  // let go once a frame has seen it down
    } else {
        set_key(key, false);
    }
    disturbed();
}

void Input::set_key(int key, bool down) {
    ImGuiIO& io = ImGui::GetIO();
    if (key >= 0 && key < int(std::size(io.KeysDown))) {
        io.KeysDown[key] = down;
    }
    io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
    io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
    io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
}

void Input::typed(unsigned codepoint) {
    ImGui::GetIO().AddInputCharacter(codepoint);
    disturbed();
}

void Input::dropped(std::vector<std::string> paths) {
    dropped_.insert(dropped_.end(), paths.begin(), paths.end());
    disturbed();
}

void Input::close_asked() {
    close_asked_ = true;
    disturbed();
}

void Input::disturbed() {
    frames_due_ = settling_frames;
}

void Input::begin_frame(double now) {
    frames_due_ = std::max(0, frames_due_ - 1);
    for (const int key : release_next_) {
        set_key(key, false);
    }
    release_next_ = std::exchange(released_unseen_, {});
    unseen_keys_.clear();
    ImGuiIO& io = ImGui::GetIO();
    glm::ivec2 size{0};
    glfwGetWindowSize(window_.handle(), &size.x, &size.y);
    const glm::ivec2 pixels = window_.pixels();
    io.DisplaySize = {float(size.x), float(size.y)};
    if (size.x > 0 && size.y > 0) {
        io.DisplayFramebufferScale = {float(pixels.x) / float(size.x), float(pixels.y) / float(size.y)};
    }
    io.DeltaTime = float(std::max(1e-4, now - last_frame_));
    last_frame_ = now;
    io.MousePos = mouse_.x < -1e8 ? ImVec2(-FLT_MAX, -FLT_MAX) : ImVec2(float(mouse_.x), float(mouse_.y));
    for (std::size_t n = 0; n < down_.size(); ++n) {
        // A click shorter than a frame is still seen as one.
        io.MouseDown[n] = down_[n] || pressed_[n];
        frames_due_ = pressed_[n] && !down_[n] ? settling_frames : frames_due_;
        pressed_[n] = false;
    }
}

bool Input::any_button_down() const {
    return std::find(down_.begin(), down_.end(), true) != down_.end();
}

bool Input::focused() const {
    return glfwGetWindowAttrib(window_.handle(), GLFW_FOCUSED) != 0;
}

void set_up_imgui_input(context::Window& window) {
    ImGuiIO& io = ImGui::GetIO();
    io.BackendPlatformName = "bruma";
    const auto map = [&](ImGuiKey key, int native) { io.KeyMap[key] = native; };
    map(ImGuiKey_Tab, GLFW_KEY_TAB);
    map(ImGuiKey_LeftArrow, GLFW_KEY_LEFT);
    map(ImGuiKey_RightArrow, GLFW_KEY_RIGHT);
    map(ImGuiKey_UpArrow, GLFW_KEY_UP);
    map(ImGuiKey_DownArrow, GLFW_KEY_DOWN);
    map(ImGuiKey_PageUp, GLFW_KEY_PAGE_UP);
    map(ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN);
    map(ImGuiKey_Home, GLFW_KEY_HOME);
    map(ImGuiKey_End, GLFW_KEY_END);
    map(ImGuiKey_Insert, GLFW_KEY_INSERT);
    map(ImGuiKey_Delete, GLFW_KEY_DELETE);
    map(ImGuiKey_Backspace, GLFW_KEY_BACKSPACE);
    map(ImGuiKey_Space, GLFW_KEY_SPACE);
    map(ImGuiKey_Enter, GLFW_KEY_ENTER);
    map(ImGuiKey_Escape, GLFW_KEY_ESCAPE);
    map(ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER);
    map(ImGuiKey_A, GLFW_KEY_A);
    map(ImGuiKey_C, GLFW_KEY_C);
    map(ImGuiKey_V, GLFW_KEY_V);
    map(ImGuiKey_X, GLFW_KEY_X);
    map(ImGuiKey_Y, GLFW_KEY_Y);
    map(ImGuiKey_Z, GLFW_KEY_Z);
    io.ClipboardUserData = window.handle();
    io.GetClipboardTextFn = [](void* w) -> const char* {
        static std::string pasted;
        const char* text = glfwGetClipboardString(static_cast<GLFWwindow*>(w));
        const std::optional<std::string> taken = text != nullptr ? pasted_number(text) : std::nullopt;
        pasted = taken.value_or("");
        return taken ? pasted.c_str() : nullptr;
    };
    io.SetClipboardTextFn = [](void* w, const char* text) {
        glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
    };
}

}  // namespace bruma::app
