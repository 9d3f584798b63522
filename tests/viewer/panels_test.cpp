// Closed form: scales and their inverses, undo as the exact opposite of an edit.
#include <gtest/gtest.h>

#include "app/panels/fields_panel.h"
#include "app/panels/volume/opacity_scale.h"
#include "app/viewer/edit_history.h"
#include "io/picture/picture_file.h"

namespace bruma::app {
namespace {

SharedHome at_home(const std::string& path) {
    SharedHome home = std::make_shared<SceneHome>();
    home->path = path;
    return home;
}

TEST(OpacityScale, HeightAndOpacityAreInverses) {
    for (const OpacityScale scale : {OpacityScale::linear, OpacityScale::square_root, OpacityScale::logarithmic}) {
        EXPECT_EQ(height_of_opacity(scale, 0.0), 0.0);
        EXPECT_NEAR(height_of_opacity(scale, 1.0), 1.0, 1e-15);
        for (int n = 0; n <= 1000; ++n) {
            const double opacity = n / 1000.0;
            EXPECT_NEAR(opacity_of_height(scale, height_of_opacity(scale, opacity)), opacity, 1e-13);
        }
    }
}

TEST(OpacityScale, StretchedOnesMakeRoomNearZero) {
    // The editor is about 160 units high: 0.001 must stand well apart from 0.
    EXPECT_GT(160.0 * height_of_opacity(OpacityScale::square_root, 0.001), 4.0);
    EXPECT_GT(160.0 * height_of_opacity(OpacityScale::logarithmic, 0.001), 40.0);
}

TEST(Colors, EncodeAndDecodeAreInverses) {
    for (int n = 0; n <= 255; ++n) {
        const double encoded = n / 255.0;
        // The curve's two branches meet only to four digits at their joint.
        EXPECT_NEAR(srgb_of_linear(io::linear_of_srgb(encoded)), encoded, 1e-7);
    }
}

TEST(Fields, OnlyThoseOfThePresentChoiceAreShown) {
    const auto words = scene::enum_words<scene::LightKind>();
    const auto point = std::size_t(scene::LightKind::point);
    EXPECT_TRUE(is_for_another_word("directional: from the scene towards the light", words, point));
    EXPECT_FALSE(is_for_another_word("point: where it stands", words, point));
    EXPECT_FALSE(is_for_another_word("whether it shines", words, point));
    EXPECT_FALSE(is_for_another_word("points are counted", words, std::size_t(scene::LightKind::headlight)));
    EXPECT_FALSE(is_for_another_word("point, spot: where it stands", words, point));
    EXPECT_TRUE(is_for_another_word("directional, spot: from where", words, point));
    EXPECT_FALSE(is_for_another_word("none of these, point: it stands", words, std::size_t(scene::LightKind::spot)));
}

TEST(History, UndoesAndRedoesAGestureAsOneStep) {
    scene::Scene scene;
    scene.nodes.emplace("a", scene::Node{});
    EditHistory history;
    SharedHome home = std::make_shared<SceneHome>();
    history.restart(scene, home);
    const auto move_to = [&](double x, bool in_gesture) {
        scene.nodes.at("a").transform.edit([&](scene::Transform& t) { t.translation.x = x; });
        history.observe(scene, home, in_gesture);
    };
    move_to(1.0, true);
    move_to(2.0, true);
    move_to(3.0, false);
    move_to(4.0, false);
    history.undo(scene, home);
    EXPECT_EQ(scene.nodes.at("a").transform->translation.x, 3.0);
    history.undo(scene, home);
    EXPECT_EQ(scene.nodes.at("a").transform->translation.x, 0.0);
    EXPECT_FALSE(history.can_undo());
    history.redo(scene, home);
    history.redo(scene, home);
    EXPECT_EQ(scene.nodes.at("a").transform->translation.x, 4.0);
    EXPECT_FALSE(history.can_redo());
}

TEST(History, LeavesTheCameraAlone) {
    scene::Scene scene;
    scene.camera.emplace(scene::Camera{});
    EditHistory history;
    SharedHome home = std::make_shared<SceneHome>();
    history.restart(scene, home);
    scene.background.edit([](scene::Background& background) { background.top = glm::dvec3(0.5); });
    history.observe(scene, home, false);
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x = 5.0; });
    history.observe(scene, home, false);
    history.undo(scene, home);
    EXPECT_EQ(scene.background->top, glm::dvec3(0.0));
    EXPECT_EQ((*scene.camera)->eye_world.x, 5.0);
}

TEST(History, RemovingANodeIsUndone) {
    scene::Scene scene;
    scene.nodes.emplace("a", scene::Node{});
    EditHistory history;
    SharedHome home = std::make_shared<SceneHome>();
    history.restart(scene, home);
    scene.nodes.clear();
    history.observe(scene, home, false);
    history.undo(scene, home);
    EXPECT_TRUE(scene.nodes.contains("a"));
}

TEST(History, BringsTheFileBackWithTheScene) {
    scene::Scene scene;
    scene.camera.emplace(scene::Camera{});
    scene.nodes.emplace("a", scene::Node{});
    SharedHome home = at_home("a.json");
    EditHistory history;
    history.restart(scene, home);
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x = 2.0; });
    history.observe(scene, home, false);
    // Another file is opened, seen from elsewhere.
    scene.nodes.clear();
    scene.nodes.emplace("b", scene::Node{});
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x = 7.0; });
    home = at_home("b.json");
    history.observe(scene, home, false);
    history.undo(scene, home);
    EXPECT_TRUE(scene.nodes.contains("a"));
    EXPECT_EQ(home->path, "a.json");
    EXPECT_EQ((*scene.camera)->eye_world.x, 2.0);
    history.redo(scene, home);
    EXPECT_TRUE(scene.nodes.contains("b"));
    EXPECT_EQ(home->path, "b.json");
    EXPECT_EQ((*scene.camera)->eye_world.x, 7.0);
}

TEST(History, ANewNameHoldsForAllStepsOfAScene) {
    scene::Scene scene;
    SharedHome home = at_home("a.json");
    EditHistory history;
    history.restart(scene, home);
    scene.background.edit([](scene::Background& background) { background.top = glm::dvec3(0.5); });
    history.observe(scene, home, false);
    home->path = "other.json";
    history.undo(scene, home);
    EXPECT_EQ(home->path, "other.json");
}

TEST(History, ASceneWhoseFileHoldsAnotherOneIsNotKept) {
    scene::Scene scene;
    SharedHome first = at_home("a.json");
    first->kept = document_stamp(scene);
    EditHistory history;
    history.restart(scene, first);
    scene.nodes.emplace("b", scene::Node{});
    SharedHome second = at_home("./a.json");
    history.observe(scene, second, false);
    second->kept = document_stamp(scene);
    history.was_saved(*second);
    EXPECT_TRUE(first->kept.empty());
    EXPECT_FALSE(second->kept.empty());
}

}  // namespace
}  // namespace bruma::app
