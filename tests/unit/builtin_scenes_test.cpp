#include <gtest/gtest.h>

#include "base/error.h"
#include "scene/builtin/builtin.h"

namespace bruma::scene {
namespace {

double transparent_share(const VolumeGrid& grid, const TransferFunction& tf) {
    const std::array<double, 2> window = tf.window.value_or(grid.core);
    const double width = window[1] - window[0];
    std::size_t transparent = 0;
    visit_voxels(grid, [&](auto samples) {
        for (const auto sample : samples) {
            const double u = width > 0.0 ? (double(sample) - window[0]) / width : 1.0;
            transparent += opacity_at(tf, u) == 0.0 ? 1 : 0;
        }
    });
    return double(transparent) / double(grid.voxel_count());
}

/// The same samples under a name that nobody knows.
VolumeGrid stranger(const VolumeGrid& grid) {
    VolumeGrid copy = grid;
    copy.name = "measured";
    return copy;
}

TEST(SuggestedTransferFunction, ShowsSomethingAndHidesTheAir) {
    for (const std::string& name : builtin_volume_names()) {
        if (name == "cube") {
            continue;  // holds no air
        }
        const auto grid = builtin_volume(name);
        for (const VolumeGrid& shown : {*grid, stranger(*grid)}) {
            const double share = transparent_share(shown, suggested_transfer_function(shown));
            EXPECT_GT(share, 0.2) << shown.name << " " << name;
            EXPECT_LT(share, 0.99) << shown.name << " " << name;
        }
    }
}

TEST(SuggestedTransferFunction, TheUniformCubeIsSeen) {
    const auto cube = builtin_volume("cube");
    EXPECT_EQ(transparent_share(*cube, suggested_transfer_function(*cube)), 0.0);
}

TEST(SuggestedTransferFunction, IsSortedAndFollowsTheSmallestSpacing) {
    VolumeGrid grid = stranger(*builtin_volume("engine"));
    grid.spacing = {4e-3, 2e-3, 3e-3};
    const TransferFunction tf = suggested_transfer_function(grid);
    EXPECT_EQ(tf.reference_length, 2e-3);
    TransferFunction sorted = tf;
    normalise(sorted);
    EXPECT_EQ(tf, sorted);
}

TEST(SuggestedTransferFunction, IsTotal) {
    const std::vector<float> constant(64, 7.0F);
    std::vector<float> two_values(64, 0.0F);
    two_values[5] = 1.0F;
    for (const auto& samples : {constant, two_values}) {
        const auto grid = make_grid("tiny", glm::ivec3(4), glm::dvec3(1e-3), samples);
        const TransferFunction tf = suggested_transfer_function(*grid);
        EXPECT_GT(opacity_at(tf, 1.0), 0.0) << "the largest value is seen";
        for (const OpacityPoint& point : tf.opacity) {
            EXPECT_TRUE(point.position >= 0.0 && point.position <= 1.0 && point.opacity >= 0.0 && point.opacity <= 1.0);
        }
    }
}

TEST(BuiltinScenes, AreReadyToRender) {
    for (const std::string& name : builtin_scene_names()) {
        const Scene scene = builtin_scene(name);
        EXPECT_NO_THROW(check(scene)) << name;
        EXPECT_TRUE(scene.camera.has_value()) << name;
        EXPECT_TRUE(!shown_volumes(scene).empty() || !shown_meshes(scene).empty() || !shown_clouds(scene).empty() ||
                    scene.outdoors)
            << name;
        for (const std::string& clouds : shown_clouds(scene)) {
            EXPECT_NE(*std::get<Clouds>(scene.nodes.at(clouds).content).map, nullptr) << name;
        }
        for (const std::string& volume : shown_volumes(scene)) {
            EXPECT_NE(*std::get<Volume>(scene.nodes.at(volume).content).grid, nullptr) << name;
        }
    }
}

TEST(BuiltinScenes, AnUnknownNameIsAnsweredWithTheNearest) {
    try {
        builtin_scene("dem");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "builtin:dem: there is no such scene; did you mean 'demo'?");
    }
}

}  // namespace
}  // namespace bruma::scene
