// Shelf: independent reference, and one model against another: skies, their light and their ground in one unit.
#include <algorithm>
#include <cmath>

#include "cloud_scenes.h"
#include "kept_renderer.h"
#include "reference/clouds/light_of_sky.h"
#include "sky_scenes.h"

namespace bruma::render {
namespace {

constexpr scene::SkyModel models[] = {scene::SkyModel::atmosphere, scene::SkyModel::preetham, scene::SkyModel::look};

class SkyModels : public KeptRenderer {
  protected:
    Image picture(const scene::Scene& scene, glm::ivec2 pixels) {
        renderer->render(scene, {pixels, 1.0});
        Image image = renderer->read_picture();
        EXPECT_TRUE(all_finite(image));
        return image;
    }
};

double median_green(const Image& image) {
    std::vector<float> green;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        green.push_back(image.rgba[4 * n + 1]);
    }
    std::nth_element(green.begin(), green.begin() + std::ptrdiff_t(green.size() / 2), green.end());
    return green[green.size() / 2];
}

glm::dvec3 mean(const Image& image) {
    glm::dvec3 sum(0.0);
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        sum += glm::dvec3(image.rgba[4 * n], image.rgba[4 * n + 1], image.rgba[4 * n + 2]);
    }
    return sum / double(image.pixel_count());
}

void choose(scene::Scene& scene, scene::SkyModel model) {
    scene.outdoors->sky.edit([model](scene::Sky& sky) { sky.model = model; });
}

TEST_F(SkyModels, AreAsBrightAsOneAnother) {
    for (const double elevation : {5.0, 20.0, 45.0, 80.0}) {
        for (const bool ground : {false, true}) {
            scene::Scene scene = sky_scene(2.0, elevation, ground ? -50.0 : 45.0, 80.0);
            double atmosphere = 0.0;
            for (const scene::SkyModel model : models) {
                choose(scene, model);
                const double found = median_green(picture(scene, {24, 24}));
                if (model == scene::SkyModel::atmosphere) {
                    atmosphere = found;
                }
                // Parts of clear skies differ more than sums: the zeniths of Linke's turbidity 2.5 and 5 by 4.5 at 45
                // degrees (Kittler, CIE). The ground has most of its light from the same sun.
                const double apart = ground ? 2.0 : 4.5;
                EXPECT_GT(found, atmosphere / apart) << int(model) << ", sun " << elevation << ", ground " << ground;
                EXPECT_LT(found, atmosphere * apart) << int(model) << ", sun " << elevation << ", ground " << ground;
            }
        }
    }
}

TEST_F(SkyModels, LightMatterWithTheirOwnLight) {
    FrameGraph graph;
    SkyPasses passes(graph, shaders());
    for (const scene::SkyModel model : {scene::SkyModel::preetham, scene::SkyModel::look}) {
        for (const double elevation : {70.0, 12.0, 0.5, -3.0}) {
            scene::Scene scene = sky_scene(2.0, elevation);
            choose(scene, model);
            scene.outdoors->sun.edit([](scene::Sun& sun) { sun.irradiance = {2.0, 3.0, 4.0}; });
            passes.update(scene, {}, {8, 8});
            graph.run({passes.light.index});
            std::array<glm::vec4, 4> found{};
            graph.product(passes.light)->buffer.read<glm::vec4>(found);
            static const auto tables = std::make_shared<const reference::AtmosphereTables>(*scene.outdoors->atmosphere);
            const reference::CloudLight exact =
                reference::light_of_sky(tables, *scene.outdoors->sun, 1.0, *scene.outdoors->sky);
            for (int channel = 0; channel < 3; ++channel) {
                // As for the atmosphere: other midpoints, and a table over the sun's climb.
                EXPECT_NEAR(found[2][channel] / exact.sky_top[channel], 1.0, 0.03) << int(model) << " " << elevation;
                EXPECT_NEAR(found[3][channel] / exact.sky_bottom[channel], 1.0, 0.03) << int(model) << " " << elevation;
            }
        }
    }
}

