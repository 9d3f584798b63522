// Shelf: published measurements of clear skies, closed forms, and one model against another: all skies in one unit.
#include "reference/sky/sky_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/sky/sky_picture.h"

namespace bruma::reference {
namespace {

constexpr double rad = std::numbers::pi / 180.0;
constexpr double solar_klx = 127.5;  // above the air (IES)

const AtmosphereTables& tables() {
    static const AtmosphereTables of_earth{scene::Atmosphere{}};
    return of_earth;
}

glm::dvec3 sun_at(double elevation_deg) {
    return {std::cos(elevation_deg * rad), std::sin(elevation_deg * rad), 0.0};
}

SkyView atmosphere_at(double elevation_deg) {
    return SkyView(tables(), 1.0, sun_at(elevation_deg), {64, 64}, 40);
}

scene::Sky sky_of(scene::SkyModel model) {
    scene::Sky sky;
    sky.model = model;
    return sky;
}

GroundSky model_at(const scene::Sky& sky, double elevation_deg) {
    return GroundSky(sky, sun_at(elevation_deg), atmosphere_at(elevation_deg).planar_irradiance());
}

TEST(SkyModels, SendTheLightOfAClearSky) {
    // Gillette, Pierpoint and Treado 1984 (IES): a clear sky without the sun sends 0.8 + 15.5 sqrt(sin elevation) klx
    // to a level plane: 5.4, 9.9, 13.8, 16.2 klx. Haze moves that by a factor of 2 either way; some more for the pure
    // air of the atmosphere's default.
    constexpr double apart = 2.5;
    for (const double elevation : {5.0, 20.0, 45.0, 80.0}) {
        const double measured = 0.8 + 15.5 * std::sqrt(std::sin(elevation * rad));
        const SkyView atmosphere = atmosphere_at(elevation);
        const glm::dvec3 planar = atmosphere.planar_irradiance();
        const GroundSky preetham = model_at(sky_of(scene::SkyModel::preetham), elevation);
        const GroundSky look = model_at(sky_of(scene::SkyModel::look), elevation);
        for (const glm::dvec3& found : {planar, preetham.irradiance().planar, look.irradiance().planar}) {
            EXPECT_GT(solar_klx * scene::luminance(found), measured / apart) << elevation;
            EXPECT_LT(solar_klx * scene::luminance(found), measured * apart) << elevation;
        }
        EXPECT_NEAR(scene::luminance(look.irradiance().planar) / scene::luminance(planar), 1.0, 1e-9) << elevation;
        // Zeniths differ more than sums: by (1.34 T - 3.46) tan(elevation) + 0.10 T + 0.90 kcd/m2 (Kittler, CIE), at
        // 45 degrees 4.5 times between clear skies of Linke's turbidity 2.5 and 5.
        const glm::dvec3 up(0.0, 1.0, 0.0);
        const double zenith = scene::luminance(atmosphere.radiance(up));
        for (const GroundSky& model : {preetham, look}) {
            EXPECT_GT(scene::luminance(model.radiance(up)), zenith / 4.5) << elevation;
            EXPECT_LT(scene::luminance(model.radiance(up)), zenith * 4.5) << elevation;
        }
        RecordProperty("klx at " + std::to_string(int(elevation)),
                       std::to_string(solar_klx * scene::luminance(planar)) + " " +
                           std::to_string(solar_klx * scene::luminance(preetham.irradiance().planar)));
    }
}

TEST(SkyModels, PreethamIsItsLuminanceOverTheSunsIlluminance) {
    // Golden: 3.487327 kcd/m2 at the zenith, turbidity 2, sun at 30 degrees; no scale is needed there.
    const GroundSky sky = model_at(sky_of(scene::SkyModel::preetham), 30.0);
    EXPECT_NEAR(scene::luminance(sky.radiance({0.0, 1.0, 0.0})), 3.487327 / solar_klx, 1e-5);
}

TEST(SkyModels, HazeSendsNoMoreThanTheSun) {
    for (const double turbidity : {2.0, 6.0, 10.0, 20.0}) {
        for (const double elevation : {0.0, 1.0, 5.0, 20.0, 45.0, 80.0, 90.0}) {
            scene::Sky sky = sky_of(scene::SkyModel::preetham);
            sky.turbidity = turbidity;
            const double planar = scene::luminance(model_at(sky, elevation).irradiance().planar);
            const double air = scene::luminance(atmosphere_at(elevation).planar_irradiance());
            EXPECT_LE(planar, 0.5 * std::sin(elevation * rad) + 1.0001 * air) << turbidity << ", sun " << elevation;
            EXPECT_GT(planar, 0.1 * air) << turbidity << ", sun " << elevation;
        }
    }
}

TEST(SkyModels, FadeAtTwilightWithTheAtmosphere) {
    for (const scene::SkyModel model : {scene::SkyModel::preetham, scene::SkyModel::look}) {
        double before = 1.0;
        for (const double elevation : {1.0, 0.1, -0.1, -2.0, -6.0, -12.0, -40.0, -90.0}) {
            const double planar = scene::luminance(model_at(sky_of(model), elevation).irradiance().planar);
            const double air = scene::luminance(atmosphere_at(elevation).planar_irradiance());
            EXPECT_LE(planar, before) << elevation;
            if (elevation < 0.0) {
                EXPECT_NEAR(planar, air, 1e-6 * air + 1e-15) << elevation;
            }
            before = planar;
        }
    }
}

TEST(SkyModels, AreFiniteAtTheirExtremes) {
    for (const scene::SkyModel model : {scene::SkyModel::preetham, scene::SkyModel::look}) {
        for (const double turbidity : {2.0, 20.0}) {
            for (const glm::dvec3& look : {glm::dvec3(0.0), glm::dvec3(1.0, 0.005, 0.8), glm::dvec3(10.0, 1.0, 0.99)}) {
                for (const double elevation : {-90.0, -18.0, 0.0, 0.1, 45.0, 90.0}) {
                    const GroundSky sky(scene::Sky{.model = model,
                                                   .turbidity = turbidity,
                                                   .look_rayleigh = look.x,
                                                   .look_mie = look.y,
                                                   .look_mie_g = look.z},
                                        sun_at(elevation), atmosphere_at(elevation).planar_irradiance());
                    for (const double view : {-90.0, -1.0, 0.0, 30.0, 90.0}) {
                        for (const glm::dvec3& light : {sky.radiance(sun_at(view)), sky.disc(sun_at(view))}) {
                            for (int channel = 0; channel < 3; ++channel) {
                                EXPECT_TRUE(std::isfinite(light[channel]));
                                EXPECT_GE(light[channel], 0.0);
                            }
                        }
                    }
                }
            }
        }
    }
}

TEST(SkyModels, StandOverOneGround) {
    // Towards the ground a picture is the air before a Lambert plane under sun and sky, whichever sky.
    scene::Scene scene;
    scene.outdoors.emplace();
    scene.outdoors->sun = scene::Sun{.elevation_deg = 40.0};
    scene.camera = scene::Camera{.eye_world = {0.0, 2.0, 0.0}, .target_world = {0.0, 1.0, -0.2}};
    scene::Ray down;
    down.origin_world = {0.0, 2.0, 0.0};
    down.direction_world = glm::normalize(glm::dvec3(0.0, -1.0, -0.2));
    for (const scene::SkyModel model :
         {scene::SkyModel::atmosphere, scene::SkyModel::preetham, scene::SkyModel::look}) {
        scene.outdoors->sky.edit([model](scene::Sky& sky) { sky.model = model; });
        const SkyBackground background(scene, {});
        const glm::dvec3 air = atmosphere_at(40.0).planar_irradiance();
        const glm::dvec3 planar = model == scene::SkyModel::atmosphere
                                      ? air
                                      : GroundSky(sky_of(model), sun_at(40.0), air).irradiance().planar;
        const double climb = std::sin(40.0 * rad);
        const glm::dvec3 expected =
            0.3 * std::numbers::inv_pi * (climb * tables().sun_transmittance(0.0, climb) + planar);
        for (int channel = 0; channel < 3; ++channel) {
            // Light on the ground is kept over the sun's climb.
            EXPECT_NEAR(background.radiance(down, 100)[channel] / expected[channel], 1.0, 0.01) << int(model);
        }
    }
}

TEST(SkyModels, GiveWayToTheAtmosphereHighUp) {
    scene::Scene scene;
    scene.outdoors.emplace();
    scene.camera = scene::Camera{.eye_world = {0.0, 300e3, 0.0}, .target_world = {0.0, 250e3, -400e3}};
    scene::Ray limb, up;
    limb.origin_world = up.origin_world = {0.0, 300e3, 0.0};
    limb.direction_world = glm::normalize(glm::dvec3(0.0, -0.285, -0.96));
    up.direction_world = {0.0, 1.0, 0.0};
    const SkyBackground atmosphere(scene, {});
    scene.outdoors->sky.edit([](scene::Sky& sky) { sky.model = scene::SkyModel::preetham; });
    EXPECT_EQ(SkyBackground(scene, {}).radiance(up, 50), glm::dvec3(0.0));
    EXPECT_EQ(SkyBackground(scene, {}).radiance(limb, 50), atmosphere.radiance(limb, 50));
    EXPECT_EQ(scene::ground_sky_share(1000.0), 1.0);
    EXPECT_EQ(scene::ground_sky_share(20e3), 0.0);
}

}  // namespace
}  // namespace bruma::reference
