// Shelf: closed form, and double-precision reference. Point lamps and spots that light the inside of translucent
// meshes.
#include <numbers>

#include "translucent_truth.h"

namespace bruma::render {
namespace {

class TranslucentLamps : public Drawing {
  protected:
    /// Each pixel by itself, so that nothing but lamps and points of entry is tested.
    Image draw_each_pixel(const scene::Scene& scene, glm::ivec2 pixels, int passes = passes_of_each_pixel) {
        Renderer renderer(shaders());
        renderer.render(scene, view_of(pixels, passes));
        Image image = renderer.read_picture();
        EXPECT_TRUE(all_finite(image));
        return image;
    }
};

/// A ball of radius 10 mm, or the knot, around the origin.
scene::Scene scene_of(const std::string& mesh, const scene::SubsurfaceMedium& medium) {
    scene::Scene scene;
    add_translucent(scene, "body", builtin_triangles(mesh), medium);
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    scene.lights["key"] = scene::Light{};
    scene.camera = parallel_camera_around(scene, {0.3, 0.2, 1.0});
    work_out_each_pixel(scene);
    return scene;
}

TEST_F(TranslucentLamps, AFarPointLampIsADirectionalOne) {
    scene::Scene scene = scene_of("mesh-sphere", scene::medium_of(scene::Material::potato));
    const glm::dvec3 toward = glm::normalize(glm::dvec3(0.6, 0.5, 0.7));
    const glm::dvec3 color(1.0, 0.8, 0.6);
    const glm::ivec2 pixels(16, 16);
    scene.lights.at("key") = scene::Light{.direction_world = toward, .color = color};
    const Image parallel = draw_each_pixel(scene, pixels, 8);
    // Radii of 10 mm: seen in one view, as near as it goes before that; and so far that floats would lose its place.
    for (const double distance_m : {50.0, 1e6}) {
        for (const scene::LightKind kind : {scene::LightKind::point, scene::LightKind::spot}) {
            scene.lights.at("key") = scene::Light{.kind = kind,
                                                  .direction_world = toward,
                                                  .position_world = distance_m * toward,
                                                  .color = color,
                                                  .intensity = std::numbers::pi * distance_m * distance_m};
            const Apart far = apart(draw_each_pixel(scene, pixels, 8), parallel);
            report("lamp " + std::to_string(distance_m) + " m away", far);
            // The same points are drawn; 50 m away directions and distances differ by 4e-4 over the ball, and points
            // that lie near the border of a texel of the lamp's view fall into the next one.
            EXPECT_LE(far.rmse, 4e-3) << distance_m;
            EXPECT_LE(std::abs(far.of_all), 1e-3) << distance_m;
        }
    }
}

TEST_F(TranslucentLamps, ANearPointLampLightsABallAsQuadratureSays) {
    scene::Scene scene = scene_of("mesh-sphere", scene::medium_of(scene::Material::potato));
    const glm::ivec2 pixels(9, 9);
    // Seen in one view and, nearer than 1.25 radii, in six.
    for (const double distance_m : {0.02, 0.0115}) {
        scene.lights.at("key") = scene::Light{.kind = scene::LightKind::point,
                                              .position_world = distance_m * glm::normalize(glm::dvec3(0.6, 0.5, 0.7)),
                                              .color = {1.0, 0.8, 0.6},
                                              .intensity = 1e-4};
        const Apart near = apart(draw_each_pixel(scene, pixels), quadrature_picture(scene, pixels));
        report("lamp " + std::to_string(1e3 * distance_m) + " mm from the middle of a ball of 10", near);
        ASSERT_GT(near.compared, 60);
        EXPECT_LE(near.rmse, 0.02) << distance_m;  // noise of 4096 points
        EXPECT_LE(std::abs(near.mean), 0.005) << distance_m;
    }
}

TEST_F(TranslucentLamps, ALampAmidAKnotLightsAllAroundAsQuadratureSays) {
    scene::Scene scene = scene_of("mesh-knot", scene::medium_of(scene::Material::skin2));
    scene.lights.at("key") = scene::Light{
        .kind = scene::LightKind::point, .position_world = {0.001, -0.002, 0.0015}, .color = {1.0, 0.8, 0.6}};
    const glm::ivec2 pixels(11, 11);
    const Apart amid = apart(draw_each_pixel(scene, pixels), quadrature_picture(scene, pixels));
    report("lamp amid a knot", amid);
    ASSERT_GT(amid.compared, 100);
    EXPECT_LE(amid.rmse, 0.025);  // noise of 4096 points, of which some are drawn in all directions
    EXPECT_LE(std::abs(amid.mean), 0.005);
}

TEST_F(TranslucentLamps, ASpotLightsTheInsideOfItsConeAlone) {
    // Light that is scattered every 0.02 mm and gone after 0.03 leaves where it enters.
    scene::SubsurfaceMedium dense;
    dense.reduced_scattering = glm::dvec3(40.0);
    dense.absorption = glm::dvec3(10.0);
    dense.refraction_index = 1.3;
    scene::Scene scene = scene_of("mesh-sphere", dense);
    std::get<scene::Mesh>(scene.nodes.at("body").content).subsurface.edit([](scene::SubsurfaceSettings& settings) {
        settings.light_map_size = 1024;
    });
    scene::Light lamp{.kind = scene::LightKind::spot,
                      .direction_world = {0.2, 0.1, 1.0},
                      .position_world = {0.004, 0.002, 0.04},
                      .spot_angle_deg = 9.0,
                      .spot_softness = 0.7,
                      .intensity = 1e-3};
    scene.camera = parallel_camera_around(scene, {0.0, 0.0, 1.0});
    const glm::ivec2 pixels(33, 33);
    scene.lights.at("key") = lamp;
    const Image spot = draw_each_pixel(scene, pixels, 32);
    lamp.kind = scene::LightKind::point;
    scene.lights.at("key") = lamp;
    const Image point = draw_each_pixel(scene, pixels, 32);  // with the same random points
    int inside = 0, fading = 0, dark = 0;
    for (int y = 0; y < pixels.y; ++y) {
        for (int x = 0; x < pixels.x; ++x) {
            const scene::Ray ray = scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, pixels.x, pixels.y);
            const glm::dvec2 across(ray.origin_world);
            const double depth2 = 1e-4 - glm::dot(across, across);
            if (depth2 < 0.2e-4 || point.pixel(x, y)[1] <= 0.0F) {
                continue;
            }
            const glm::dvec3 way = lamp.position_world - glm::dvec3(across, std::sqrt(depth2));
            const double angle_deg =
                glm::degrees(std::acos(glm::dot(glm::normalize(way), glm::normalize(lamp.direction_world))));
            // Smoothstep of the cosine from 9 degrees to 0.3 of them.
            const double outer = std::cos(glm::radians(9.0)), inner = std::cos(glm::radians(2.7));
            const double f = std::clamp((std::cos(glm::radians(angle_deg)) - outer) / (inner - outer), 0.0, 1.0);
            // 0.1 mm of the ball are 0.2 degrees of the cone, over which the edge changes by 0.03 at most.
            EXPECT_NEAR(spot.pixel(x, y)[1] / point.pixel(x, y)[1], f * f * (3.0 - 2.0 * f), 0.03)
                << x << ", " << y << ": " << angle_deg << " degrees from the axis";
            (angle_deg < 2.7 ? inside : angle_deg < 9.0 ? fading : dark) += 1;
        }
    }
    EXPECT_GT(inside, 5);
    EXPECT_GT(fading, 30);
    EXPECT_GT(dark, 20);
}

TEST_F(TranslucentLamps, ASpotOnAKnotIsItsQuadrature) {
    scene::Scene scene = scene_of("mesh-knot", scene::medium_of(scene::Material::skin1));
    scene.lights.at("key") = scene::Light{.kind = scene::LightKind::spot,
                                          .direction_world = {0.2, 0.3, 1.0},
                                          .position_world = {0.015, 0.02, 0.06},
                                          .spot_angle_deg = 14.0,
                                          .spot_softness = 0.5,
                                          .color = {1.0, 0.8, 0.6},
                                          .intensity = 0.01};
    const glm::ivec2 pixels(11, 11);
    const Apart spot = apart(draw_each_pixel(scene, pixels), quadrature_picture(scene, pixels));
    report("spot on a knot", spot);
    ASSERT_GT(spot.compared, 100);
    EXPECT_LE(spot.rmse, 0.03);  // noise of 4096 points
    EXPECT_LE(std::abs(spot.mean), 0.006);
}

}  // namespace
}  // namespace bruma::render
