// Shelf: previous picture, drawn a moment ago. Weather maps at the ends of their sizes.
#include "cloud_scenes.h"
#include "drawing.h"
#include "measure/metrics/image_error.h"

namespace bruma::render {
namespace {

class LongCloudWeather : public Drawing {
  protected:
    /// The usual map with each texel repeated.
    static std::shared_ptr<const scene::WeatherMap> enlarged(const scene::WeatherMap& map, int times_x, int times_y) {
        auto large = std::make_shared<scene::WeatherMap>();
        large->name = map.name;
        large->width = map.width * times_x;
        large->height = map.height * times_y;
        large->rgba.resize(std::size_t(4) * large->width * large->height);
        for (int y = 0; y < large->height; ++y) {
            for (int x = 0; x < large->width; ++x) {
                std::copy_n(&map.rgba[4 * (std::size_t(y / times_y) * map.width + x / times_x)], 4,
                            &large->rgba[4 * (std::size_t(y) * large->width + x)]);
            }
        }
        return large;
    }
    void expect_the_same(int times_x, int times_y) {
        scene::Scene scene = cloud_scene(scene::CloudType::cumulus, CloudView::below);
        const Image usual = draw(scene, {48, 32});
        clouds_in(scene).map = enlarged(**clouds_in(scene).map, times_x, times_y);
        const double rmse = measure::compare_images(draw(scene, {48, 32}), usual).rmse;
        // Texels of 78 m with sharp rims instead of blended ones.
        EXPECT_LE(rmse, 0.05);
        report("RMSE from the usual map", rmse);
    }
};

TEST_F(LongCloudWeather, NeedNotBeSquare) {
    expect_the_same(4, 1);
}

TEST_F(LongCloudWeather, IsUpTo8192By8192) {
    expect_the_same(16, 16);
}

}  // namespace
}  // namespace bruma::render
