// Shelf: closed forms, and the same path told from elsewhere.
#include "reference/sky/sky_picture.h"

#include <gtest/gtest.h>

#include <numbers>

namespace bruma::reference {
namespace {

const scene::Atmosphere earth;

const AtmosphereTables& tables() {
    static const AtmosphereTables of_earth(earth);
    return of_earth;
}

void expect_close(const glm::dvec3& found, const glm::dvec3& expected, double relative) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(found[channel], expected[channel], relative * expected[channel] + 1e-12) << channel;
    }
}

TEST(SkyPath, BeginsWhereTheAirDoes) {
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.3, 0.5, -0.8));
    const glm::dvec3 down = glm::normalize(glm::dvec3(1.0, -2.0, 0.4));
    // From outside and from where that ray enters: the same air.
    const glm::dvec3 far(0.0, 400e3, 0.0);
    const glm::dvec3 near = far + 335e3 * down;
    ASSERT_GT(glm::length(near + glm::dvec3(0.0, 6360e3, 0.0)), 6460e3) << "still outside";
    const SkyPath a = sky_path(tables(), far, down, to_sun, 500), b = sky_path(tables(), near, down, to_sun, 500);
    expect_close(a.air.radiance, b.air.radiance, 1e-9);
    EXPECT_TRUE(a.sun_climb_at_ground);
    const SkyPath away = sky_path(tables(), far, -down, to_sun, 500);
    EXPECT_EQ(away.air.radiance, glm::dvec3(0.0));
    EXPECT_EQ(away.air.transmittance, glm::dvec3(1.0));
}

TEST(SkyPath, IsTheSameFromAnyPointOfThePlanet) {
    // The point, the ray and the sun turned by a third of a turn about the planet's middle.
    const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.3, 0.2, -0.8));
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 0.1, 0.4));
    const double c = std::cos(2.0), s = std::sin(2.0);
    const glm::dmat3 turn(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
    const glm::dvec3 center(0.0, -earth.planet_radius_m, 0.0);
    const SkyPath a = sky_path(tables(), {0.0, 3000.0, 0.0}, direction, to_sun, 300);
    const SkyPath b = sky_path(tables(), center + turn * (glm::dvec3(0.0, 3000.0, 0.0) - center), turn * direction,
                               turn * to_sun, 300);
    expect_close(a.air.radiance, b.air.radiance, 1e-7);
    expect_close(a.air.transmittance, b.air.transmittance, 1e-7);
}

TEST(SkyPicture, TheDiscSendsTheSunsIrradiance) {
    scene::Scene scene;
    scene.outdoors.emplace();
    scene.outdoors->sun = scene::Sun{.elevation_deg = 50.0, .azimuth_deg = 0.0, .irradiance = glm::dvec3(2.0)};
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.multiple_scattering = false; });
    scene::Camera camera{.eye_world = {0.0, 2.0, 0.0}, .vertical_angle_deg = 1.0};
    camera.target_world = camera.eye_world + scene::to_sun_world(*scene.outdoors->sun);
    scene.camera = camera;
    const SkyBackground sky(scene, {.transmittance_steps = 200});
    constexpr int edge = 100;
    const double pixel = 2.0 * std::tan(0.5 * std::numbers::pi / 180.0) / edge;
    glm::dvec3 sum(0.0);
    for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x) {
            sum += sky.disc(scene::camera_ray(camera, x + 0.5, y + 0.5, edge, edge)) * (pixel * pixel);
        }
    }
    const glm::dvec3 expected = 2.0 * transmittance_to_top(earth, 2.0, std::sin(50.0 * std::numbers::pi / 180.0), 5000);
    // 2250 pixels in the disc, those at the rim all or nothing.
    expect_close(sum, expected, 5e-3);
}

}  // namespace
}  // namespace bruma::reference
