#include "app/viewer/viewer.h"

#include <GL/glew.h>
#include <GLFW/glfw3.h>
#include <fmt/core.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

#include <algorithm>

#include "app/panels/theme.h"
#include "app/viewer/driver.h"
#include "app/viewer/input.h"
#include "app/viewer/workbench.h"
#include "base/console.h"
#include "base/error.h"
#include "base/installation.h"
#include "context/window.h"
#include "io/picture/picture_file.h"

namespace bruma::app {
namespace {

constexpr double shader_poll_s = 0.5;
constexpr double driven_turn_s = 0.005;   ///< between looks at what a script waits for
constexpr double progress_frame_s = 0.1;  ///< between frames while a file is being read

/// ImGui for as long as the window lives.
class ImGuiSession {
  public:
    explicit ImGuiSession(context::Window& window) {
        IMGUI_CHECKVERSION();
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;               // nothing is left behind in the working directory
        ImGui::GetIO().ConfigInputTextCursorBlink = false;  // an idle window draws nothing
        float scale_x = 1.0F;
        float scale_y = 1.0F;
        glfwGetWindowContentScale(window.handle(), &scale_x, &scale_y);
        apply_theme(std::max(1.0F, scale_x));
        set_up_imgui_input(window);
        ImGui_ImplOpenGL3_Init("#version 450 core");
    }
    ImGuiSession(const ImGuiSession&) = delete;
    ImGuiSession& operator=(const ImGuiSession&) = delete;
    ~ImGuiSession() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui::DestroyContext();
    }
};

/// The whole window as it was just drawn.
io::Picture8 read_window(glm::ivec2 pixels) {
    io::Picture8 picture{pixels.x, pixels.y, {}};
    const std::size_t row = std::size_t(4) * pixels.x;
    std::vector<std::uint8_t> bottom_up(row * pixels.y);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadBuffer(GL_BACK);
    glReadPixels(0, 0, pixels.x, pixels.y, GL_RGBA, GL_UNSIGNED_BYTE, bottom_up.data());
    for (int y = pixels.y - 1; y >= 0; --y) {
        picture.rgba.insert(picture.rgba.end(), bottom_up.begin() + std::ptrdiff_t(row * y),
                            bottom_up.begin() + std::ptrdiff_t(row * (y + 1)));
    }
    for (std::size_t n = 3; n < picture.rgba.size(); n += 4) {
        picture.rgba[n] = 255;
    }
    return picture;
}

/// The window's loop: sleeps until something happens, draws while frames are due.
class ViewerLoop {
  public:
    explicit ViewerLoop(const ViewRequest& request)
        : window_("Bruma", {request.width, request.height}),
          imgui_(window_),
          input_(window_),
          shaders_(installed_folder("shaders")),
          workbench_(request, shaders_, [] { glfwPostEmptyEvent(); }) {
        const bool driven = !request.drive_script.empty();
        input_.listen(driven);
        if (driven) {
            driver_.emplace(request.drive_script, input_, workbench_);
        }
        shaders_.reload_if_saved();
        workbench_.open(request.files.empty() ? std::vector<std::string>{"builtin:demo"} : request.files,
                        request.hints);
    }

    int run() {
        while (!workbench_.wants_to_close()) {
            if (input_.frame_is_due()) {
                glfwPollEvents();
            } else {
                wait();
            }
            after_events();
            if (driver_ && !input_.frame_is_due()) {
                if (driver_->finished()) {
                    return 0;
                }
                driver_->act(glfwGetTime());
            }
            if (input_.frame_is_due()) {
                draw();
            }
        }
        if (driver_) {
            driver_->closed();
        }
        return 0;
    }

  private:
    void wait() {
        double until = glfwGetTime() + (driver_ ? driven_turn_s : input_.focused() ? shader_poll_s : 3600.0);
        until = std::min(until, workbench_.next_frame_at().value_or(until));
        if (workbench_.is_loading()) {
            until = std::min(until, drawn_at_ + progress_frame_s);
        }
        glfwWaitEventsTimeout(std::max(1e-3, until - glfwGetTime()));
    }

    void after_events() {
        const double now = glfwGetTime();
        if (workbench_.take_loaded()) {
            input_.disturbed();
        }
        const bool show_progress = workbench_.is_loading() && now >= drawn_at_ + progress_frame_s;
        if (show_progress || workbench_.next_frame_at().value_or(now + 1.0) <= now) {
            input_.one_frame();
        }
        if (input_.take_close_asked()) {
            workbench_.ask_to_close();
        }
        if (std::vector<std::string> files = input_.take_dropped(); !files.empty()) {
            workbench_.open(std::move(files), {});
        }
        if (now - shaders_looked_at_ >= shader_poll_s && (driver_ || input_.focused())) {
            shaders_looked_at_ = now;
            const std::string fault = shaders_.last_fault();
            if (shaders_.reload_if_saved() || shaders_.last_fault() != fault) {
                workbench_.set_shader_fault(shaders_.last_fault());
                input_.disturbed();
            }
        }
    }

    void draw() {
        const double now = glfwGetTime();
        drawn_at_ = now;
        input_.begin_frame(now);
        ImGui_ImplOpenGL3_NewFrame();
        ImGui::NewFrame();
        workbench_.frame(window_.pixels(), now);
        ImGui::Render();
        const glm::ivec2 pixels = window_.pixels();
        glViewport(0, 0, pixels.x, pixels.y);
        ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
        if (driver_) {
            if (const std::string path = driver_->take_screenshot_path(); !path.empty()) {
                io::write_png(path, read_window(pixels));
            }
        }
        glfwSwapBuffers(window_.handle());
        if (std::string title = workbench_.title(); title != title_) {
            title_ = std::move(title);
            glfwSetWindowTitle(window_.handle(), title_.c_str());
        }
    }

    context::Window window_;
    ImGuiSession imgui_;
    Input input_;
    gl::ShaderLibrary shaders_;
    Workbench workbench_;
    std::optional<Driver> driver_;
    std::string title_ = "Bruma";
    double shaders_looked_at_ = 0.0, drawn_at_ = 0.0;
};

}  // namespace

int run_viewer(const ViewRequest& request) {
    try {
        return ViewerLoop(request).run();
    } catch (const DriveFault& fault) {
        say("bruma: {}\n", fault.what());
        return int(ExitCode::answer_is_no);
    }
}

}  // namespace bruma::app
