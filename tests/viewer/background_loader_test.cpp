// Closed form: a job either leaves its scene, or a sentence, or nothing because it was cancelled.
#include "app/viewer/background_loader.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "base/error.h"

namespace bruma::app {
namespace {

BackgroundLoader::Result finished(BackgroundLoader& loader) {
    while (true) {
        if (auto result = loader.take()) {
            return std::move(*result);
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

TEST(BackgroundLoader, AddsToACopy) {
    BackgroundLoader loader;
    std::atomic<int> woken = 0;
    scene::Scene scene;
    loader.start("test", add_files_job(scene, {"builtin:sphere"}, {}), [&] { ++woken; });
    EXPECT_TRUE(loader.busy());
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_FALSE(loader.busy());
    ASSERT_TRUE(result.scene);
    EXPECT_TRUE(result.scene->nodes.contains("sphere"));
    EXPECT_FALSE(result.replaces);
    EXPECT_TRUE(scene.nodes.empty());
    EXPECT_GE(woken, 1);
}

TEST(BackgroundLoader, TellsFaultsInASentence) {
    BackgroundLoader loader;
    loader.start("test", add_files_job({}, {"builtin:spehre"}, {}), [] {});
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_FALSE(result.scene);
    EXPECT_NE(result.fault.find("sphere"), std::string::npos) << result.fault;
}

TEST(BackgroundLoader, StopsWhenCancelled) {
    BackgroundLoader loader;
    loader.start(
        "test",
        [](const io::Progress& progress) -> BackgroundLoader::Result {
            while (true) {
                progress(0.5, "for ever");
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        },
        [] {});
    while (loader.standing().share < 0.5) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    loader.cancel();
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_TRUE(result.cancelled);
    EXPECT_FALSE(result.scene);
}

TEST(BackgroundLoader, ASceneTakesThePlaceOfAnother) {
    EXPECT_TRUE(is_whole_scene("builtin:demo"));
    EXPECT_TRUE(is_whole_scene("folder/a.json"));
    EXPECT_FALSE(is_whole_scene("builtin:bucky"));
    BackgroundLoader loader;
    scene::Scene scene;
    scene.nodes.emplace("old", scene::Node{});
    loader.start("test", add_files_job(scene, {"builtin:demo"}, {}), [] {});
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_TRUE(result.replaces);
    ASSERT_TRUE(result.scene) << result.fault;
    EXPECT_FALSE(result.scene->nodes.contains("old"));
    EXPECT_TRUE(result.added_nodes.empty());
}

TEST(BackgroundLoader, TellsWhatItAdded) {
    BackgroundLoader loader;
    scene::Scene scene;
    scene.nodes.emplace("old", scene::Node{});
    loader.start("test", add_files_job(scene, {"builtin:sphere"}, {}), [] {});
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_EQ(result.added_nodes, std::vector<std::string>{"sphere"});
    EXPECT_EQ(result.added_lights, std::vector<std::string>{"headlight"});
}

TEST(BackgroundLoader, AWholeSceneComesFirstWhereverItStands) {
    BackgroundLoader loader;
    loader.start("test", add_files_job({}, {"builtin:sphere", "builtin:demo"}, {}), [] {});
    const BackgroundLoader::Result result = finished(loader);
    ASSERT_TRUE(result.scene) << result.fault;
    EXPECT_TRUE(result.replaces);
    EXPECT_EQ(result.added_nodes, std::vector<std::string>{"sphere"});
    EXPECT_GT(result.scene->nodes.size(), 1U);
}

TEST(BackgroundLoader, RefusesTwoWholeScenes) {
    BackgroundLoader loader;
    loader.start("test", add_files_job({}, {"builtin:scattering", "builtin:demo"}, {}), [] {});
    const BackgroundLoader::Result result = finished(loader);
    EXPECT_FALSE(result.scene);
    EXPECT_NE(result.fault.find("builtin:demo: only one whole scene"), std::string::npos) << result.fault;
}

}  // namespace
}  // namespace bruma::app
