// Shelf: closed form. Light on opaque surfaces, and numbers that stay finite whatever the size.
#include <cstring>
#include <numbers>

#include "opaque_mesh.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::render {
namespace {

constexpr glm::ivec2 pixels(33, 33);

scene::Scene ball_seen_from(double distance, scene::Projection projection) {
    scene::Scene scene = scene_seen_from(distance, projection, 2.5);
    add_mesh(scene, "ball", sphere_mesh(128), {0.8, 0.4, 0.2});
    // Where the light ends, flat triangles stand in their own shadow before their normals turn away.
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.shadow_map_size = 0; });
    return scene;
}

/// Radiance of a Lambert unit ball at a pixel, by one light; negative beside the ball.
double lambert(const scene::Scene& scene, const scene::Light& light, int x, int y) {
    const scene::Ray ray = scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, pixels.x, pixels.y);
    const double b = glm::dot(ray.origin_world, ray.direction_world);
    const double root = b * b - glm::dot(ray.origin_world, ray.origin_world) + 1.0;
    if (root < 0.05) {
        return -1.0;  // beside it, or so near its edge that the flat triangles tell
    }
    const glm::dvec3 p = ray.origin_world + (-b - std::sqrt(root)) * ray.direction_world;
    const auto incident = scene::incident_light(light, p, scene::camera_frame(**scene.camera).back_world);
    return incident.irradiance.x * std::max(0.0, glm::dot(p, incident.toward_world)) / std::numbers::pi;
}

TEST_F(Drawing, ABallUnderEachKindOfLightIsLambert) {
    scene::Light kinds[4];
    kinds[0] = {.kind = scene::LightKind::directional, .direction_world = {-0.4, 0.8, 0.6}};
    kinds[1] = {.kind = scene::LightKind::headlight};
    kinds[2] = {.kind = scene::LightKind::point, .position_world = {1.0, 1.5, 2.0}, .intensity = 9.0};
    kinds[3] = {.kind = scene::LightKind::spot,
                .direction_world = {0.2, 0.3, 1.0},
                .position_world = {0.4, 0.6, 3.0},
                .spot_angle_deg = 20.0,
                .spot_softness = 0.5,
                .intensity = 20.0};
    for (const scene::Projection projection : both_projections) {
        for (const scene::Light& light : kinds) {
            scene::Scene scene = ball_seen_from(4.0, projection);
            scene.rendering.edit([](scene::RenderSettings& s) { s.samples = 1; });  // what is at the pixels' centres
            scene.lights["key"] = light;
            const Image image = draw(scene, pixels);
            double worst = 0.0;
            int seen = 0;
            for (int y = 0; y < pixels.y; ++y) {
                for (int x = 0; x < pixels.x; ++x) {
                    const double expected = lambert(scene, light, x, y);
                    if (expected >= 0.0) {
                        worst = std::max(worst, std::abs(image.pixel(x, y)[0] - 0.8 * expected));
                        worst = std::max(worst, std::abs(image.pixel(x, y)[2] - 0.2 * expected));
                        ++seen;
                    }
                }
            }
            EXPECT_GT(seen, 400);
            // Interpolated normals of 128 rings: (pi / 128)^2 / 8 = 8e-5 off, times the slope of the ball at its edge.
            EXPECT_LE(worst, 1e-3) << "light " << int(light.kind) << ", orthographic " << int(projection);
            report("Lambert, light " + std::to_string(int(light.kind)), worst);
        }
    }
}

TEST_F(Drawing, BothSidesAreLitFromTheSideOfTheEye) {
    scene::Scene scene = scene_seen_from(4.0, scene::Projection::perspective, 1.0);
    scene.lights["front"] = scene::Light{.direction_world = {0.0, 0.6, 0.8}};
    scene::Mesh& quad_in_scene = add_mesh(scene, "quad", quad_mesh(2.0F), glm::dvec3(0.5));
    const auto middle = [&] { return draw(scene, {5, 5}).pixel(2, 2)[0]; };
    EXPECT_NEAR(middle(), 0.4, 1e-6) << "0.5 times a cosine of 0.8";
    scene.nodes.at("quad").transform = scene::Transform{.rotation_deg = {0.0, 180.0, 0.0}};
    EXPECT_NEAR(middle(), 0.4, 1e-6) << "seen and lit from behind";
    scene.nodes.at("quad").transform = scene::Transform{.scale = {-2.0, 1.0, 1.0}};
    EXPECT_NEAR(middle(), 0.4, 1e-6) << "mirrored";
    scene.lights.at("front").edit([](scene::Light& light) { light.direction_world.z = -0.8; });
    EXPECT_EQ(middle(), 0.0F) << "light from behind";
    // Wound against its normals: the rasteriser's side must still be the lit one.
    auto odd = std::make_shared<scene::TriangleMesh>(**quad_in_scene.triangles);
    odd->triangles = {{0, 2, 1}, {0, 2, 3}};
    scene.lights.at("front").edit([](scene::Light& light) { light.direction_world.z = 0.8; });
    quad_in_scene.triangles.set(odd);
    const Image image = draw(scene, {6, 6});
    EXPECT_NEAR(image.pixel(1, 4)[0], 0.4, 1e-6);
    EXPECT_NEAR(image.pixel(4, 1)[0], 0.4, 1e-6);
}

