#include <GL/glew.h>
// osmesa.h expects these two, which glew.h takes back at its end.
#define GLAPI extern
#define GLAPIENTRY
#include <GL/osmesa.h>

#include <array>

#include "base/error.h"
#include "base/log.h"
#include "context/context.h"

/// GLEW asks GLX for entry points. In this program there is no GLX: the executable answers in its place.
extern "C" __attribute__((visibility("default"))) void (*glXGetProcAddressARB(const GLubyte* name))() {
    return OSMesaGetProcAddress(reinterpret_cast<const char*>(name));
}

namespace bruma::context {
namespace {

class OsmesaContext final : public Context {
  public:
    OsmesaContext() {
        const std::array<int, 15> wanted{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_DEPTH_BITS,
                                         24,
                                         OSMESA_STENCIL_BITS,
                                         8,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         4,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         5,
                                         0,
                                         0,
                                         0};
        context_ = OSMesaCreateContextAttribs(wanted.data(), nullptr);
        if (!context_) {
            throw MachineError("OSMesa gives no OpenGL 4.5 core context; Debian's libosmesa6 22.3 does");
        }
        // OSMesa draws into memory of ours; everything real goes to framebuffer objects, so one pixel is enough.
        if (!OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1)) {
            OSMesaDestroyContext(context_);
            throw MachineError("OSMesa gives a context but cannot make it current");
        }
    }
    ~OsmesaContext() override {
        OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
        OSMesaDestroyContext(context_);
    }
    std::string way() const override { return "OSMesa"; }

  private:
    std::array<unsigned char, 4> pixel_{};
    OSMesaContext context_ = nullptr;
};

}  // namespace

std::unique_ptr<Context> open_offscreen(Kind kind) {
    if (kind == Kind::egl) {
        throw MachineError("this program has no EGL; its sibling bruma has");
    }
    auto context = std::make_unique<OsmesaContext>();
    load_entry_points();
    return context;
}

bool offers(Kind kind) {
    return kind != Kind::egl;
}

}  // namespace bruma::context
