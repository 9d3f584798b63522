// Shelf: closed form. What the reference makes of samples that are absent.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/medium/delta_tracking.h"
#include "reference/volume/transmittance.h"
#include "reference_scenes.h"

namespace bruma::reference {
namespace {

/// A metre of matter along x of which the samples 4 to 6 of 16 are absent: cells 3 to 6 hold nothing.
scene::Scene gapped() {
    const auto grid = grid_of({16, 4, 4}, {1.0 / 16, 0.25, 0.25}, [](glm::ivec3 at) {
        return at.x >= 4 && at.x <= 6 ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    });
    return scene_with(grid, uniform_extinction(2.0));
}

TEST(ReferenceAbsentSamples, CellsBesideThemAreTransparent) {
    const scene::Scene scene = gapped();
    const std::vector<PreparedVolume> volumes = prepare_volumes(scene);
    const scene::Ray ray = ray_from({-2.0, 0.1, 0.05}, {2.0, 0.1, 0.05});
    const double expected = std::exp(-2.0 * (1.0 - 4.0 / 16));
    for (const bool leap : {false, true}) {
        EXPECT_NEAR(transmittance(volumes, ray, 1e9, 1e-9, 1e-12, leap).value, expected, 1e-9);
    }
    RandomStream random(1, 2, 3);
    double sum = 0.0;
    constexpr int tries = 20000;
    for (int n = 0; n < tries; ++n) {
        sum += tracked_transmittance(volumes, ray, 1e9, random);
    }
    EXPECT_NEAR(sum / tries, expected, 0.02);  // four standard errors of a coin
}

TEST(ReferenceAbsentSamples, GradientsBesideThemAreOneSided) {
    const auto grid = grid_of({8, 3, 3}, glm::dvec3(1.0), [](glm::ivec3 at) {
        return at.x == 4 ? std::numeric_limits<double>::quiet_NaN() : 3.0 * at.x - at.y;
    });
    const TrilinearField field(grid);
    EXPECT_TRUE(field.is_hole({3, 0, 0}));
    EXPECT_TRUE(field.is_hole({4, -1, 2}));
    EXPECT_FALSE(field.is_hole({2, 0, 0}));
    for (const glm::dvec3 gradient : field.corner_gradients({2, 0, 0})) {
        EXPECT_EQ(gradient, glm::dvec3(3.0, -1.0, 0.0));
    }
}

}  // namespace
}  // namespace bruma::reference
