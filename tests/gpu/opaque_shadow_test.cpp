// Shelf: closed form. Shadows of meshes on meshes.
#include <numbers>

#include "opaque_mesh.h"

namespace bruma::render {
namespace {

/// A floor of half width 2 at z = 0 seen from above, and a quad of half width
/// 0.5 at height 1 above its middle.
scene::Scene quad_over_floor() {
    scene::Scene scene = scene_seen_from(6.0, scene::Projection::orthographic, 3.6);
    add_mesh(scene, "floor", quad_mesh(2.0F), glm::dvec3(1.0));
    add_mesh(scene, "quad", quad_mesh(0.5F), glm::dvec3(1.0), {.translation = {0.0, 0.0, 1.0}});
    return scene;
}

struct Lamp {
    const char* name;
    scene::Light light;
};
const Lamp lamps[] = {
    {"directional", {.kind = scene::LightKind::directional, .direction_world = {0.5, 0.3, 1.0}}},
    {"point", {.kind = scene::LightKind::point, .position_world = {2.0, 1.0, 4.0}, .intensity = 16.0}},
    {"point between", {.kind = scene::LightKind::point, .position_world = {0.7, 0.2, 1.8}, .intensity = 4.0}},
    {"spot",
     {.kind = scene::LightKind::spot,
      .direction_world = {0.3, 0.2, 1.0},
      .position_world = {0.9, 0.6, 3.0},
      .spot_angle_deg = 40.0,
      .intensity = 12.0}},
};

TEST_F(Drawing, AQuadThrowsItsShadowWhereLinesToTheLampCutIt) {
    constexpr glm::ivec2 pixels(96, 96);
    for (const Lamp& lamp : lamps) {
        scene::Scene scene = quad_over_floor();
        scene.lights["lamp"] = lamp.light;
        const Image image = draw(scene, pixels);
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.shadow_map_size = 0; });
        const Image lit = draw(scene, pixels);
        int dark = 0, wrong = 0;
        for (int y = 0; y < pixels.y; ++y) {
            for (int x = 0; x < pixels.x; ++x) {
                const double px = ((x + 0.5) / pixels.x - 0.5) * 3.6, py = (0.5 - (y + 0.5) / pixels.y) * 3.6;
                if (std::max(std::abs(px), std::abs(py)) < 0.56 || lit.pixel(x, y)[0] < 1e-3F) {
                    continue;  // the quad itself, or beside the spot
                }
                const glm::dvec3 p(px, py, 0.0);
                const glm::dvec3 toward =
                    scene::has_position(lamp.light) ? lamp.light.position_world - p : lamp.light.direction_world;
                // Where the way to the lamp passes the quad's height, if the lamp is
                // above it.
                const glm::dvec3 cut = p + toward / toward.z;
                const double beyond = std::max(std::abs(cut.x), std::abs(cut.y)) - 0.5;
                // The edge is as wide as three texels of 4 / 1024, or of a cube's face,
                // and so the band left out.
                if (std::abs(beyond) < 0.03) {
                    continue;
                }
                const double share = image.pixel(x, y)[0] / lit.pixel(x, y)[0];
                wrong += std::abs(share - (beyond < 0.0 ? 0.0 : 1.0)) > 1e-3 ? 1 : 0;
                dark += beyond < 0.0 ? 1 : 0;
            }
        }
        EXPECT_EQ(wrong, 0) << lamp.name;
        EXPECT_GT(dark, 100) << lamp.name;
    }
}

TEST_F(Drawing, ABallAloneIsNotSpottedByItsOwnShadow) {
    constexpr glm::ivec2 pixels(128, 128);
    for (const int rings : {32, 128}) {
        for (const double elevation_deg : {5.0, 30.0, 85.0}) {  // light from beside to along the view
            const double e = glm::radians(elevation_deg);
            for (const bool point : {false, true}) {
                scene::Scene scene = scene_seen_from(4.0, scene::Projection::orthographic, 2.2);
                add_mesh(scene, "ball", sphere_mesh(rings), glm::dvec3(1.0));
                const glm::dvec3 toward(std::cos(e), 0.2, std::sin(e));
                scene.lights["lamp"] = point ? scene::Light{.kind = scene::LightKind::point,
                                                            .position_world = 3.0 * toward,
                                                            .intensity = 20.0}
                                             : scene::Light{.direction_world = toward};
                const Image image = draw(scene, pixels);
                scene.rendering.edit([](scene::RenderSettings& settings) { settings.shadow_map_size = 0; });
                const Image lit = draw(scene, pixels);
                double worst = 0.0;
                for (std::size_t n = 0; n < image.pixel_count(); ++n) {
                    if (lit.rgba[4 * n + 3] > 0.5F) {
                        worst = std::max(worst, double(lit.rgba[4 * n] - image.rgba[4 * n]));
                    }
                }
                // Near where the light ends, flat triangles turn away before their
                // normals do: by half an angle of pi / rings, which leaves as much
                // light.
                EXPECT_LE(worst, 2.0 * std::numbers::pi / rings) << rings << " rings, " << elevation_deg << " degrees";
                report("own shadow on a ball of " + std::to_string(rings) + " rings", worst);
            }
        }
    }
}

TEST_F(Drawing, ShadowMapsStandStillWhileTheCameraMoves) {
    scene::Scene scene = quad_over_floor();
    scene.lights["lamp"] = lamps[0].light;
    Renderer renderer(shaders());
    const auto ran = [&] {
        for (const PassReport& pass : renderer.render(scene, {{16, 16}, 1.0})) {
            if (pass.name == "shadow maps") {
                return pass.ran;
            }
        }
        return false;
    };
    EXPECT_TRUE(ran());
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 0.1; });
    EXPECT_FALSE(ran());
    scene.lights.at("lamp").edit([](scene::Light& light) { light.color = {1.0, 0.0, 0.0}; });
    EXPECT_FALSE(ran()) << "a colour throws no shadow";
    scene.nodes.at("quad").transform.edit([](scene::Transform& t) { t.translation.x = 0.1; });
    EXPECT_TRUE(ran());
    scene.lights.at("lamp").edit([](scene::Light& light) { light.kind = scene::LightKind::headlight; });
    EXPECT_FALSE(ran()) << "nobody sees a headlight's shadows";
}

}  // namespace
}  // namespace bruma::render
