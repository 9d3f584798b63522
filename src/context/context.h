#pragma once
#include <memory>
#include <string>

namespace bruma::context {

/// Ways to a current OpenGL 4.5 core context without a window. `automatic` tries EGL, then OSMesa.
enum class Kind { automatic, egl, osmesa };

/// A current OpenGL 4.5 core context. It is current on the thread that made it, for as long as it lives.
class Context {
  public:
    Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;
    virtual ~Context() = default;
    /// How it was obtained: "EGL device", "OSMesa", "window".
    virtual std::string way() const = 0;
};

/// What the driver says of itself.
struct DriverInfo {
    std::string vendor, renderer, version;
    int largest_3d_texture = 0;  ///< samples along an edge
    int largest_2d_texture = 0;  ///< pixels along an edge
    bool software = false;       ///< drawn by the CPU (llvmpipe, softpipe)
};
DriverInfo driver_info();

/// Opens an offscreen context of one of the kinds that this program was linked with; throws MachineError saying what
/// was tried and which package helps.
std::unique_ptr<Context> open_offscreen(Kind kind);

/// Whether this program can open that kind itself (else its sibling program can).
bool offers(Kind kind);

/// Loads all entry points for the current context, checks for 4.5 core, and routes KHR_debug messages to the log.
/// Called by every way of obtaining a context; throws MachineError.
void load_entry_points();

/// Driver messages so far in this process that tell of a fault of this program: errors of calls, and warnings about
/// shaders, such as of variables that are read before they are written. Tests fail when it is not zero.
int driver_error_count();
/// Takes that many off the count: a test caused them.
void forget_driver_errors(int count);

}  // namespace bruma::context
