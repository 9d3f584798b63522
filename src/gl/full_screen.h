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
        cover(program);
    }
    /// Of a program that writes depth, into a framebuffer that has it.
    void draw_with_depth(const Program& program) const { draw_tested(program, GL_ALWAYS, GL_TRUE); }
    /// Only where depth is 1 and not 0: elsewhere the program is not run at all.
    void draw_where_deep(const Program& program) const { draw_tested(program, GL_LESS, GL_FALSE); }

  private:
    void draw_tested(const Program& program, GLenum test, GLboolean writes) const {
        glDisable(GL_BLEND);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(test);
        glDepthMask(writes);
        cover(program);
        glDisable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
    }
    void cover(const Program& program) const {
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_CULL_FACE);
        glBindVertexArray(no_vertices_.name());
        program.use();
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    VertexArray no_vertices_{"no vertices"};
};

}  // namespace bruma::gl
