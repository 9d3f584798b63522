// Closed form: costs are made up here, so the right view is known.
#include "app/viewer/quality.h"

#include <gtest/gtest.h>

namespace bruma::app {
namespace {

double pixels_of(const render::View& view) {
    return double(view.pixels.x) * view.pixels.y;
}

TEST(Quality, StartsCoarseWithoutAMeasurement) {
    const render::View view = QualityController().moving({800, 600});
    EXPECT_EQ(view.pixels, glm::ivec2(200, 150));
    EXPECT_EQ(view.step_scale, 4.0);
}

TEST(Quality, AFastMachineMovesAtFullQuality) {
    QualityController quality;
    quality.measured({{200, 150}, 4.0}, 0.1, 0.2);
    EXPECT_EQ(quality.moving({800, 600}), QualityController::refined({800, 600}));
}

TEST(Quality, ASlowMachineStaysWithinTheTimeOfAFrame) {
    for (const double ms_at_full : {100.0, 300.0, 1000.0, 3000.0}) {
        QualityController quality;
        quality.measured({{800, 600}, 1.0}, ms_at_full, 0.0);
        const render::View view = quality.moving({800, 600});
        const double ms = ms_at_full * pixels_of(view) / (800.0 * 600.0) / view.step_scale;
        EXPECT_LE(ms, QualityController::target_ms * (1.0 + 1e-9)) << ms_at_full;
        EXPECT_DOUBLE_EQ(quality.refined_ms({800, 600}), ms_at_full);
    }
}

TEST(Quality, StepsGrowOnlyWhenPixelsAreAtTheirFewest) {
    QualityController quality;
    quality.measured({{800, 600}, 1.0}, 600.0, 0.0);
    EXPECT_EQ(quality.moving({800, 600}).step_scale, 1.0);
    quality.measured({{800, 600}, 1.0}, 100000.0, 0.0);
    EXPECT_EQ(quality.moving({800, 600}).pixels, glm::ivec2(200, 150));
    EXPECT_EQ(quality.moving({800, 600}).step_scale, 4.0);
}

TEST(Quality, CloudsFromTheLastPictureAreCounted) {
    QualityController quality;
    quality.measured({{800, 600}, 1.0}, 300.0, 0.0);
    EXPECT_EQ(quality.moving({800, 600}, true), QualityController::refined({800, 600}));  // a fifth is thought
    quality.measured({{800, 600}, 1.0}, 200.0, 0.0, true);
    EXPECT_LT(pixels_of(quality.moving({800, 600}, true)), 800.0 * 600.0);
    EXPECT_DOUBLE_EQ(quality.refined_ms({800, 600}), 300.0);  // and whole ones cost what they did
}

TEST(Quality, OtherPassesTakeTheirShare) {
    QualityController quality;
    quality.measured({{800, 600}, 1.0}, 200.0, 0.0);
    const double alone = pixels_of(quality.moving({800, 600}));
    quality.measured({{800, 600}, 1.0}, 200.0, 40.0);
    EXPECT_LT(pixels_of(quality.moving({800, 600})), alone);
}

}  // namespace
}  // namespace bruma::app
