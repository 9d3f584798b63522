// Shelf: closed form. Measures of pictures whose difference is known beforehand.
#include "measure/metrics/image_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "measure/metrics/flip.h"
#include "measure/metrics/flip_color.h"
#include "measure/metrics/heatmap.h"

namespace bruma::measure {
namespace {

Image flat(int width, int height, float r, float g, float b) {
    Image image(width, height);
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        image.rgba[4 * n] = r;
        image.rgba[4 * n + 1] = g;
        image.rgba[4 * n + 2] = b;
        image.rgba[4 * n + 3] = 1.0F;
    }
    return image;
}

/// Smooth bumps and a sharp edge.
Image picture(int width = 48, int height = 32) {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            float* pixel = image.pixel(x, y);
            pixel[0] = float(0.5 + 0.3 * std::sin(0.3 * x));
            pixel[1] = x > 20 ? 0.7F : 0.2F;
            pixel[2] = float(0.4 + 0.3 * std::cos(0.2 * y));
            pixel[3] = 1.0F;
        }
    }
    return image;
}

Image with_noise(Image image, double amplitude) {
    unsigned state = 12345;
    for (float& value : image.rgba) {
        state = state * 1664525U + 1013904223U;
        value = float(std::clamp(double(value) + amplitude * (double(state >> 8) / 0x1p24 - 0.5), 0.0, 1.0));
    }
    return image;
}

TEST(ImageError, EqualPicturesHaveNone) {
    const ImageError error = compare_images(picture(), picture());
    EXPECT_EQ(error.rmse, 0.0);
    EXPECT_EQ(error.relative_mse, 0.0);
    EXPECT_EQ(error.largest, 0.0);
    EXPECT_EQ(error.mean_flip, 0.0);
    EXPECT_EQ(error.non_finite, 0U);
    EXPECT_EQ(error.psnr_db, std::numeric_limits<double>::infinity());
}

TEST(ImageError, KnownOffsets) {
    Image a = flat(8, 4, 0.25F, 0.5F, 0.5F);
    const Image b = flat(8, 4, 0.5F, 0.5F, 0.5F);
    ImageError error = compare_images(a, b);
    EXPECT_DOUBLE_EQ(error.rmse, 0.25 / std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(error.relative_mse, 0.0625 / 0.26 / 3.0);
    EXPECT_DOUBLE_EQ(error.psnr_db, 10.0 * std::log10(3.0 * 16.0));
    EXPECT_DOUBLE_EQ(error.largest, 0.25);
    a.pixel(5, 2)[1] = 1.5F;
    error = compare_images(a, b);
    EXPECT_DOUBLE_EQ(error.largest, 1.0);
    EXPECT_EQ(error.worst_pixel, glm::ivec2(5, 2));
}

TEST(ImageError, AlphaDoesNotCount) {
    Image a = picture();
    a.pixel(3, 3)[3] = 0.0F;
    EXPECT_EQ(compare_images(a, picture()).rmse, 0.0);
}

TEST(ImageError, WhatIsNotFiniteFails) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image a = picture();
        a.pixel(7, 9)[2] = bad;
        a.pixel(8, 9)[0] = bad;
        for (const bool in_reference : {false, true}) {
            const ImageError error = in_reference ? compare_images(picture(), a) : compare_images(a, picture());
            EXPECT_EQ(error.non_finite, 2U);
            EXPECT_FALSE(error.rmse <= 1e30);
            EXPECT_FALSE(error.relative_mse <= 1e30);
            EXPECT_FALSE(error.largest <= 1e30);
            EXPECT_FALSE(error.psnr_db >= 0.0);
            EXPECT_EQ(error.mean_flip, 1.0);
            EXPECT_EQ(error.worst_pixel, glm::ivec2(7, 9));
        }
        // Both broken alike: infinity minus infinity is still no agreement.
        EXPECT_EQ(compare_images(a, a).non_finite, 2U);
        EXPECT_EQ(flip_map(a, picture())[9 * 48 + 7], 1.0F);
        EXPECT_EQ(error_heatmap(a, picture(), 1.0).pixel(7, 9)[1], 1.0F);
        EXPECT_NE(character_picture(a, picture(), 48).find('!'), std::string::npos);
    }
}

TEST(ImageError, DifferentSizesAreRefusedWithBothSizes) {
    try {
        compare_images(picture(48, 32), picture(32, 48));
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("48 x 32"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("32 x 48"), std::string::npos);
    }
    EXPECT_THROW(compare_images(Image(), Image()), InputError);
}

TEST(Flip, BlackAgainstWhite) {
    // Without features the map is the colour difference alone: HyAB 100, of at most that of green against blue.
    const double largest = std::pow(hyab(hunt_lab_of_rgb({0.0, 1.0, 0.0}), hunt_lab_of_rgb({0.0, 0.0, 1.0})), 0.7);
    const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * largest) / (0.6 * largest);
    EXPECT_NEAR(mean_flip(flat(40, 30, 0, 0, 0), flat(40, 30, 1, 1, 1)), expected, 1e-6);
    EXPECT_NEAR(expected, 0.967, 0.001);
    EXPECT_NEAR(mean_flip(flat(40, 30, 0, 1, 0), flat(40, 30, 0, 0, 1)), 1.0, 1e-6);
}

