#pragma once
#include <glm/glm.hpp>
#include <string>

#include "context/context.h"

struct GLFWwindow;

namespace bruma::context {

/// A window on the desktop with a current OpenGL 4.5 core context, by GLFW.
class Window final : public Context {
  public:
    /// Opens a window of `size` screen units; throws MachineError saying what is missing.
    Window(const std::string& title, glm::ivec2 size);
    ~Window() override;
    std::string way() const override { return "window"; }
    GLFWwindow* handle() const { return window_; }
    glm::ivec2 pixels() const;  ///< size of the framebuffer

  private:
    GLFWwindow* window_ = nullptr;
};

}  // namespace bruma::context
