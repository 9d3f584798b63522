#include "render/compose/presenter.h"

#include <algorithm>
#include <cmath>

namespace bruma::render {

void Presenter::draw(const Picture& picture, const scene::Display& display, glm::ivec2 pixels) {
    gl::Program& program = shaders_.get("compose/composite.frag");
    program.set("picture", 0);
    program.set("pixels", glm::vec2(pixels));
    program.set("exposure", float(std::exp2(display.exposure_ev)));
    program.set("tone_map", int(display.tone_map));
    program.set("dither", display.dither ? 1 : 0);
    picture.color.bind(0);
    full_screen_.draw(program);
}

std::vector<std::uint8_t> Presenter::read(const Picture& picture, const scene::Display& display) {
    const glm::ivec2 size(picture.color.size());
    const gl::Texture target = gl::Texture::make_2d("display", GL_RGBA8, size);
    const gl::Framebuffer framebuffer("display", {&target});
    framebuffer.bind();
    draw(picture, display, size);
    const std::size_t row = std::size_t(4) * size.x;
    // Deleted while bound, Mesa would go on drawing into the window as it did here: upside down.
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    std::vector<std::uint8_t> bottom_up(row * size.y);
    target.download({GL_RGBA, GL_UNSIGNED_BYTE}, bottom_up.size(), bottom_up.data());
    std::vector<std::uint8_t> bytes(bottom_up.size());
    for (int y = 0; y < size.y; ++y) {
        std::copy_n(bottom_up.begin() + std::ptrdiff_t(row * (size.y - 1 - y)), row,
                    bytes.begin() + std::ptrdiff_t(row * y));
    }
    return bytes;
}

}  // namespace bruma::render
