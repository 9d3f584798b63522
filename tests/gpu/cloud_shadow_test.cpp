// Shelf: closed form, exp(-tau), and for tau the independent density in double precision along the way to the sun.
// Shadows of clouds on meshes.
#include <numbers>

#include "base/log.h"
#include "cloud_scenes.h"
#include "kept_renderer.h"
#include "opaque_mesh.h"
#include "translucent.h"

namespace bruma::render {
namespace {

class CloudShadow : public KeptRenderer {
  protected:
    /// A level plate under a lamp and clouds, seen from close above.
    static scene::Scene plate(double altitude_m, double elevation_deg) {
        scene::Scene scene = cloud_scene(scene::CloudType::cumulus, CloudView::below);
        const double elevation = glm::radians(elevation_deg);
        scene.lights.at("sun").edit([&](scene::Light& sun) {
            sun.direction_world = {std::cos(elevation) * 0.6, std::sin(elevation), std::cos(elevation) * 0.8};
        });
        scene.environment = scene::Environment{.radiance = glm::dvec3(0.0)};
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.shadow_map_size = 0; });
        scene.camera->edit([&](scene::Camera& camera) {
            camera.eye_world = {0.0, altitude_m + 20.0, 0.0};
            camera.target_world = {0.0, altitude_m, 0.1};
            camera.vertical_angle_deg = 20.0;
        });
        add_mesh(scene, "plate", quad_mesh(40.0F), glm::dvec3(0.7),
                 {.translation = {0.0, altitude_m, 0.0}, .rotation_deg = {-90.0, 0.0, 0.0}});
        return scene;
    }
    /// Noise so wide that the layer is the same everywhere near.
    static void make_even(scene::Scene& scene, double extinction_per_m) {
        set_even_weather(scene, {255, 255, 255, 128});
        clouds_in(scene).layer.edit([](scene::CloudLayer& layer) {
            layer.coverage = 1.0;
            layer.skew_m = 0.0;
            layer.shape_tile_m = layer.detail_tile_m = 1e9;
            layer.weather_tile_m = 1e4;
        });
        clouds_in(scene).optics.edit([&](scene::CloudOptics& optics) { optics.extinction_per_m = extinction_per_m; });
        clouds_in(scene).march.edit([](scene::CloudMarch& march) { march.grid_columns = 16; });
    }
    static void move_by(scene::Scene& scene, double x, double z) {
        scene.camera->edit([&](scene::Camera& camera) {
            camera.eye_world += glm::dvec3(x, 0.0, z);
            camera.target_world += glm::dvec3(x, 0.0, z);
        });
        scene.nodes.at("plate").transform.edit([&](scene::Transform& t) { t.translation += glm::dvec3(x, 0.0, z); });
    }
    /// Radiance of the middle of the plate. What two pictures share is made once.
    double middle(const scene::Scene& scene) {
        renderer->render(scene, {{5, 5}, 1.0});
        return renderer->read_picture().pixel(2, 2)[1];
    }
    /// Share of the light that clouds leave of one lamp, whose light alone falls on the plate.
    double found_share(const scene::Scene& scene) {
        const scene::Light& sun = *scene.lights.at("sun");
        const double clear =
            0.7 * sun.color.g * sun.intensity * std::numbers::inv_pi * glm::normalize(sun.direction_world).y;
        return middle(scene) / clear;
    }
    /// Optical depth from the middle of the plate to the sun.
    static double exact_depth(scene::Scene& scene, const char* node = "plate") {
        const scene::CloudLayer& layer = *clouds_in(scene).layer;
        const reference::CloudField field = exact_field(scene);
        const glm::dvec3 to_sun = glm::normalize(scene.lights.at("sun")->direction_world);
        const glm::dvec3 from = scene.nodes.at(node).transform->translation;
        const double begin = std::max(0.0, (layer.bottom_m - from.y) / to_sun.y);
        const double end = (layer.top_m - from.y) / to_sun.y;
        constexpr int samples = 4000;
        double sum = 0.0;
        for (int n = 0; n < samples; ++n) {
            sum += field.density(from + (begin + (end - begin) * (n + 0.5) / samples) * to_sun);
        }
        return clouds_in(scene).optics->extinction_per_m * sum * std::max(0.0, end - begin) / samples;
    }
};

TEST_F(CloudShadow, IsBeersLawWhereTheSunPutsIt) {
    for (const double elevation : {90.0, 45.0, 12.0}) {
        for (const double altitude : {0.0, 900.0}) {
            for (const double extinction : {4e-4, 2e-3}) {
                scene::Scene scene = plate(altitude, elevation);
                make_even(scene, extinction);
                const double depth = exact_depth(scene);
                // The grid's midpoints between two slices, and its 16-bit floats.
                EXPECT_NEAR(found_share(scene) / std::exp(-depth), 1.0, 0.002 + 0.005 * depth)
                    << elevation << " deg, " << altitude << " m, depth " << depth;
                report("optical depth", depth);
            }
        }
    }
    // Of cumulus, which have rims.
    double squares = 0.0;
    int shaded = 0, lit = 0;
    const glm::dvec2 steps[] = {{0, 0},       {3e3, 1e3},   {-7e3, 1e3}, {9e3, -8e3},  {-13e3, 5e3},
                                {20e3, 11e3}, {-14e3, 5e3}, {9e3, -8e3}, {-13e3, 2e3}, {8e3, -21e3}};
    scene::Scene scene = plate(0.0, 50.0);
    scene.time.edit([](scene::Timeline& timeline) { timeline.now_s = 333.0; });
    for (const glm::dvec2 step : steps) {
        move_by(scene, step.x, step.y);
        const double exact = std::exp(-exact_depth(scene)), found = found_share(scene);
        squares += (found - exact) * (found - exact) / double(std::size(steps));
        shaded += exact < 0.1 ? 1 : 0;
        lit += exact > 0.9 ? 1 : 0;
    }
    EXPECT_GE(shaded, 2);
    EXPECT_GE(lit, 2);
    // A grid of 104 m columns blurs the rims.
    EXPECT_LE(std::sqrt(squares), 0.02);
    report("RMS difference of the share of light", std::sqrt(squares));
}

