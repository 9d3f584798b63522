// Shelf: closed form. What the display shows of linear light, for each tone map.
#include "scene/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bruma::scene {
namespace {

TEST(ToneMap, NoneClips) {
    EXPECT_EQ(tone_mapped(ToneMap::none, {0.25, 1.5, -1.0}), glm::dvec3(0.25, 1.0, 0.0));
}

TEST(ToneMap, FilmicShowsNineTenthsAsDusk) {
    // Hable's curve at 0.9 over that at 11.2: 0.1705 / 0.6315 - 1 / 15 over 19.38 / 24.476 - 1 / 15.
    EXPECT_NEAR(tone_mapped(ToneMap::filmic, glm::dvec3(0.9)).g, 0.2804, 1e-4);
    EXPECT_NEAR(tone_mapped(ToneMap::filmic, glm::dvec3(11.2)).g, 1.0, 1e-12);
}

TEST(ToneMap, EachIsBlackAtNothingWhiteInTheEndAndNeverFalls) {
    for (std::size_t n = 0; n < enum_words<ToneMap>().size(); ++n) {
        const auto tone_map = ToneMap(n);
        EXPECT_NEAR(tone_mapped(tone_map, glm::dvec3(0.0)).g, 0.0, 1e-12) << n;
        EXPECT_GT(tone_mapped(tone_map, glm::dvec3(1e4)).g, 0.95) << n << ": exposures look for 0.91";
        for (const glm::dvec3& color : {glm::dvec3(1.0), glm::dvec3(1.0, 0.2, 0.0), glm::dvec3(0.1, 0.3, 1.0)}) {
            double before = -1.0;
            for (double ev = -20.0; ev < 60.0; ev += 0.1) {
                const glm::dvec3 shown = tone_mapped(tone_map, std::exp2(ev) * color);
                const double largest = std::max({shown.r, shown.g, shown.b});
                EXPECT_GE(largest, before) << n << " at " << ev;
                before = largest;
            }
        }
    }
}

TEST(ToneMap, PicturesAreShownPixelByPixel) {
    Image linear(2, 1);
    linear.rgba = {0.25F, 0.5F, 9.0F, 0.5F, 0.0F, 0.1F, 0.2F, 1.0F};
    const Image doubled = shown_image(linear, Display{.exposure_ev = 1.0});
    EXPECT_EQ(doubled.rgba, (std::vector<float>{0.5F, 1.0F, 1.0F, 0.5F, 0.0F, 0.2F, 0.4F, 1.0F}));
}

}  // namespace
}  // namespace bruma::scene