TEST_F(Drawing, HighlightsAreWhereTheirFormulasPutThem) {
    scene::Scene scene = scene_seen_from(4.0, scene::Projection::orthographic, 1.0);
    scene.lights["key"] = scene::Light{.direction_world = {0.6, 0.0, 0.8}, .color = {1.0, 0.5, 0.25}};
    scene::Mesh& quad = add_mesh(scene, "quad", quad_mesh(2.0F), glm::dvec3(0.0));
    const auto drawn = [&](scene::MeshShading shading) {
        quad.surface.edit([&](scene::MeshSurface& surface) {
            surface.shading = shading;
            surface.specular = 0.5;
            surface.shininess = 10.0;
        });
        return draw(scene, {5, 5});
    };
    // The mirrored light stands 36.87 degrees from the eye, the half vector half of that from the normal.
    const double phong = 0.5 * std::pow(0.8, 10.0), blinn = 0.5 * std::pow(std::sqrt(0.9), 10.0);
    EXPECT_NEAR(drawn(scene::MeshShading::phong).pixel(2, 2)[0], phong, 1e-6);
    EXPECT_NEAR(drawn(scene::MeshShading::phong).pixel(2, 2)[2], 0.25 * phong, 1e-6) << "in the light's colour";
    EXPECT_NEAR(drawn(scene::MeshShading::blinn_phong).pixel(2, 2)[0], blinn, 1e-6);
    EXPECT_EQ(drawn(scene::MeshShading::lambert).pixel(2, 2)[0], 0.0F);
}

TEST_F(Drawing, TexturesLieTheRightWayUp) {
    for (const int bits : {8, 16}) {
        auto picture = std::make_shared<scene::MeshTexture>();
        picture->width = picture->height = 2;
        picture->bits = bits;
        const std::uint8_t bytes[16] = {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 188, 188, 188, 255};
        for (const std::uint8_t byte : bytes) {
            picture->texels.insert(picture->texels.end(), std::size_t(bits / 8), std::byte(byte));  // 257 * byte
        }
        scene::Scene scene = scene_seen_from(4.0, scene::Projection::orthographic, 2.0);
        scene.rendering.edit([](scene::RenderSettings& s) { s.samples = 1; });  // what is at the pixels' centres
        scene.environment = scene::Environment{.radiance = glm::dvec3(1.0)};
        auto mesh = quad_mesh(1.0F);
        mesh->materials[0].diffuse_texture = picture;
        scene::Mesh& quad = add_mesh(scene, "quad", mesh, glm::dvec3(0.5));
        const Image image = draw(scene, {4, 4});
        // Texel centres lie between the pixels' centres, a quarter of a texel off: 0.75^2 of one and some of the
        // others, whose shares at the corner repeat from the other side.
        const double own = 0.75 * 0.75;
        const double grey = std::pow((188.0 / 255.0 + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(image.pixel(1, 1)[0], 0.5 * (own + 0.0625 * grey), 2e-3) << "red at the upper left";
        EXPECT_NEAR(image.pixel(2, 1)[1], 0.5 * (own + 0.1875 * grey), 2e-3) << "green at the upper right";
        EXPECT_NEAR(image.pixel(1, 2)[2], 0.5 * (own + 0.1875 * grey), 2e-3) << "blue at the lower left";
        quad.surface.edit([](scene::MeshSurface& surface) { surface.textured = false; });
        EXPECT_NEAR(draw(scene, {4, 4}).pixel(1, 1)[1], 0.5, 1e-6);
    }
}

TEST_F(Drawing, PerspectiveFromAfarIsOrthographic) {
    scene::Scene near = ball_seen_from(4.0, scene::Projection::orthographic);
    scene::Scene far = ball_seen_from(4e4, scene::Projection::perspective);
    for (scene::Scene* scene : {&near, &far}) {
        scene->lights["key"] = scene::Light{};
    }
    // Rays lean by 1.25 / 4e4 at most; at the edge of the ball a pixel may fall to either side.
    const Image a = draw(near, pixels), b = draw(far, pixels);
    int different = 0;
    for (std::size_t n = 0; n < a.pixel_count(); ++n) {
        different += std::abs(a.rgba[4 * n] - b.rgba[4 * n]) > 1e-3F ? 1 : 0;
    }
    EXPECT_LE(different, 4);
}

TEST_F(Drawing, MeshesOfAnySizeFromAnywhereAreFinite) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        for (const scene::Projection projection : both_projections) {
            for (const double distance : {4.0, 0.5, 1.0, 1e5}) {  // outside, inside, on the surface, far away
                scene::Scene scene = scene_seen_from(distance * size, projection, 2.5 * size);
                if (distance < 2.0) {
                    scene.camera->edit([](scene::Camera& camera) { camera.vertical_angle_deg = 90.0; });
                }
                scene::Mesh& ball =
                    add_mesh(scene, "ball", sphere_mesh(32), glm::dvec3(0.5), {.scale = glm::dvec3(size)});
                ball.surface.edit([](scene::MeshSurface& s) { s.shading = scene::MeshShading::blinn_phong; });
                scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
                scene.lights["point"] = scene::Light{.kind = scene::LightKind::point,
                                                     .position_world = glm::dvec3(2.0 * size),
                                                     .intensity = size * size};
                const Image image = draw(scene, {16, 16});
                EXPECT_GT(image.pixel(8, 8)[0], 0.1F) << "size " << size << ", distance " << distance;
                scene.nodes.at("ball").transform.edit([&](scene::Transform& t) { t.translation.z = 1e7 * size; });
                EXPECT_EQ(draw(scene, {16, 16}).pixel(8, 8)[3], 0.0F) << "behind the camera";
            }
        }
    }
}

}  // namespace
}  // namespace bruma::render
