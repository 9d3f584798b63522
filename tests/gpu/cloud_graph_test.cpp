// Shelf: closed form. Which passes clouds need, what a change reruns, and that a scene without them knows nothing of
// them.
#include "cloud_scenes.h"
#include "graph_test.h"
#include "opaque_mesh.h"

namespace bruma::render {
namespace {

class CloudGraph : public GraphTest {
  protected:
    CloudGraph() { scene = cloud_scene(scene::CloudType::stratus, CloudView::below); }
};

TEST_F(CloudGraph, WithoutCloudsNothingOfThemIsMade) {
    scene.nodes.at("sky").visible = false;
    EXPECT_EQ(reruns(), (Names{"march"}));
    EXPECT_FALSE(compiled("cloud"));
    EXPECT_FALSE(compiled("CLOUD"));
    scene.nodes.at("sky").visible = true;
    EXPECT_EQ(reruns(), (Names{"cloud_light", "cloud_noise", "march", "sky: cloud_columns", "sky: cloud_march",
                               "sky: cloud_sun", "sky: cloud_weather"}));
    EXPECT_TRUE(compiled("cloud_noise"));
    scene.nodes.at("sky").visible = false;
    EXPECT_EQ(reruns(), (Names{"march"})) << "and taken away again";
    for (const PassReport& report : renderer->graph().last_report()) {
        EXPECT_EQ(report.name.find("cloud"), std::string::npos) << report.name;
    }
}

TEST_F(CloudGraph, EachChangeRerunsWhatDependsOnItAndNoMore) {
    reruns();
    EXPECT_EQ(reruns(), Names{}) << "a still scene draws nothing";
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 10.0; });
    EXPECT_EQ(reruns(), (Names{"march", "sky: cloud_march"}));
    scene.time.edit([](scene::Timeline& timeline) { timeline.now_s += 1.0; });
    EXPECT_EQ(reruns(), (Names{"march", "sky: cloud_march"})) << "the wind moves the whole pattern";
    scene.lights.at("sun").edit([](scene::Light& sun) { sun.intensity *= 0.5; });
    EXPECT_EQ(reruns(), (Names{"cloud_light", "march", "sky: cloud_march"}));
    scene.lights.at("sun").edit([](scene::Light& sun) { sun.direction_world.y += 0.1; });
    EXPECT_EQ(reruns(), (Names{"cloud_light", "march", "sky: cloud_march", "sky: cloud_sun"})) << "no noise";
    clouds_in(scene).optics.edit([](scene::CloudOptics& optics) { optics.forward_g = 0.7; });
    EXPECT_EQ(reruns(), (Names{"march", "sky: cloud_march"}));
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) { layer.coverage = 0.9; });
    EXPECT_EQ(reruns(),
              (Names{"march", "sky: cloud_columns", "sky: cloud_march", "sky: cloud_sun", "sky: cloud_weather"}));
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) { layer.wind_speed_m_s = 50.0; });
    EXPECT_EQ(reruns(), (Names{"march", "sky: cloud_march"}));
}

TEST_F(CloudGraph, ShadowsAreMadeWhereThereAreSurfacesAndClouds) {
    const scene::Transform level{.translation = {0.0, -1.0, 0.0}, .rotation_deg = {-90.0, 0.0, 0.0}};
    add_mesh(scene, "quad", quad_mesh(100.0F), glm::dvec3(0.5), level);
    scene.nodes.at("sky").visible = false;
    reruns();
    EXPECT_FALSE(compiled("CLOUD_SHADOWS"));
    scene.nodes.at("sky").visible = true;
    reruns();
    EXPECT_TRUE(compiled("CLOUD_SHADOWS"));
    EXPECT_EQ(reruns(), Names{});
    scene.time.edit([](scene::Timeline& timeline) { timeline.now_s += 1.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky: cloud_march"})) << "the wind moves the shadows too";
    clouds_in(scene).march.edit([](scene::CloudMarch& march) { march.step_m *= 2.0; });
    EXPECT_EQ(reruns(), (Names{"march", "sky: cloud_march"})) << "how clouds are drawn darkens nothing";
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) { layer.wind_speed_m_s = 0.0; });
    reruns();
    scene.time.edit([](scene::Timeline& timeline) { timeline.now_s += 1.0; });
    EXPECT_EQ(reruns(), Names{}) << "nothing moves without wind";
}

TEST_F(CloudGraph, UnderASkyTheAirIsLookedUpAndNotMadeAgain) {
    reruns();
    EXPECT_FALSE(compiled("AIR")) << "indoors there is none";
    scene.outdoors.emplace();
    reruns();
    EXPECT_TRUE(compiled("AIR"));
    EXPECT_EQ(reruns(), Names{});
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 10.0; });
    EXPECT_EQ(reruns(), (Names{"cloud_shafts", "march", "sky", "sky: cloud_march"}));
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.irradiance *= 2.0; });
    EXPECT_EQ(reruns(), (Names{"cloud_shafts", "march", "sky", "sky: cloud_march", "sky_light"}));
    scene.outdoors->atmosphere.edit([](scene::Atmosphere& air) { air.mie_scattering_per_m *= 2.0; });
    const Names names = reruns();
    EXPECT_EQ(std::count(names.begin(), names.end(), "sky: cloud_march"), 1);
    EXPECT_EQ(std::count(names.begin(), names.end(), "sky: cloud_sun"), 0) << "air is no cloud";
}

TEST_F(CloudGraph, ShaftsAreMadeForCloudsUnderASkyAlone) {
    reruns();
    scene.outdoors.emplace();
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.shafts = false; });
    reruns();
    scene.nodes.at("sky").visible = false;
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.shafts = true; });
    reruns();
    EXPECT_FALSE(compiled("SHAFTS")) << "indoors, switched off, without clouds";
    EXPECT_FALSE(compiled("shafts"));
    scene.nodes.at("sky").visible = true;
    const Names names = reruns();
    EXPECT_EQ(std::count(names.begin(), names.end(), "cloud_shafts"), 1);
    EXPECT_TRUE(compiled("SHAFTS"));
    EXPECT_EQ(reruns(), Names{});
    scene.nodes.at("sky").visible = false;
    reruns();
    EXPECT_EQ(reason("cloud_shafts"), "not in the report") << "and taken away again";
}

}  // namespace
}  // namespace bruma::render
