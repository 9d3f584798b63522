// Shelf: closed form. The curves that the display gets are those that the program reckons with.
#include <cmath>

#include "drawing.h"
#include "io/picture/picture_file.h"
#include "render/compose/presenter.h"
#include "scene/tone_map.h"

namespace bruma::render {
namespace {

class ToneMap : public Drawing {};

TEST_F(ToneMap, TheDisplayShowsWhatIsReckonedWith) {
    // A ramp of colours of three strengths, up to a red of 24; doubled by the exposure.
    constexpr int height = 512;
    scene::Scene scene;
    scene.camera.emplace();
    scene.background = scene::Background{.top = {24.0, 3.0, 0.4}, .bottom = glm::dvec3(0.0)};
    Renderer renderer(shaders());
    renderer.render(scene, {{2, height}, 1.0});
    const Image linear = renderer.read_picture();
    Presenter presenter(shaders());
    for (std::size_t n = 0; n < scene::enum_words<scene::ToneMap>().size(); ++n) {
        const scene::Display display{.exposure_ev = 1.0, .tone_map = scene::ToneMap(n), .dither = false};
        const std::vector<std::uint8_t> bytes = presenter.read(renderer.picture(), display);
        for (int y = 0; y < height; ++y) {
            const float* const rgba = linear.pixel(0, y);
            const glm::dvec3 shown = scene::tone_mapped(scene::ToneMap(n), 2.0 * glm::dvec3(rgba[0], rgba[1], rgba[2]));
            for (int channel = 0; channel < 3; ++channel) {
                const double code = bytes[8 * std::size_t(y) + channel];
                // Half a step of rounding, and the powers of a GPU.
                EXPECT_GE(shown[channel], io::linear_of_srgb(std::max(0.0, code - 0.51) / 255.0) - 1e-4)
                    << n << ", " << y;
                EXPECT_LE(shown[channel], io::linear_of_srgb((code + 0.51) / 255.0) + 1e-4) << n << ", " << y;
            }
        }
    }
}

}  // namespace
}  // namespace bruma::render
