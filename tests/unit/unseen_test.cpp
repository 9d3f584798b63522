// Shelf: closed form. What is said of a picture that shows nothing: one sentence, with the likeliest cause.
#include "scene/unseen.h"

#include <gtest/gtest.h>

#include "io/open.h"
#include "io_temporary_folder.h"

namespace bruma::scene {
namespace {

constexpr glm::ivec2 pixels(160, 90);

Scene framed(std::vector<std::string> files) {
    Scene scene = io::open_files(files, {}, {});
    scene.camera.emplace(fit_camera(world_bounds(scene), 16.0 / 9.0));
    return scene;
}

std::string sentence_with(Scene scene, const std::function<void(Camera&)>& change) {
    scene.camera->edit(change);
    return why_nothing_is_seen(scene, pixels);
}

TEST(Unseen, IsSilentWhereNothingIsMissed) {
    Scene empty;
    empty.camera.emplace(Camera{});
    EXPECT_EQ(why_nothing_is_seen(empty, pixels), "");
    empty.nodes["group"] = Node{};
    EXPECT_EQ(why_nothing_is_seen(empty, pixels), "");
}

TEST(Unseen, TellsHiddenNodesFromThoseOutOfView) {
    Scene scene = framed({"builtin:mesh-sphere"});
    const auto turned = sentence_with(
        scene, [](Camera& camera) { camera.target_world = 2.0 * camera.eye_world - camera.target_world; });
    EXPECT_TRUE(io::contains(turned, "'mesh-sphere' lies behind the camera")) << turned;
    const auto aside = sentence_with(scene, [](Camera& camera) {
        camera.target_world = camera.eye_world + glm::cross(camera.target_world - camera.eye_world, camera.up_world);
    });
    EXPECT_TRUE(io::contains(aside, "'mesh-sphere' lies beside the view")) << aside;
    const auto far = sentence_with(scene, [](Camera& camera) { camera.eye_world *= 1e4; });
    EXPECT_TRUE(io::contains(far, "pixels wide")) << far;
    const auto flat = sentence_with(scene, [](Camera& camera) {
        camera.projection = Projection::orthographic;
        camera.view_height = 1e3;
    });
    EXPECT_TRUE(io::contains(flat, "pixels wide")) << flat;

    scene.nodes.at("mesh-sphere").parent = "above";
    scene.nodes["above"].visible = false;
    const auto hidden = why_nothing_is_seen(scene, pixels);
    EXPECT_TRUE(io::contains(hidden, "'mesh-sphere' is hidden; set nodes.above.visible=true")) << hidden;
}

TEST(Unseen, NamesAVolumeThatLetsAllLightThrough) {
    const auto sentence = why_nothing_is_seen(framed({"builtin:sphere"}), pixels);
    EXPECT_TRUE(io::contains(sentence, "the volume 'sphere' lies in the view and lets all light through")) << sentence;
    EXPECT_FALSE(io::contains(sentence, "\n"));
}

}  // namespace
}  // namespace bruma::scene
