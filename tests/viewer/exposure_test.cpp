// Shelf: closed form. The exposure that suits a picture, judged by what the display shows.
#include "app/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scene/tone_map.h"

namespace bruma::app {
namespace {

scene::Scene shown_by(scene::ToneMap tone_map) {
    scene::Scene scene;
    scene.display = scene::Display{.tone_map = tone_map};
    return scene;
}

/// What the display shows of a grey.
double shown(double radiance, double ev, scene::ToneMap tone_map) {
    return scene::tone_mapped(tone_map, glm::dvec3(std::exp2(ev) * radiance)).g;
}

Image grey(int width, int height, float radiance) {
    Image picture(width, height);
    for (std::size_t n = 0; n < picture.pixel_count(); ++n) {
        std::fill_n(&picture.rgba[4 * n], 3, radiance);
    }
    return picture;
}

TEST(Exposure, BringsTheBrightestHundredthToNineTenthsOfTheDisplay) {
    // 1000 values of a ramp, the largest channel in turn each of the three; the background is brighter and not counted.
    Image picture(40, 50);
    for (std::size_t n = 0; n < 1000; ++n) {
        picture.rgba[4 * n + n % 3] = 0.02F * float(n) / 999.0F;
        picture.rgba[4 * n + 3] = 0.5F;
        picture.rgba[4 * (n + 1000)] = 5.0F;
    }
    for (std::size_t n = 0; n < scene::enum_words<scene::ToneMap>().size(); ++n) {
        const auto tone_map = scene::ToneMap(n);
        const std::optional<SuitableExposure> found = suitable_exposure(picture, shown_by(tone_map));
        ASSERT_TRUE(found);
        EXPECT_FALSE(found->limited);
        const double hundredth = 0.02 * 990.0 / 999.0;
        EXPECT_GE(shown(hundredth, found->ev, tone_map), 0.9) << n;
        EXPECT_LE(shown(hundredth, found->ev, tone_map), 0.92) << n << ": not more than it takes";
        EXPECT_NEAR(100.0 * found->ev, std::round(100.0 * found->ev), 1e-9) << "to be typed again";
    }
    scene::Scene outdoors = shown_by(scene::ToneMap::none);
    outdoors.outdoors.emplace();
    EXPECT_NEAR(suitable_exposure(picture, outdoors)->ev, std::log2(0.91 / 5.0), 0.011) << "the sky is seen, too";
}

TEST(Exposure, CountsTheBackgroundWhereNothingElseIs) {
    EXPECT_NEAR(suitable_exposure(grey(10, 10, 5.0F), {})->ev, std::log2(0.91 / 5.0), 0.011);
    EXPECT_FALSE(suitable_exposure(Image(8, 8), {}));
    EXPECT_FALSE(suitable_exposure(Image(), {}));
}

TEST(Exposure, StaysWithinASensibleSpan) {
    const std::optional<SuitableExposure> dark = suitable_exposure(grey(8, 8, 1e-12F), {});
    ASSERT_TRUE(dark);
    EXPECT_EQ(dark->ev, most_exposure_ev);
    EXPECT_TRUE(dark->limited);
    EXPECT_NE(limit_words(*dark).find("dark"), std::string::npos);
    const std::optional<SuitableExposure> bright = suitable_exposure(grey(8, 8, 1e12F), {});
    ASSERT_TRUE(bright);
    EXPECT_EQ(bright->ev, -most_exposure_ev);
    EXPECT_TRUE(bright->limited);
    EXPECT_FALSE(suitable_exposure(grey(8, 8, 1e-3F), {})->limited);
    EXPECT_EQ(limit_words({}), "");
}

TEST(Exposure, HeedsNoFewPixels) {
    Image picture = grey(50, 20, 0.1F);
    const double plain = suitable_exposure(picture, {})->ev;
    // Nine of a thousand that are far too bright, not finite, or black.
    for (std::size_t n = 0; n < 9; ++n) {
        picture.rgba[4 * n] = 1e6F;
    }
    EXPECT_EQ(suitable_exposure(picture, {})->ev, plain);
    for (std::size_t n = 0; n < 9; ++n) {
        picture.rgba[4 * n] =
            n % 2 == 0 ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
    }
    EXPECT_EQ(suitable_exposure(picture, {})->ev, plain);
    // A small thing, of which one pixel glints.
    Image small(64, 64);
    for (std::size_t n = 0; n < 20; ++n) {
        std::fill_n(&small.rgba[4 * n], 4, n == 0 ? 1e5F : 0.1F);
    }
    EXPECT_EQ(suitable_exposure(small, {})->ev, plain);
    // Stars: fewer than a hundredth shine, and are not nothing.
    Image stars(100, 100);
    for (std::size_t n = 0; n < 50; ++n) {
        std::fill_n(&stars.rgba[4 * n], 3, 0.1F);
    }
    EXPECT_EQ(suitable_exposure(stars, {})->ev, plain);
}

}  // namespace
}  // namespace bruma::app
