#pragma once
#include "gl/full_screen.h"
#include "gl/query.h"
#include "gl/shader_library.h"
#include "render/products/picture.h"

namespace bruma::render {

/// Whether the nodes of a scene cover anything of a picture. Sky and background cover nothing. It looks at blocks of
/// 8 x 8 pixels up to the first that is covered, so that it costs much less than drawing the picture did; no pass of
/// the graph, since it is asked once a picture stands still.
class PictureCoverage {
  public:
    explicit PictureCoverage(gl::ShaderLibrary& shaders) : shaders_(shaders) {}

    /// Whether any pixel's opacity is above 1/1024, below which none shows in 8 bits. Waits for the GPU. Leaves another
    /// framebuffer bound for drawing.
    bool covers_any(const Picture& picture);

  private:
    gl::ShaderLibrary& shaders_;
    gl::FullScreen full_screen_;
    gl::Query covered_{"covered blocks", GL_ANY_SAMPLES_PASSED};
    gl::Texture blocks_;
    gl::Framebuffer framebuffer_;
};

}  // namespace bruma::render
