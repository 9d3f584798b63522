#pragma once
#include "gl/object.h"
#include "gl/program.h"

namespace bruma::gl {

/// Runs a fragment program once for every pixel of the bound framebuffer's viewport, whatever state was left before.
/// `full_screen.vert` makes one triangle that covers it out of nothing.
class FullScreen {
  public:
    /// With `add` to what is there.
    void draw(const Program& program, bool add = false) const {
        if (add) {
            glEnable(GL_BLEND);
            glBlendFunc(GL_ONE, GL_ONE);
        } else {
            glDisable(GL_BLEND);
        }
        glDisable(GL_DEPTH_TEST);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_CULL_FACE);
        glBindVertexArray(no_vertices_.name());
        program.use();
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

  private:
    VertexArray no_vertices_{"no vertices"};
};

}  // namespace bruma::gl
