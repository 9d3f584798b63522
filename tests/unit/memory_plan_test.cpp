// Shelf: closed form. How volumes are made to fit, of budgets that are counted by hand.
#include "render/volume/memory_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "reference_scenes.h"
#include "scene/volume/thinned_grid.h"

namespace bruma::render {
namespace {

constexpr std::uint64_t mebibyte = 1 << 20;

/// 512 MiB of samples, 4 times as much in gradients.
VolumeNeeds large_scan() {
    return {"scan", {1024, 512, 512}, GL_R16, GL_RGBA16_SNORM, 0};
}

TEST(MemoryPlan, WhatFitsIsKeptAsItIs) {
    const MemoryPlan plan = plan_memory({large_scan()}, {.bytes = 2560 * mebibyte});
    EXPECT_TRUE(plan.gradients_stored);
    EXPECT_EQ(plan.thinning[0], glm::ivec3(1));
    EXPECT_EQ(plan.bytes, 2560 * mebibyte);
    EXPECT_TRUE(plan.remarks.empty());
    EXPECT_TRUE(plan_memory({large_scan()}, {}).gradients_stored) << "where nothing tells what is free";
    EXPECT_TRUE(plan_memory({}, {.bytes = 0}).remarks.empty());
}

TEST(MemoryPlan, GradientsGoFirst) {
    const MemoryPlan plan = plan_memory({large_scan()}, {.bytes = 2559 * mebibyte});
    EXPECT_FALSE(plan.gradients_stored);
    EXPECT_EQ(plan.thinning[0], glm::ivec3(1));
    EXPECT_EQ(plan.bytes, 512 * mebibyte);
    ASSERT_EQ(plan.remarks.size(), 1U);
    EXPECT_NE(plan.remarks[0].find("2048 MiB, of which 2047 MiB are free"), std::string::npos) << plan.remarks[0];
}

TEST(MemoryPlan, ADriverMayTakeLessThanThereIsRoomFor) {
    const auto takes = [](GLenum format, glm::ivec3 size) { return texture_bytes(format, size) < 1024 * mebibyte; };
    const MemoryPlan plan = plan_memory({large_scan()}, {.takes = takes});
    EXPECT_FALSE(plan.gradients_stored);
    EXPECT_EQ(plan.thinning[0], glm::ivec3(1));
    ASSERT_EQ(plan.remarks.size(), 1U);
    EXPECT_NE(plan.remarks[0].find("this driver does not take"), std::string::npos) << plan.remarks[0];
}

TEST(MemoryPlan, SamplesAreThinnedOutUntilTheyFit) {
    const MemoryPlan plan = plan_memory({large_scan()}, {.bytes = 100 * mebibyte});
    EXPECT_EQ(plan.thinning[0], glm::ivec3(2));
    EXPECT_EQ(plan.bytes, 64 * mebibyte);
    EXPECT_FALSE(plan.gradients_stored);
    EXPECT_EQ(plan.remarks.size(), 2U);
    // Of two the larger one is.
    const VolumeNeeds small{"small", {128, 128, 64}, GL_R8, 0, 0};
    const MemoryPlan two = plan_memory({small, large_scan()}, {.bytes = 100 * mebibyte});
    EXPECT_EQ(two.thinning[0], glm::ivec3(1));
    EXPECT_EQ(two.thinning[1], glm::ivec3(2));
    // Even nothing at all ends.
    EXPECT_EQ(plan_memory({large_scan()}, {.bytes = 0}).thinning[0], glm::ivec3(1024));
}

TEST(MemoryPlan, LongEdgesAreThinnedOutAlongThemselves) {
    const VolumeNeeds line{"core", {5000, 64, 2049}, GL_R8, GL_RGB10_A2, 0};
    const MemoryPlan plan = plan_memory({line}, {.longest_edge = 2048});
    EXPECT_EQ(plan.thinning[0], glm::ivec3(3, 1, 2));
    EXPECT_TRUE(plan.gradients_stored);
    ASSERT_EQ(plan.remarks.size(), 1U);
    EXPECT_NE(plan.remarks[0].find("1667 x 64 x 1025"), std::string::npos) << plan.remarks[0];
}

TEST(MemoryPlan, LightThatWasAskedForIsRefusedWithAnEstimate) {
    VolumeNeeds lit = large_scan();
    lit.gradient_format = 0;
    lit.light_bytes = 900 * mebibyte;
    EXPECT_EQ(plan_memory({lit}, {.bytes = 1412 * mebibyte}).bytes, 1412 * mebibyte);
    try {
        plan_memory({lit}, {.bytes = 1411 * mebibyte});
        FAIL();
    } catch (const MachineError& error) {
        const std::string sentence = error.what();
        EXPECT_NE(sentence.find("need about 900 MiB"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find("resolution=quarter"), std::string::npos) << sentence;
    }
}

TEST(ThinnedGrid, HoldsMeansOfWhatIsPresentInTheSameBox) {
    const auto grid = reference::grid_of({7, 4, 2}, {1e-3, 2e-3, 3e-3}, [](glm::ivec3 at) {
        return at.x == 0 || at == glm::ivec3(2, 0, 0) ? std::numeric_limits<double>::quiet_NaN()
                                                      : at.x + 10.0 * at.y + 100.0 * at.z;
    });
    const auto thin = scene::thinned(*grid, {2, 2, 1});
    EXPECT_EQ(thin->size, glm::ivec3(4, 2, 2));
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_DOUBLE_EQ(thin->extent()[axis], grid->extent()[axis]);
    }
    EXPECT_TRUE(thin->is_absent(0)) << "of x = 0 alone";
    EXPECT_FLOAT_EQ(float(thin->value(1, 0, 0)), float((1.0 + 11.0 + 12.0) / 3.0)) << "without the one that is absent";
    EXPECT_EQ(thin->value(3, 1, 1), 5.5 + 25.0 + 100.0);
    EXPECT_EQ(thin->suggested_window, grid->suggested_window);
}

}  // namespace
}  // namespace bruma::render
