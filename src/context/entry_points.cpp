#include <GL/glew.h>

#include <atomic>
#include <cstring>

#include "base/error.h"
#include "base/log.h"
#include "context/context.h"

namespace bruma::context {
namespace {

std::atomic<int> error_messages{0};

/// Whether a message tells of a fault of this program. A shader that does not compile is no such fault: whoever
/// compiled it throws, with the driver's words. What the compiler only warns of is told nowhere else.
bool tells_fault(GLenum source, GLenum type, GLenum severity, const GLchar* text) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER && type == GL_DEBUG_TYPE_ERROR) {
        return false;
    }
    return type == GL_DEBUG_TYPE_ERROR || severity == GL_DEBUG_SEVERITY_HIGH ||
           std::strstr(text, "uninitialized") != nullptr;
}

void GLAPIENTRY on_driver_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei, const GLchar* text,
                                  const void*) {
    if (tells_fault(source, type, severity, text)) {
        ++error_messages;
    }
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) {
        return;
    }
    if (type == GL_DEBUG_TYPE_ERROR) {
        log_error("OpenGL ({}): {}", id, text);
    } else if (severity == GL_DEBUG_SEVERITY_HIGH) {
        log_warning("OpenGL ({}): {}", id, text);
    } else {
        log_detail("OpenGL ({}): {}", id, text);
    }
}

std::string gl_string(GLenum name) {
    const auto* text = reinterpret_cast<const char*>(glGetString(name));
    return text ? text : "unknown";
}

}  // namespace

void load_entry_points() {
    glewExperimental = GL_TRUE;
    const GLenum status = glewInit();
    // GLEW is built for GLX and complains where there is none (no X display: EGL; no GLX at all: OSMesa) although every
    // entry point was found.
    if (status != GLEW_OK && status != GLEW_ERROR_NO_GLX_DISPLAY && status != GLEW_ERROR_GLX_VERSION_11_ONLY) {
        throw MachineError(std::string("OpenGL entry points cannot be loaded: ") +
                           reinterpret_cast<const char*>(glewGetErrorString(status)));
    }
    while (glGetError() != GL_NO_ERROR) {
    }
    GLint major = 0;
    GLint minor = 0;
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    if (major * 10 + minor < 45) {
        throw MachineError(
            fmt::format("OpenGL {}.{} ({}) is here, but 4.5 is needed; a newer driver or Debian's "
                        "libgl1-mesa-dri (software) has it",
                        major, minor, gl_string(GL_RENDERER)));
    }
    if (!glCreateTextures || !glDispatchCompute || !glClipControl || !glTextureStorage3D || !glBindImageTexture ||
        !glMemoryBarrier || !glCreateQueries || !glDebugMessageCallback || !glObjectLabel) {
        throw MachineError("OpenGL 4.5 is announced by " + gl_string(GL_RENDERER) +
                           ", but entry points are missing; another driver or Debian's libgl1-mesa-dri has them");
    }
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(on_driver_message, nullptr);
    const DriverInfo info = driver_info();
    log_detail("OpenGL: {} | {} | {}", info.vendor, info.renderer, info.version);
}

DriverInfo driver_info() {
    DriverInfo info{gl_string(GL_VENDOR), gl_string(GL_RENDERER), gl_string(GL_VERSION)};
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &info.largest_3d_texture);
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &info.largest_2d_texture);
    info.software =
        info.renderer.find("llvmpipe") != std::string::npos || info.renderer.find("softpipe") != std::string::npos;
    return info;
}

int driver_error_count() {
    return error_messages;
}

void forget_driver_errors(int count) {
    error_messages -= count;
}

}  // namespace bruma::context
