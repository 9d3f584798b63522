// Shelf: closed form. Which passes of the sky a change reruns, and that scenes without one have none.
#include "graph_test.h"
#include "opaque_mesh.h"
#include "scene/builtin/builtin.h"
#include "sky_scenes.h"

namespace bruma::render {
namespace {

class SkyPins : public GraphTest {
  protected:
    SkyPins() { scene = sky_scene(2.0, 40.0); }
};

TEST_F(SkyPins, WithoutASkyThereIsNoneOfIt) {
    scene.outdoors.reset();
    add_mesh(scene, "quad", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 2.0, -3.0}});
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "quad: upload"}));
    for (const PassReport& report : renderer->graph().last_report()) {
        EXPECT_FALSE(report.name.starts_with("sky")) << report.name;
    }
    EXPECT_FALSE(compiled("sky") || compiled("SKY"));
    const Image before = renderer->read_picture();
    scene.outdoors.emplace();
    reruns();
    scene.outdoors.reset();
    reruns();
    EXPECT_TRUE(same_bits(renderer->read_picture(), before)) << "back indoors";
}

TEST_F(SkyPins, FirstPictureAndTheSameAgain) {
    EXPECT_EQ(reruns(),
              (Names{"march", "sky", "sky_irradiance", "sky_multiple_scattering", "sky_transmittance", "sky_view"}));
    EXPECT_EQ(reruns(), Names{});
    EXPECT_FALSE(compiled("sky_light")) << "nothing is there to be lit";
}

TEST_F(SkyPins, TheSunRerunsNoTableOfTheAir) {
    add_mesh(scene, "quad", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 2.0, -3.0}});
    reruns();
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.elevation_deg = 20.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "shadow maps", "sky", "sky_light", "sky_view"}));
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.azimuth_deg += 20.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "shadow maps", "sky", "sky_light"}))
        << "the table turns with the sun";
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.irradiance *= 2.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky", "sky_light"})) << "tables are for a sun of irradiance 1";
}

TEST_F(SkyPins, TheCameraRerunsTheViewOnlyByItsAltitude) {
    add_mesh(scene, "quad", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 2.0, -3.0}});
    reruns();
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 300.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky"})) << "sideways";
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.y += 0.01; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky"})) << "a little";
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.y += 100.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky", "sky_view"})) << "up";
}

TEST_F(SkyPins, TheAirRerunsAll) {
    add_mesh(scene, "quad", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 2.0, -3.0}});
    reruns();
    scene.outdoors->atmosphere.edit([](scene::Atmosphere& air) { air.mie_scattering_per_m *= 2.0; });
    EXPECT_EQ(reruns(), (Names{"march", "opaque", "sky", "sky_irradiance", "sky_light", "sky_multiple_scattering",
                               "sky_transmittance", "sky_view"}));
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.multiple_scattering = false; });
    const Names names = reruns();
    EXPECT_EQ(std::count(names.begin(), names.end(), "sky_transmittance"), 0);
    EXPECT_EQ(std::count(names.begin(), names.end(), "sky_view"), 1);
}

TEST_F(SkyPins, ModelsForComparisonChangeTheLightOfTheSkyAlone) {
    add_mesh(scene, "quad", quad_mesh(1.0F), glm::dvec3(0.5), {.translation = {0.0, 2.0, -3.0}});
    reruns();
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.turbidity = 5.0; });
    EXPECT_EQ(reruns(), (Names{"march", "sky"})) << "the atmosphere has none";
    EXPECT_FALSE(compiled("PREETHAM"));
    // The ground in the view lies under another sky.
    const Names all{"march", "opaque", "sky", "sky_irradiance", "sky_light", "sky_view"};
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.model = scene::SkyModel::preetham; });
    EXPECT_EQ(reruns(), all);
    EXPECT_FALSE(compiled("LOOK"));
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.turbidity = 3.0; });
    EXPECT_EQ(reruns(), all);
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.look_mie_g = 0.5; });
    EXPECT_EQ(reruns(), (Names{"march", "sky"})) << "not its own";
}

TEST_F(SkyPins, SpaceNeedsNoView) {
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.y = 300e3; });
    const Names space = reruns();
    EXPECT_EQ(std::count(space.begin(), space.end(), "sky_view"), 0);
}

TEST_F(SkyPins, VolumesLeaveTheSkyAlone) {
    const auto grid = scene::builtin_volume("sphere");
    scene::Node node;
    scene::Volume volume;
    volume.grid = grid;
    volume.transfer_function = scene::suggested_transfer_function(*grid);
    volume.optics.edit([](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::gradient; });
    node.content = volume;
    node.transform = scene::Transform{.translation = {0.0, 2.0, -0.2}};
    scene.nodes["ball"] = node;
    reruns();
    std::get<scene::Volume>(scene.nodes.at("ball").content).optics.edit([](scene::VolumeOptics& optics) {
        optics.density_scale = 0.5;
    });
    const Names names = reruns();
    EXPECT_TRUE(std::none_of(names.begin(), names.end(), [](const auto& name) { return name.starts_with("sky"); }));
    EXPECT_GE(std::count(names.begin(), names.end(), "march"), 1);
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.elevation_deg = 5.0; });
    const Names after = reruns();
    EXPECT_EQ(std::count(after.begin(), after.end(), "march"), 1) << "the sun is a lamp of volumes";
}

}  // namespace
}  // namespace bruma::render
