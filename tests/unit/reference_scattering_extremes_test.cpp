// Shelf: closed form. Inputs at the edge of sense give finite pictures, and the right ones where those are known.
#include <gtest/gtest.h>

#include "reference_scattering_scenes.h"

namespace bruma::reference {
namespace {

void expect_finite(const ScatteringImage& picture, const std::string& what) {
    for (const float value : picture.image.rgba) {
        ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << what;
    }
    for (const glm::vec3 error : picture.error) {
        ASSERT_TRUE(std::isfinite(error.x + error.y + error.z)) << what;
    }
}

/// Both kinds of picture, 3 x 3 pixels, so that one ray meets the centre. A path is cut off early here, for matter of
/// 1e9 optical depths holds some for ever.
void expect_finite_pictures(const scene::Scene& scene, const std::string& what) {
    expect_finite(render_scattering(scene, 3, 3, {.paths = LightPaths::single, .tolerance = 1e-2}), what + ", single");
    expect_finite(render_scattering(scene, 3, 3, {.samples = 16, .max_bounces = 1000}), what + ", multiple");
}

scene::Scene box(double extinction, double albedo, double g) {
    auto scene = scene_with(homogeneous({4, 5, 3}, glm::dvec3(0.8)), uniform_extinction(1.0));
    let_scatter(scene, albedo, g);
    volume_in(scene).optics.edit([&](auto& optics) { optics.density_scale = extinction; });
    scene.environment = scene::Environment{glm::dvec3(0.5)};
    return scene;
}

TEST(ReferenceScatteringExtremes, ExtinctionsAndAsymmetries) {
    for (const double extinction : {0.0, 1e-9, 1e-3, 1.0, 1e3, 1e9}) {
        for (const double albedo : {0.0, 0.5, 1.0}) {
            for (const double g : {-0.99, 0.0, 0.99}) {
                auto scene = box(extinction, albedo, g);
                scene.lights["sun"] = sun({0.0, 0.0, -1.0});
                scene.lights["lamp"] = lamp({0.1, 0.2, 0.3});
                expect_finite_pictures(scene, std::to_string(extinction) + " " + std::to_string(g));
            }
        }
    }
}

TEST(ReferenceScatteringExtremes, PlacesOfLights) {
    const glm::dvec3 places[] = {{0.0, 0.0, 0.0},   {0.4, 0.0, 0.0},    {0.4, 0.4, 0.4}, {0.0, 0.0, 0.4},
                                 {1e300, 0.0, 0.0}, {1e-300, 0.0, 0.0}, {0.0, 0.0, 1e9}};
    for (const glm::dvec3 place : places) {
        auto scene = box(2.0, 0.9, 0.5);
        scene.lights["lamp"] = lamp(place);
        scene.lights["coincident"] = scene.lights["lamp"];
        auto spot = lamp(place, 1e12);
        spot.kind = scene::LightKind::spot;
        spot.spot_softness = 0.0;
        scene.lights["spot"] = spot;
        expect_finite_pictures(scene, std::to_string(place.x));
    }
}

TEST(ReferenceScatteringExtremes, BlackMatterOnlyAbsorbs) {
    auto scene = box(1.5, 0.0, 0.9);
    scene.background = scene::Background{glm::dvec3(1.0), glm::dvec3(1.0)};
    scene.lights["sun"] = sun({0.0, 0.0, 1.0});
    const float passed = float(std::exp(-1.5 * 0.8));
    for (const LightPaths paths : {LightPaths::single, LightPaths::multiple}) {
        const auto picture = render_scattering(scene, 3, 3, {.paths = paths, .samples = 8});
        EXPECT_NEAR(picture.image.pixel(1, 1)[0], passed, 1e-6);
        EXPECT_NEAR(picture.image.pixel(1, 1)[3], 1.0F - passed, 1e-6);
    }
}

TEST(ReferenceScatteringExtremes, NothingAndFlatThingsHavePictures) {
    scene::Scene empty;
    empty.camera.emplace(scene::Camera{});
    expect_finite_pictures(empty, "no volume");
    auto flat = scene_with(homogeneous(glm::ivec3(1), {0.8, 0.8, 1e-12}), uniform_extinction(1e6));
    let_scatter(flat, 1.0, 0.0);
    flat.lights["sun"] = sun({1.0, 0.0, 0.0});  // along the sheet
    expect_finite_pictures(flat, "a sheet");
}

}  // namespace
}  // namespace bruma::reference
