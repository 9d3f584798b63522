#include "render/compose/picture_coverage.h"

namespace bruma::render {

bool PictureCoverage::covers_any(const Picture& picture) {
    constexpr int edge = 8;  // as in coverage.frag
    const glm::ivec2 blocks = (glm::ivec2(picture.color.size()) + edge - 1) / edge;
    if (!blocks_ || glm::ivec2(blocks_.size()) != blocks) {
        framebuffer_ = {};
        blocks_ = gl::Texture::make_2d("covered blocks", GL_R8, blocks);
        framebuffer_ = gl::Framebuffer("covered blocks", {&blocks_});
    }
    framebuffer_.bind();
    gl::Program& program = shaders_.get("compose/coverage.frag");
    program.set("picture", 0);
    picture.color.bind(0);
    covered_.begin();
    full_screen_.draw(program);
    return covered_.end() != 0;
}

}  // namespace bruma::render