TEST_F(CloudShadow, FallsBelowOnlyAndOnOneLampOnly) {
    scene::Scene above = plate(5000.0, 45.0);
    make_even(above, 0.01);
    EXPECT_NEAR(found_share(above), 1.0, 1e-5) << "above the layer";

    scene::Scene scene = plate(0.0, 45.0);
    make_even(scene, 0.01);
    EXPECT_LT(found_share(scene), 0.01);
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) {
        layer.bounds = scene::CloudBounds::box;
        layer.box_center_m = {0.0, 5000.0};
        layer.box_size_m = {1000.0, 2000.0};
    });
    EXPECT_NEAR(found_share(scene), 1.0, 1e-5) << "its box lies beside the way to the sun";
    clouds_in(scene).layer.edit([](scene::CloudLayer& layer) { layer.bounds = scene::CloudBounds::shell; });
    // The second lamp by name is none that clouds know of.
    scene.lights["zenith"] = scene::Light{.direction_world = {0.0, 1.0, 0.0}, .color = glm::dvec3(1.0)};
    const double both = middle(scene);
    const double expected = 0.7 * scene.lights.at("zenith")->intensity * std::numbers::inv_pi;
    EXPECT_NEAR(both / expected, 1.0, 0.02);
}

TEST_F(CloudShadow, FallsOnVolumesAsOnMeshes) {
    const auto fill = homogeneous({8, 8, 8}, {1.0, 1.0, 1.0});
    for (const auto lighting : {scene::VolumeLighting::shadow_rays, scene::VolumeLighting::light_volume}) {
        scene::Scene scene = plate(0.0, 45.0);
        scene.nodes.erase("plate");
        scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
        scene.nodes["volume"] = scene_with(fill, uniform_extinction(1.0)).nodes.at("volume");
        volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
        make_even(scene, 1e-3);
        const double shaded = middle(scene);
        const double depth = exact_depth(scene, "volume");
        scene.nodes.at("sky").visible = false;
        const double lit = middle(scene);
        EXPECT_GT(lit, 0.0);
        // The same grid of light as for meshes.
        EXPECT_NEAR(shaded / lit / std::exp(-depth), 1.0, 0.002 + 0.005 * depth) << int(lighting);
        EXPECT_GT(depth, 0.3);
        report("share of light on a volume", shaded / lit);
    }
}

TEST_F(CloudShadow, FallsInsideTranslucentMeshesOfOneLamp) {
    scene::Scene scene = plate(0.0, 45.0);
    scene.nodes.erase("plate");
    scene::SubsurfaceMedium cream;
    add_translucent(scene, "ball", sphere_mesh(12), cream);
    scene.nodes.at("ball").transform.edit([](scene::Transform& t) { t.scale = glm::dvec3(0.01); });
    scene.camera->edit([](scene::Camera& camera) {
        camera.eye_world = {0.0, 0.05, 0.0};
        camera.target_world = {0.0, 0.0, 1e-4};
        camera.near_distance = 1e-3;
    });
    make_even(scene, 1e-3);
    const double shaded = middle(scene);
    const double depth = exact_depth(scene, "ball");
    scene.nodes.at("sky").visible = false;
    const double lit = middle(scene);
    EXPECT_GT(lit, 0.0);
    EXPECT_NEAR(shaded / lit / std::exp(-depth), 1.0, 0.002 + 0.005 * depth) << "the same grid of light as for plates";
}

TEST_F(CloudShadow, SaysWhichLayersThrowNone) {
    scene::Scene scene = plate(0.0, 45.0);
    make_even(scene, 1e-4);
    const scene::Node sky = scene.nodes.at("sky");
    for (int n = 1; n < 9; ++n) {
        scene.nodes["sky" + std::to_string(n)] = sky;
    }
    const std::vector<std::string> shown = scene::shown_clouds(scene);
    EXPECT_EQ(shadows_left_out({shown.begin(), shown.begin() + 8}), "");
    const std::string sentence = shadows_left_out(shown);
    EXPECT_NE(sentence.find("nodes.sky8"), std::string::npos) << sentence;
    const double of_all = found_share(scene);
    const auto said = [&] {
        const std::vector<LogLine> lines = logged_lines();
        return std::count_if(lines.begin(), lines.end(),
                             [&](const LogLine& line) { return line.text.find(sentence) != std::string::npos; });
    };
    EXPECT_EQ(said(), 1);
    middle(scene);
    EXPECT_EQ(said(), 1) << "once";
    scene.nodes.at("sky8").visible = false;
    EXPECT_EQ(found_share(scene), of_all) << "the ninth throws no shadow";
    scene.nodes.at("sky7").visible = false;
    EXPECT_GT(found_share(scene), of_all);
}

}  // namespace
}  // namespace bruma::render
