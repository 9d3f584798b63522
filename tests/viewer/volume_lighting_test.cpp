// Closed form: which fields each lighting shows, what it says it leaves out, lights that keep their effect.
#include "app/panels/volume/volume_lighting.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/panels/statistics_panel.h"
#include "scene/builtin/builtin.h"

namespace bruma::app {
namespace {

using scene::VolumeLighting;

scene::Volume lit(VolumeLighting lighting) {
    scene::Volume volume;
    volume.optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
    return volume;
}
std::string optics_shown(const scene::Volume& volume) {
    std::string names;
    visit_fields(*volume.optics, [&](const scene::Field& field, const auto&) {
        names += optics_field_matters(*volume.optics, field.name) ? std::string(field.name) + " " : "";
    });
    return names;
}
std::string light_volume_shown(const scene::Volume& volume) {
    std::string names;
    visit_fields(*volume.light_volume, [&](const scene::Field& field, const auto&) {
        names += light_volume_field_matters(volume, field.name) ? std::string(field.name) + " " : "";
    });
    return names;
}
scene::Scene sphere() {
    scene::Scene scene;
    scene::Volume volume = lit(VolumeLighting::light_volume);
    volume.grid = scene::builtin_volume("sphere");
    scene.nodes["sphere"] = {.parent = {}, .visible = true, .transform = {}, .content = std::move(volume)};
    return scene;
}
const scene::Volume& volume_of(const scene::Scene& scene) {
    return std::get<scene::Volume>(scene.nodes.at("sphere").content);
}

TEST(VolumeLighting, ShowsOnlyTheFieldsThatHaveAnEffect) {
    const std::string surfaces =
        "highlight density_scale ambient diffuse specular shininess two_sided gradient_soft_from gradient_soft_to ";
    EXPECT_EQ(optics_shown(lit(VolumeLighting::none)), "lighting emission density_scale ");
    EXPECT_EQ(optics_shown(lit(VolumeLighting::gradient)), "lighting emission " + surfaces);
    EXPECT_EQ(optics_shown(lit(VolumeLighting::shadow_rays)), "lighting albedo g emission surfaces density_scale ");
    EXPECT_EQ(optics_shown(lit(VolumeLighting::path_traced)), "lighting albedo g emission density_scale ");
    scene::Volume volume = lit(VolumeLighting::light_volume);
    volume.optics.edit([](scene::VolumeOptics& optics) { optics.surfaces = true; });
    EXPECT_EQ(optics_shown(volume),
              "lighting albedo g emission surfaces highlight density_scale diffuse specular shininess two_sided "
              "gradient_soft_from gradient_soft_to ");
}

TEST(VolumeLighting, ShowsTheSettingsOfThePresentSweep) {
    EXPECT_EQ(light_volume_shown(lit(VolumeLighting::none)), "");
    EXPECT_EQ(light_volume_shown(lit(VolumeLighting::path_traced)), "");
    EXPECT_EQ(light_volume_shown(lit(VolumeLighting::shadow_rays)), "resolution precision near_steps ");
    scene::Volume volume = lit(VolumeLighting::light_volume);
    EXPECT_EQ(light_volume_shown(volume), "mode resolution precision diffuse spread near_steps slices_per_dispatch ");
    volume.light_volume.edit([](scene::LightVolumeSettings& settings) { settings.diffuse = false; });
    EXPECT_EQ(light_volume_shown(volume), "mode resolution precision diffuse near_steps slices_per_dispatch ");
    volume.light_volume.edit([](scene::LightVolumeSettings& settings) { settings.mode = scene::SweepMode::paper; });
    EXPECT_EQ(light_volume_shown(volume),
              "mode resolution precision near_steps cone_angle soft_shadows slices_per_dispatch ");
}

TEST(VolumeLighting, SaysWhatIsLeftOut) {
    scene::Scene scene = sphere();
    EXPECT_EQ(light_left_out(scene, volume_of(scene)),
              "Left out: light that turns back or sideways when scattered again.");
    EXPECT_EQ(light_left_out(scene, lit(VolumeLighting::shadow_rays)),
              "Left out: light scattered more than once (in bright media that is more than half of it).");
    scene.environment.edit([](scene::Environment& environment) { environment.radiance = glm::dvec3(0.1); });
    EXPECT_EQ(light_left_out(scene, lit(VolumeLighting::gradient)),
              "Left out: all shadows and all scattering and light of the environment.");
    scene.nodes["other"] = scene.nodes.at("sphere");
    EXPECT_EQ(light_left_out(scene, volume_of(scene)),
              "Left out: light that turns back or sideways when scattered again, shadows of other volumes and light of "
              "the environment.");
}

TEST(VolumeLighting, ASunTakesThePlaceOfHeadlights) {
    scene::Scene scene = sphere();
    EXPECT_FALSE(lacks_sun(scene, lit(VolumeLighting::gradient)));
    scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
    EXPECT_TRUE(lacks_sun(scene, volume_of(scene)));
    EXPECT_EQ(add_sun(scene), "sun");
    EXPECT_FALSE(lacks_sun(scene, volume_of(scene)));
    EXPECT_FALSE(scene.lights.at("head")->on);
    EXPECT_NO_THROW(scene::check(scene));
}

TEST(VolumeLighting, ALightThatGetsAPositionLightsTheMiddleAsBefore) {
    const scene::Scene scene = sphere();
    const scene::Bounds bounds = scene::world_bounds(scene);
    const glm::dvec3 middle = 0.5 * (bounds.low + bounds.high);
    const scene::Light before{.direction_world = {0.0, 3.0, 4.0}, .color = {1.0, 0.5, 0.25}, .intensity = 7.0};
    scene::Light after = before;
    after.kind = scene::LightKind::point;
    after = with_same_effect(scene, before, after);
    scene::Light back = after;
    back.kind = scene::LightKind::directional;
    back = with_same_effect(scene, after, back);
    for (const scene::Light& light : {after, back}) {
        const scene::Incident incident = scene::incident_light(light, middle, {0.0, 0.0, 1.0});
        EXPECT_NEAR(incident.irradiance.x, 7.0, 1e-12);
        EXPECT_NEAR(incident.toward_world.y, 0.6, 1e-12);
        EXPECT_NEAR(incident.toward_world.z, 0.8, 1e-12);
    }
}

TEST(OpticalDepth, IsTheLogarithmOfWhatPasses) {
    scene::RenderSettings settings;
    EXPECT_EQ(optical_depth_words(1.0 - std::exp(-1.83), settings), "optical depth 1.83, 16 % passes");
    EXPECT_EQ(optical_depth_words(1e-6, settings), "optical depth 0.00, 100 % passes");
    EXPECT_EQ(optical_depth_words(0.995, settings), "optical depth 5.30, 0.5 % passes");
    EXPECT_EQ(optical_depth_words(0.9995, settings), "optical depth above 6.9, less than 0.098 % passes");
    settings.early_termination = false;
    EXPECT_EQ(optical_depth_words(0.9995, settings), "optical depth 7.60, 0.05 % passes");
}

}  // namespace
}  // namespace bruma::app