TEST(Flip, KnownColors) {
    // L*a*b* of the primaries of sRGB under D65, as tabulated everywhere.
    const glm::dvec3 green = lab_of_rgb({0.0, 1.0, 0.0});
    EXPECT_NEAR(green.x, 87.74, 0.02);
    EXPECT_NEAR(green.y, -86.18, 0.05);
    EXPECT_NEAR(green.z, 83.18, 0.05);
    const glm::dvec3 blue = lab_of_rgb({0.0, 0.0, 1.0});
    EXPECT_NEAR(blue.x, 32.30, 0.02);
    EXPECT_NEAR(blue.y, 79.19, 0.05);
    EXPECT_NEAR(blue.z, -107.86, 0.05);
    const glm::dvec3 there_and_back = rgb_of_ycxcz(ycxcz_of_rgb({0.1, 0.6, 0.3}));
    EXPECT_NEAR(there_and_back.x, 0.1, 1e-12);
    EXPECT_NEAR(there_and_back.y, 0.6, 1e-12);
    EXPECT_NEAR(there_and_back.z, 0.3, 1e-12);
}

TEST(Flip, SymmetricBoundedAndGrowingWithNoise) {
    double before = 0.0;
    for (const double amplitude : {0.02, 0.05, 0.1, 0.2, 0.4, 0.8}) {
        const Image noisy = with_noise(picture(), amplitude);
        const auto map = flip_map(noisy, picture());
        for (const float value : map) {
            EXPECT_GE(value, 0.0F);
            EXPECT_LE(value, 1.0F);
        }
        const double mean = mean_flip(noisy, picture());
        EXPECT_GT(mean, before);
        EXPECT_NEAR(mean, mean_flip(picture(), noisy), 1e-12);
        before = mean;
    }
}

TEST(Flip, FineNoiseVanishesFromAfarAndEdgesCount) {
    const Image noisy = with_noise(picture(), 0.3);
    EXPECT_LT(mean_flip(noisy, picture(), 200.0), 0.5 * mean_flip(noisy, picture(), 20.0));
    // The same change of colour is worse where it makes an edge: a white square on black against plain black.
    Image square = flat(64, 64, 0, 0, 0);
    for (int y = 24; y < 40; ++y) {
        for (int x = 24; x < 40; ++x) {
            std::fill_n(square.pixel(x, y), 3, 0.05F);
        }
    }
    const auto map = flip_map(square, flat(64, 64, 0, 0, 0));
    EXPECT_GT(map[32 * 64 + 26], map[32 * 64 + 32]);
    EXPECT_EQ(map[0], 0.0F);
}

TEST(Heatmap, BrightnessRisesEvenly) {
    double before = -1.0;
    for (int n = 0; n <= 100; ++n) {
        const auto color = heat_color(n / 100.0);
        const double lightness = lab_of_rgb({color[0], color[1], color[2]}).x;
        EXPECT_NEAR(lightness, 0.96 * n, 0.1);
        EXPECT_GT(lightness, before);
        EXPECT_LE(*std::max_element(color.begin(), color.end()), 1.0F);
        EXPECT_GE(*std::min_element(color.begin(), color.end()), 0.0F);
        before = lightness;
    }
    EXPECT_EQ(heat_color(7.0), heat_color(1.0));
    EXPECT_EQ(error_heatmap(picture(), picture(), 1.0).pixel(0, 0)[0], 0.0F);
    EXPECT_THROW(error_heatmap(picture(), picture(), 0.0), InputError);
}

TEST(Heatmap, CharactersShowWhereAndHowMuch) {
    Image a = flat(40, 20, 0.5F, 0.5F, 0.5F);
    const Image b = a;
    EXPECT_EQ(character_picture(a, b, 40), "no difference in 40 x 20 pixels\n");
    a.pixel(39, 19)[0] = 0.75F;
    a.pixel(0, 0)[1] = 0.505F;
    const std::string text = character_picture(a, b, 40);
    const std::string first_row = text.substr(text.find('\n') + 1, 40);
    EXPECT_EQ(first_row, "*" + std::string(39, ' ')) << "0.005 of 0.25 lies 1.7 decades below: three steps";
    EXPECT_NE(text.find(" @\n"), std::string::npos);
    EXPECT_NE(text.find("(39, 19): 0.25  (0.75, 0.5, 0.5)  (0.5, 0.5, 0.5)"), std::string::npos);
    EXPECT_LT(text.find("(39, 19)"), text.find("(0, 0): 0.005"));
}

}  // namespace
}  // namespace bruma::measure
