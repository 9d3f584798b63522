// Shelf: closed form. Which passes clouds need, what a change reruns, and that a scene without them knows nothing of
// them.
#include <algorithm>

#include "base/installation.h"
#include "cloud_scenes.h"
#include "drawing.h"
#include "scene/builtin.h"

namespace bruma::render {
namespace {

using Names = std::vector<std::string>;

class CloudGraph : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (!IsSkipped()) {
            own_shaders = std::make_unique<gl::ShaderLibrary>(installed_folder("shaders"));
            renderer = std::make_unique<Renderer>(*own_shaders);
            scene = cloud_scene(scene::CloudType::stratus, CloudView::below);
        }
    }
    void TearDown() override {
        renderer.reset();
        own_shaders.reset();
        Drawing::TearDown();
    }
    Names reruns() {
        Names names;
        for (const PassReport& report : renderer->render(scene, {{16, 9}, 1.0})) {
            if (report.ran) {
                names.push_back(report.name);
            }
        }
        std::sort(names.begin(), names.end());
        return names;
    }
    bool compiled(const std::string& part) const {
        const Names names = own_shaders->compiled_names();
        return std::any_of(names.begin(), names.end(),
                           [&](const std::string& name) { return name.find(part) != std::string::npos; });
    }

    std::unique_ptr<gl::ShaderLibrary> own_shaders;
    std::unique_ptr<Renderer> renderer;
    scene::Scene scene;
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

}  // namespace
}  // namespace bruma::render
