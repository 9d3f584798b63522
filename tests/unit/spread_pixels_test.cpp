// Shelf: closed form. Some pixels of a picture that stand for all of it, and the error they tell.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "measure/bench/clouds/bench_clouds.h"

namespace bruma::measure {
namespace {

Image grey(int width, int height, float value) {
    Image image(width, height);
    for (std::size_t n = 0; n < image.rgba.size(); ++n) {
        image.rgba[n] = n % 4 == 3 ? 1.0F : value;
    }
    return image;
}

void set(Image& image, std::size_t place, float red, float green, float blue) {
    image.rgba[4 * place] = red;
    image.rgba[4 * place + 1] = green;
    image.rgba[4 * place + 2] = blue;
}

TEST(SpreadPixels, AreEachOnceAndAlwaysTheSame) {
    for (const glm::ivec2 pixels : {glm::ivec2(1, 1), glm::ivec2(7, 3), glm::ivec2(64, 36), glm::ivec2(1, 50)}) {
        const int all = pixels.x * pixels.y;
        for (const int count : {0, 1, all / 2, all, all + 10, -3}) {
            std::vector<std::size_t> places = spread_pixels(pixels, count);
            EXPECT_EQ(places, spread_pixels(pixels, count));
            EXPECT_EQ(places.size(), std::size_t(std::clamp(count, 0, all)));
            std::sort(places.begin(), places.end());
            EXPECT_EQ(std::unique(places.begin(), places.end()), places.end());
            EXPECT_TRUE(places.empty() || places.back() < std::size_t(all));
        }
    }
    EXPECT_EQ(spread_pixels({8, 8}, 1), std::vector<std::size_t>{4 * 8 + 4}) << "the middle first";
}

TEST(SpreadPixels, AFewMoreContinueTheSequence) {
    const std::vector<std::size_t> few = spread_pixels({64, 36}, 50), more = spread_pixels({64, 36}, 80);
    EXPECT_TRUE(std::equal(few.begin(), few.end(), more.begin()));
}

TEST(SpreadPixels, EveryPartOfThePictureHasItsShare) {
    // 256 of 64 x 64 pixels: 16 for each of 4 x 4 blocks. Random ones vary by sqrt(16 * 15 / 16) = 3.9, so that among
    // 16 blocks one off by 6 and more is the rule; the sequence is asked for less than one such deviation.
    std::array<int, 16> in_block{};
    for (const std::size_t place : spread_pixels({64, 64}, 256)) {
        ++in_block[4 * (place / 64 / 16) + place % 64 / 16];
    }
    EXPECT_GE(*std::min_element(in_block.begin(), in_block.end()), 13);
    EXPECT_LE(*std::max_element(in_block.begin(), in_block.end()), 19);
}

TEST(ErrorAt, OfEqualPicturesIsNothing) {
    const Image image = grey(4, 4, 0.5F);
    const SpreadError error = error_at({0, 5, 15}, image, image);
    EXPECT_EQ(error.rmse, 0.0);
    EXPECT_EQ(error.standard_error, 0.0);
    EXPECT_EQ(error.relative_rmse, 0.0);
    EXPECT_EQ(error.bias, 0.0);
    EXPECT_EQ(error_at({}, image, grey(4, 4, 0.1F)).rmse, 0.0) << "of no pixels";
}

TEST(ErrorAt, OfAConstantOffsetIsThatOffset) {
    // All numbers are exact in single precision, so that rounding of doubles alone remains.
    const SpreadError darker = error_at({0, 1, 2, 3}, grey(2, 2, 0.25F), grey(2, 2, 0.5F));
    EXPECT_NEAR(darker.rmse, 0.25, 1e-15);
    EXPECT_NEAR(darker.bias, -0.25, 1e-15);
    EXPECT_NEAR(darker.relative_rmse, 0.5, 1e-15);
    EXPECT_NEAR(darker.standard_error, 0.0, 1e-15) << "all pixels agree";
}

TEST(ErrorAt, LooksAtTheNamedPixelsAlone) {
    Image found = grey(2, 2, 0.5F);
    set(found, 2, 9.0F, 9.0F, 9.0F);
    EXPECT_EQ(error_at({0, 1, 3}, found, grey(2, 2, 0.5F)).rmse, 0.0);
    EXPECT_NEAR(error_at({2}, found, grey(2, 2, 0.5F)).rmse, 0.5, 1e-15) << "brighter than 1 counts as 1";
    EXPECT_EQ(error_at({2}, found, grey(2, 2, 4.0F)).rmse, 0.0) << "in both pictures";
}

TEST(ErrorAt, AveragesOverColoursAndPixels) {
    const Image truth = grey(2, 1, 0.5F);
    Image found = truth;
    set(found, 0, 0.75F, 0.5F, 0.25F);  // no bias: 0.0625 in red and in blue
    const SpreadError error = error_at({0, 1}, found, truth);
    EXPECT_NEAR(error.bias, 0.0, 1e-15);
    EXPECT_NEAR(error.rmse, std::sqrt(2.0 * 0.0625 / 3.0 / 2.0), 1e-15);
    EXPECT_NEAR(error.relative_rmse, error.rmse / 0.5, 1e-15);
    // Squares of a = 2 * 0.0625 / 3 and 0: their mean a / 2 has the standard error a / 2 / sqrt(1), and the root of it
    // that over twice the root.
    const double a = 2.0 * 0.0625 / 3.0;
    EXPECT_NEAR(error.standard_error, 0.5 * a / (2.0 * error.rmse), 1e-15);
}

TEST(ErrorAt, IsNotAvoidedByNumbersThatAreNone) {
    // A picture with NaN may not pass for a good one, whatever should stand there.
    for (const float level : {0.0F, 0.5F, 1.0F, 7.0F}) {
        Image found = grey(2, 1, level);
        found.rgba[0] = std::numeric_limits<float>::quiet_NaN();
        const double rmse = error_at({0, 1}, found, grey(2, 1, level)).rmse;
        EXPECT_FALSE(rmse <= 1.0) << rmse << " at " << level;
    }
}

}  // namespace
}  // namespace bruma::measure
