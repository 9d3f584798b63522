#include "context/window.h"

// GLEW must come before GLFW, which else includes the plain GL header.
#include <GL/glew.h>
#include <GLFW/glfw3.h>

#include "base/error.h"
#include "base/log.h"

namespace bruma::context {
namespace {

std::string last_glfw_error() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

}  // namespace

Window::Window(const std::string& title, glm::ivec2 size) {
    if (!glfwInit()) {
        throw MachineError("no window can be opened (" + last_glfw_error() +
                           "); is a display there? 'bruma render FILE -o picture.png' needs none");
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    window_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
    if (!window_) {
        const std::string reason = last_glfw_error();
        glfwTerminate();
        throw MachineError("no window with OpenGL 4.5 (" + reason +
                           "); a newer driver or Debian's libgl1-mesa-dri has it");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    load_entry_points();
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

glm::ivec2 Window::pixels() const {
    glm::ivec2 size{0};
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

}  // namespace bruma::context
