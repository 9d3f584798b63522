#pragma once
#include <cstdint>
#include <vector>

#include "gl/full_screen.h"
#include "gl/shader_library.h"
#include "render/products/picture.h"
#include "scene/rendering.h"

namespace bruma::render {

/// Turns the linear picture into display values. Not a pass of the graph: a window is drawn afresh whenever its panels
/// are, and a file is written once.
class Presenter {
  public:
    explicit Presenter(gl::ShaderLibrary& shaders) : shaders_(shaders) {}

    /// Draws over the whole of the bound framebuffer of `pixels`, stretching if the picture has another size.
    void draw(const Picture& picture, const scene::Display& display, glm::ivec2 pixels);

    /// Display values in memory: 8-bit sRGB RGBA, top row first, opaque.
    std::vector<std::uint8_t> read(const Picture& picture, const scene::Display& display);

  private:
    gl::ShaderLibrary& shaders_;
    gl::FullScreen full_screen_;
};

}  // namespace bruma::render
