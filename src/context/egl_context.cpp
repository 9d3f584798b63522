#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <string>

#include "base/error.h"
#include "base/log.h"
#include "context/context.h"

namespace bruma::context {
namespace {

class EglContext final : public Context {
  public:
    EglContext(EGLDisplay display, EGLContext context, std::string way)
        : display_(display), context_(context), way_(std::move(way)) {}
    ~EglContext() override {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(display_, context_);
        eglTerminate(display_);
    }
    std::string way() const override { return way_; }

  private:
    EGLDisplay display_;
    EGLContext context_;
    std::string way_;
};

/// A current 4.5 core context on this display, or null with the reason added to `tried`.
std::unique_ptr<Context> try_display(EGLDisplay display, const std::string& way, std::string& tried) {
    const auto give_up = [&](const std::string& reason) {
        tried += (tried.empty() ? "" : "; ") + way + ": " + reason;
        return nullptr;
    };
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
        return give_up("no display");
    }
    eglBindAPI(EGL_OPENGL_API);
    const std::array<EGLint, 9> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                       4,
                                       EGL_CONTEXT_MINOR_VERSION,
                                       5,
                                       EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                       EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                       EGL_CONTEXT_OPENGL_DEBUG,
                                       EGL_TRUE,
                                       EGL_NONE};
    const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
    if (context == EGL_NO_CONTEXT) {
        eglTerminate(display);
        return give_up("no OpenGL 4.5 core");
    }
    if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        eglDestroyContext(display, context);
        eglTerminate(display);
        return give_up("context cannot be made current without a surface");
    }
    return std::make_unique<EglContext>(display, context, way);
}

}  // namespace

std::unique_ptr<Context> open_offscreen(Kind kind) {
    if (kind == Kind::osmesa) {
        throw MachineError("this program has no OSMesa; its sibling bruma-osmesa has");
    }
    std::string tried;
    const auto platform_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    std::unique_ptr<Context> context;
    if (platform_display && query_devices) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        query_devices(EGLint(devices.size()), devices.data(), &count);
        for (EGLint n = 0; n < count && !context; ++n) {
            context = try_display(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[std::size_t(n)], nullptr),
                                  fmt::format("EGL device {}", n), tried);
        }
    }
    if (platform_display && !context) {
        context = try_display(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr),
                              "EGL surfaceless", tried);
    }
    if (!context) {
        throw MachineError("no OpenGL 4.5 through EGL (" + (tried.empty() ? "no platform" : tried) +
                           "); install a driver or Debian's libgl1-mesa-dri and libegl1, or use --context osmesa "
                           "with Debian's libosmesa6");
    }
    load_entry_points();
    return context;
}

bool offers(Kind kind) {
    return kind != Kind::osmesa;
}

}  // namespace bruma::context