TEST_F(SkyModels, CloudsFitAnyOfThem) {
    // Stratus with gaps from below, where thin cloud and gaps show the sky itself, which may be as far apart as skies
    // are; and from above, where most of what is scattered is the sun's.
    scene::Scene scene = scene::clouds_under_sky_scene();
    clouds_in(scene) = scene::preset_clouds(scene::CloudType::stratus);
    scene::make_missing_map(clouds_in(scene));
    for (const bool above : {false, true}) {
        scene.camera->edit([above](scene::Camera& camera) {
            camera.eye_world = {0.0, above ? 3000.0 : 2.0, 0.0};
            camera.target_world = camera.eye_world + glm::dvec3(0.0, above ? -0.5 : 0.8, -1.0);
        });
        double atmosphere = 0.0;
        for (const scene::SkyModel model : models) {
            choose(scene, model);
            const double found = median_green(picture(scene, {16, 9}));
            if (model == scene::SkyModel::atmosphere) {
                atmosphere = found;
            }
            const double apart = above ? 1.6 : 4.5;
            EXPECT_LT(found, atmosphere * apart) << int(model) << (above ? ", above" : ", below");
            EXPECT_GT(found, atmosphere / apart) << int(model) << (above ? ", above" : ", below");
        }
    }
}

TEST_F(SkyModels, GroundLiesInTheShadowsOfClouds) {
    // What the picture of the ground loses to shadows, in the unit of the picture: the sun's light on the ground and in
    // the air before it is the same under each.
    scene::Scene scene = scene::clouds_under_sky_scene();
    scene.camera->edit([](scene::Camera& camera) {
        camera.eye_world = {0.0, 900.0, 0.0};
        camera.target_world = {0.0, 850.0, -100.0};
        camera.vertical_angle_deg = 20.0;
    });
    double atmosphere = 0.0;
    for (const scene::SkyModel model : models) {
        choose(scene, model);
        double lost = 0.0;
        for (const bool shafts : {false, true}) {
            scene.outdoors->sky.edit([shafts](scene::Sky& sky) { sky.shafts = shafts; });
            lost += (shafts ? -1.0 : 1.0) * mean(picture(scene, {16, 16})).g;
        }
        if (model == scene::SkyModel::atmosphere) {
            atmosphere = lost;
            ASSERT_GT(lost, 0.005);
        }
        EXPECT_NEAR(lost / atmosphere, 1.0, 0.1) << int(model);
    }
}

TEST_F(SkyModels, AreFiniteAtTheirExtremes) {
    scene::Scene scene = sky_scene(2.0, 0.0, 0.0, 120.0);
    for (const scene::SkyModel model : {scene::SkyModel::preetham, scene::SkyModel::look}) {
        for (const double turbidity : {2.0, 20.0}) {
            for (const glm::dvec3& look : {glm::dvec3(0.0), glm::dvec3(10.0, 1.0, 0.99)}) {
                scene.outdoors->sky.set(scene::Sky{.model = model,
                                                   .turbidity = turbidity,
                                                   .look_rayleigh = look.x,
                                                   .look_mie = look.y,
                                                   .look_mie_g = look.z});
                for (const double altitude : {2.0, 5e3, 19e3, 21e3, 200e3}) {
                    for (const double elevation : {-90.0, -6.0, 0.0, 5.0, 90.0}) {
                        scene.outdoors->sun.edit([&](scene::Sun& sun) { sun.elevation_deg = elevation; });
                        scene.camera->edit([&](scene::Camera& camera) {
                            camera.target_world.y += altitude - camera.eye_world.y;
                            camera.eye_world.y = altitude;
                        });
                        const Image image = picture(scene, {8, 8});
                        EXPECT_GE(*std::min_element(image.rgba.begin(), image.rgba.end()), 0.0F)
                            << int(model) << ", " << turbidity << ", " << altitude << " m, sun " << elevation;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace bruma::render
