// Shelf: closed form. Which passes a change of the scene reruns, and that nothing unneeded is made or compiled.
#include "graph_test.h"
#include "opaque_mesh.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

class GraphPins : public GraphTest {
  protected:
    GraphPins() {
        const auto grid = scene::builtin_volume("bucky");
        scene = scene_with(grid, scene::suggested_transfer_function(*grid));
        scene.camera = oblique_camera(scene);
    }
    void edit_transfer_function() {
        volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) {
            tf.opacity.push_back({0.97, 0.11});
        });
    }
};

TEST_F(GraphPins, FirstPictureAndTheSameAgain) {
    EXPECT_EQ(reruns(),
              (Names{"march", "volume: cell ranges", "volume: occupancy", "volume: tables", "volume: upload"}));
    EXPECT_EQ(reruns(), Names{});
    EXPECT_EQ(reason("march"), "nothing it reads is newer");
    const scene::Scene copy = scene;
    scene = copy;
    EXPECT_EQ(reruns(), Names{}) << "a copy is as old as the original";
}

TEST_F(GraphPins, TheCameraRerunsTheMarchOnly) {
    reruns();
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 0.01; });
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_EQ(reason("march"), "camera is newer");
}

TEST_F(GraphPins, TheBackgroundRerunsTheMarchOnly) {
    reruns();
    scene.background.edit([](scene::Background& background) { background.top.y += 0.1; });
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_EQ(reason("march"), "background is newer");
}

TEST_F(GraphPins, TheTransferFunctionRerunsTablesOccupancyAndMarch) {
    reruns();
    edit_transfer_function();
    EXPECT_EQ(reruns(), (Names{"march", "volume: occupancy", "volume: tables"}));
    EXPECT_EQ(reason("volume: tables"), "volume: transfer function is newer");
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.empty_space_skipping = false; });
    reruns();
    edit_transfer_function();
    EXPECT_EQ(reruns(), (Names{"march", "volume: tables"})) << "occupancy is not needed without leaping";
    EXPECT_EQ(reason("volume: occupancy"), "nothing needs it");
}

TEST_F(GraphPins, TheSizeOfThePictureAndTheClipBoxRerunTheMarchOnly) {
    reruns();
    view.pixels = {20, 12};
    EXPECT_EQ(reruns(), (Names{"march"}));
    volume_in(scene).clip.edit([](scene::ClipBox& clip) { clip.high.z = 0.5; });
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_EQ(reason("march"), "its parameters changed");
}

TEST_F(GraphPins, NewDataRerunAllButTheTables) {
    reruns();
    volume_in(scene).grid.set(scene::builtin_volume("sphere"));
    const Names ran = reruns();
    for (const char* const pass : {"march", "volume: cell ranges", "volume: occupancy", "volume: upload"}) {
        EXPECT_NE(std::find(ran.begin(), ran.end(), pass), ran.end()) << pass;
    }
}

TEST_F(GraphPins, WithoutLightingNothingOfItIsMade) {
    scene.lights["key"] = scene::Light{};
    reruns();
    EXPECT_EQ(reason("volume: differentiate"), "nothing needs it");
    EXPECT_FALSE(compiled("LIT"));
    scene.lights.at("key").edit([](scene::Light& light) { light.intensity = 2.0; });
    EXPECT_EQ(reruns(), Names{}) << "a light that lights nothing";

    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    EXPECT_EQ(reruns(), (Names{"march", "volume: differentiate", "volume: tables"}));
    scene.lights.at("key").edit([](scene::Light& light) { light.intensity = 3.0; });
    EXPECT_EQ(reruns(), (Names{"march"}));
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::none; });
    reruns();
    EXPECT_EQ(reason("volume: differentiate"), "nothing needs it") << "and its memory is given back";
}

TEST_F(GraphPins, AnEmptySceneCompilesNoMarch) {
    scene.nodes.clear();
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_FALSE(compiled("volume_march"));
}

TEST_F(GraphPins, OtherVolumesAreLeftAlone) {
    scene::Node node;
    node.content = volume_in(scene);
    node.transform = scene::Transform{.translation = {0.5, 0.0, 0.0}};
    scene.nodes["second"] = node;
    reruns();
    edit_transfer_function();
    EXPECT_EQ(reruns(), (Names{"march", "volume: occupancy", "volume: tables"}));
    scene.nodes.at("second").transform.edit([](scene::Transform& t) { t.translation.x = 0.6; });
    EXPECT_EQ(reruns(), (Names{"march"}));
    scene.nodes.at("second").visible = false;
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_EQ(reason("second: upload"), "not in the report") << "hidden ones leave the graph";
    scene.nodes.at("second").visible = true;
    const Names back = reruns();
    EXPECT_EQ(std::count_if(back.begin(), back.end(), [](const std::string& n) { return n.starts_with("volume:"); }),
              0);
}

TEST_F(GraphPins, AMeshAddsOnePassThatTheCameraReruns) {
    reruns();
    EXPECT_FALSE(compiled("mesh") || compiled("OPAQUE"));
    EXPECT_EQ(reason("opaque"), "not in the report") << "without meshes there is no such pass";
    add_mesh(scene, "quad", quad_mesh(0.01F), glm::dvec3(0.5));
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "quad: upload"}));
    EXPECT_EQ(reason("quad: upload textures"), "nothing needs it");
    EXPECT_EQ(reruns(), Names{});
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 0.01; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque"}));
    auto& mesh = std::get<scene::Mesh>(scene.nodes.at("quad").content);
    mesh.surface.edit([](scene::MeshSurface& surface) { surface.diffuse_color.x = 0.1; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque"}));
    mesh.surface.edit([](scene::MeshSurface& surface) { surface.material = scene::Material::ketchup; });
    EXPECT_EQ(reruns(), Names{}) << "what is inside does not show";
    scene.nodes.at("quad").transform.edit([](scene::Transform& t) { t.translation.x = 0.003; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque"}));
    scene.lights["key"] = scene::Light{};
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "shadow maps"}));
    edit_transfer_function();
    EXPECT_EQ(reruns(), (Names{"march", "volume: occupancy", "volume: tables"})) << "meshes stand as they stood";
    mesh.triangles.set(quad_mesh(0.02F));
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "quad: upload", "shadow maps"}));
    scene.nodes.at("quad").visible = false;
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_EQ(reason("opaque"), "not in the report");
}

TEST_F(GraphPins, CountingLeavesThePictureAlone) {
    reruns();
    const Image before = renderer->read_picture();
    const SampleTotals totals = renderer->count_samples(scene, view);
    EXPECT_GT(totals.samples, 0U);
    EXPECT_GT(totals.emptiness_queries, 0U);
    EXPECT_TRUE(same_bits(renderer->read_picture(), before));
    EXPECT_EQ(reruns(), Names{});
}

}  // namespace
}  // namespace bruma::render
