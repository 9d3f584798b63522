// Shelf: closed form. A gradient too soft for eight bits keeps its slope in the mean of what is displayed.
#include <algorithm>
#include <cmath>

#include "drawing.h"
#include "io/picture/picture_file.h"
#include "render/compose/presenter.h"

namespace bruma::render {
namespace {

class Dither : public Drawing {
  protected:
    /// Largest difference, in 8-bit steps, between a row's mean and its exact display value: of a gradient that rises
    /// by four steps over the picture's height.
    double largest_band(bool dither) {
        scene::Scene scene;
        scene.camera.emplace();
        const double low = io::linear_of_srgb(120.0 / 255.0), high = io::linear_of_srgb(124.0 / 255.0);
        scene.background = scene::Background{.top = glm::dvec3(high), .bottom = glm::dvec3(low)};
        scene.display.edit([dither](scene::Display& display) { display.dither = dither; });
        constexpr glm::ivec2 pixels(1024, 64);
        Renderer renderer(shaders());
        renderer.render(scene, {pixels, 1.0});
        Presenter presenter(shaders());
        const std::vector<std::uint8_t> bytes = presenter.read(renderer.picture(), *scene.display);
        EXPECT_EQ(bytes, presenter.read(renderer.picture(), *scene.display)) << "the same noise each time";
        double largest = 0.0;
        for (int y = 0; y < pixels.y; ++y) {
            const double linear = high + (low - high) * (y + 0.5) / pixels.y;
            const double exact = 255.0 * (1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
            double mean = 0.0;
            for (int x = 0; x < pixels.x; ++x) {
                mean += bytes[4 * (std::size_t(y) * pixels.x + x)] / double(pixels.x);
            }
            largest = std::max(largest, std::abs(mean - exact));
        }
        return largest;
    }
};

TEST_F(Dither, LeavesNoBands) {
    // Triangular noise of one step in all leaves at most an eighth of a step, where the value lies a quarter of a step
    // beside a code; 1024 pixels of it scatter by 0.4 / 32, of which three.
    const double dithered = largest_band(true);
    EXPECT_LE(dithered, 0.125 + 0.04);
    EXPECT_GE(largest_band(false), 0.45) << "without it there are bands to hide";
    report("largest band under dither, 8-bit steps", dithered);
}

}  // namespace
}  // namespace bruma::render
