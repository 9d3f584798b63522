#include "offscreen.h"

#include "base/error.h"
#include "base/installation.h"

namespace bruma::render {
namespace {

std::unique_ptr<context::Context> current;
std::unique_ptr<gl::ShaderLibrary> library;
std::string refusal;

}  // namespace

std::string Offscreen::open() {
    if (!current && refusal.empty()) {
        try {
            current = context::open_offscreen(context::Kind::automatic);
            library = std::make_unique<gl::ShaderLibrary>(installed_folder("shaders"));
        } catch (const MachineError& error) {
            refusal = error.what();
        }
    }
    return refusal;
}

gl::ShaderLibrary& Offscreen::shaders() {
    return *library;
}

void Offscreen::TearDown() {
    EXPECT_EQ(context::driver_error_count(), 0) << "the driver told of faults, see the messages above";
    library.reset();
    current.reset();
}

}  // namespace bruma::render
