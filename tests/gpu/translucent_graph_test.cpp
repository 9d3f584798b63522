// Shelf: closed form. What a change reruns inside translucent meshes, what is never made without them.
#include "graph_test.h"
#include "translucent.h"

namespace bruma::render {
namespace {

class TranslucentGraph : public GraphTest {
  protected:
    TranslucentGraph() {
        scene::Mesh& mesh =
            add_translucent(scene, "ball", builtin_triangles("mesh-sphere"), scene::medium_of(scene::Material::potato));
        mesh.subsurface.edit([](scene::SubsurfaceSettings& settings) {
            settings.maps = 4;
            settings.map_size = 32;
            settings.light_map_size = 64;
            settings.samples = 2;
        });
        scene.lights["key"] = scene::Light{};
        scene.camera = parallel_camera_around(scene, {0.1, 0.2, 1.0});
    }
    Names reruns(int passes = 2) {
        view = view_of({16, 12}, passes);
        return GraphTest::reruns();
    }
    scene::Mesh& ball() { return std::get<scene::Mesh>(scene.nodes.at("ball").content); }
    int passes() const { return renderer->translucent_standing()->passes; }
};

const Names inside{"ball: begin radiosity", "ball: light maps", "ball: radiosity", "march", "opaque", "shadow maps"};
const Names gathered{"ball: begin radiosity", "ball: radiosity", "march", "opaque"};

TEST_F(TranslucentGraph, WhatAChangeReruns) {
    EXPECT_EQ(reruns().size(), 9U);  // upload, light, exit and shadow maps, map reads,
                                     // begin, radiosity, opaque, march
    EXPECT_EQ(reruns(), Names{});
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 1e-4; });
    EXPECT_EQ(reruns(), (Names{"ball: radiosity", "map reads", "march", "opaque"}))
        << "a moved camera combines anew, and looks whether light is missing";
    scene.nodes.at("ball").transform = scene::Transform{.translation = {0.001, 0.0, 0.0}};
    EXPECT_EQ(reruns(), (Names{"ball: radiosity", "map reads", "march", "opaque", "shadow maps"}))
        << "a body that is moved under parallel light keeps what is inside";
    scene.lights.at("key").edit([](scene::Light& light) { light.intensity *= 2.0; });
    EXPECT_EQ(reruns(), gathered) << "a lamp's strength";
    scene.lights.at("key").edit([](scene::Light& light) { light.direction_world.x += 0.1; });
    EXPECT_EQ(reruns(), inside) << "a turned lamp";
    scene.nodes.at("ball").transform = scene::Transform{.rotation_deg = {0.0, 10.0, 0.0}};
    EXPECT_EQ(reruns(), (Names{"ball: begin radiosity", "ball: light maps", "ball: radiosity", "map reads", "march",
                               "opaque", "shadow maps"}))
        << "a turned body";
    ball().surface.edit([](scene::MeshSurface& s) { s.custom_medium.absorption *= 2.0; });
    EXPECT_EQ(reruns(), gathered) << "another medium of the same refraction";
    ball().surface.edit([](scene::MeshSurface& s) { s.shininess *= 2.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque"})) << "the highlight";
    scene.lights.at("key").edit([](scene::Light& light) { light.kind = scene::LightKind::headlight; });
    reruns();
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.y += 1e-3; });
    EXPECT_EQ(reruns(),
              (Names{"ball: begin radiosity", "ball: light maps", "ball: radiosity", "map reads", "march", "opaque"}))
        << "a headlight moves with the camera";
}

TEST_F(TranslucentGraph, PassesAddUpWhileNothingMoves) {
    ball().subsurface.edit([](scene::SubsurfaceSettings& settings) { settings.whole_maps = true; });
    reruns(1);
    EXPECT_EQ(passes(), 1);
    EXPECT_EQ(reruns(3), (Names{"ball: radiosity", "march", "opaque"}));
    EXPECT_EQ(passes(), 3);
    EXPECT_EQ(reruns(3), Names{});
    EXPECT_EQ(reruns(1), Names{}) << "what is there is kept";
    EXPECT_EQ(passes(), 3);
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 1e-4; });
    EXPECT_EQ(reruns(1), (Names{"march", "opaque"}));
    EXPECT_EQ(passes(), 3) << "the camera takes nothing away";
    const Image in_turns = renderer->read_picture();
    Renderer at_once(*own_shaders);
    at_once.render(scene, view_of({16, 12}, 3));
    EXPECT_TRUE(same_bits(in_turns, at_once.read_picture()));
    scene.lights.at("key").edit([](scene::Light& light) { light.direction_world.x += 0.1; });
    reruns(1);
    EXPECT_EQ(passes(), 1);
}

TEST_F(TranslucentGraph, StopsAtTheNoiseThatIsAskedFor) {
    ball().subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.noise = 0.1;
        settings.samples = 8;
    });
    reruns(1000);
    EXPECT_TRUE(renderer->translucent_standing()->settled);
    EXPECT_LT(passes(), 1000);
    const int rough = passes();
    ball().subsurface.edit([](scene::SubsurfaceSettings& settings) { settings.noise = 0.05; });
    EXPECT_EQ(reruns(1000), (Names{"ball: radiosity", "march", "opaque"})) << "goes on from there";
    EXPECT_GT(passes(), 2 * rough) << "half the noise takes four times the passes, or a little less in good order";
}

TEST_F(TranslucentGraph, NothingIsMadeWithoutTranslucentMeshes) {
    ball().surface.edit([](scene::MeshSurface& s) { s.shading = scene::MeshShading::lambert; });
    EXPECT_EQ(reruns(), (Names{"ball: upload", "march", "opaque", "shadow maps"}));
    EXPECT_FALSE(renderer->translucent_standing());
    EXPECT_FALSE(compiled("TRANSLUCENT") || compiled("radiosity"));
    ball().surface.edit([](scene::MeshSurface& s) { s.shading = scene::MeshShading::translucent; });
    reruns();
    EXPECT_TRUE(renderer->translucent_standing());
    ball().surface.edit([](scene::MeshSurface& s) { s.shading = scene::MeshShading::lambert; });
    reruns();
    EXPECT_FALSE(renderer->translucent_standing());
}

}  // namespace
}  // namespace bruma::render
