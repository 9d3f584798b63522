// Shelf: closed form. Where surfaces stand among volumes: matter before them counts, matter behind does not.
#include "opaque_mesh.h"

namespace bruma::render {
namespace {

constexpr glm::ivec2 few_pixels(7, 7);
const glm::dvec3 source(1.0, 0.5, 0.25);

/// A slab of 1 x 1 x 0.6 m and a black quad in it.
struct QuadInSlab {
    scene::Scene scene;
    double sigma = 3.0;
    double depth = 0.0;  // of the quad's middle along z
    glm::dvec3 normal{0.0, 0.0, 1.0};

    QuadInSlab(scene::Projection projection, double z, glm::dvec3 rotation_deg) : depth(z) {
        scene = scene_with(homogeneous({16, 16, 61}, {1.0, 1.0, 0.6}), uniform_extinction(sigma, source));
        scene.camera = scene_seen_from(3.0, projection, 0.5).camera;
        const scene::Transform transform{.translation = {0.0, 0.0, z}, .rotation_deg = rotation_deg};
        normal = glm::dmat3(scene::parent_from_model(transform)) * normal;
        add_mesh(scene, "quad", quad_mesh(3.0F), glm::dvec3(0.0), transform);
    }
    /// Matter that the ray through a pixel crosses before the quad, metres.
    double matter_before(int x, int y) const {
        const scene::Ray ray = scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, few_pixels.x, few_pixels.y);
        const double t_quad =
            glm::dot(glm::dvec3(0.0, 0.0, depth) - ray.origin_world, normal) / glm::dot(ray.direction_world, normal);
        double t_in = -1e300, t_out = t_quad > 0.0 ? t_quad : 1e300;
        for (int k = 0; k < 3; ++k) {
            const double half = k == 2 ? 0.3 : 0.5;
            const double a = (-half - ray.origin_world[k]) / ray.direction_world[k];
            const double b = (half - ray.origin_world[k]) / ray.direction_world[k];
            t_in = std::max(t_in, std::min(a, b));
            t_out = std::min(t_out, std::max(a, b));
        }
        return std::max(0.0, t_out - t_in);
    }
};

double largest_error(const QuadInSlab& stand, const Image& image) {
    double largest = 0.0;
    for (int y = 0; y < few_pixels.y; ++y) {
        for (int x = 0; x < few_pixels.x; ++x) {
            const double alpha = -std::expm1(-stand.sigma * stand.matter_before(x, y));
            for (int k = 0; k < 3; ++k) {
                largest = std::max(largest, std::abs(image.pixel(x, y)[k] - alpha * source[k]));
            }
        }
    }
    return largest;
}

TEST_F(Drawing, Test22QuadInASlab) {
    double worst = 0.0;
    for (const scene::Projection projection : both_projections) {
        for (const glm::dvec3 rotation : {glm::dvec3(0.0), glm::dvec3(37.0, 0.0, 0.0), glm::dvec3(-20.0, 61.0, 15.0),
                                          glm::dvec3(0.0, 175.0, 0.0)}) {
            for (const double z : {-0.29, -0.1137, 0.0, 0.21, 0.5, -0.8}) {
                for (const Classification classification : both_classifications) {
                    QuadInSlab stand(projection, z, rotation);
                    settle(stand.scene, classification, 0.7);
                    const double error = largest_error(stand, draw(stand.scene, few_pixels));
                    // Rounding of distances of some 300 steps, times 0.02 of optical depth per step.
                    EXPECT_LE(error, 1e-5) << name_of(classification) << ", z " << z << ", rotation " << rotation.x
                                           << " " << rotation.y << ", orthographic " << int(projection);
                    worst = std::max(worst, error);
                }
            }
        }
    }
    report("quad in a slab, largest error", worst);
}

TEST_F(Drawing, NothingBehindAQuadContributesOrCosts) {
    for (const scene::Projection projection : both_projections) {
        QuadInSlab stand(projection, 0.31, glm::dvec3(0.0));
        stand.scene.background = scene::Background{.top = glm::dvec3(7.0), .bottom = glm::dvec3(7.0)};
        const Image image = draw(stand.scene, few_pixels);
        for (std::size_t n = 0; n < image.rgba.size(); ++n) {
            EXPECT_EQ(image.rgba[n], n % 4 == 3 ? 1.0F : 0.0F);
        }
        EXPECT_EQ(count(stand.scene, few_pixels).samples, 0U);
        stand.scene.nodes.at("quad").visible = false;
        EXPECT_GT(count(stand.scene, few_pixels).samples, 0U);
    }
}

TEST_F(Drawing, AVolumeInsideAClosedMeshIsHidden) {
    scene::Scene scene = scene_with(homogeneous({8, 8, 8}, glm::dvec3(0.5)), uniform_extinction(5.0, source));
    scene.camera = oblique_camera(scene);
    add_mesh(scene, "shell", sphere_mesh(48), glm::dvec3(0.7));
    scene.environment = scene::Environment{.radiance = glm::dvec3(1.0)};
    const Image hidden = draw(scene, {32, 32});
    scene.nodes.at("volume").visible = false;
    EXPECT_TRUE(same_bits(hidden, draw(scene, {32, 32})));
    // Ambient light of radiance 1 on an albedo of 0.7.
    EXPECT_NEAR(hidden.pixel(16, 16)[1], 0.7, 1e-6);
}

TEST_F(Drawing, ASphereHalfInAVolumeIsBeforeAndBehindIt) {
    // Seen along -z: matter fills x < 0 in front of the sphere's middle; what is right of it has none before it.
    scene::Scene scene = scene_with(homogeneous({8, 8, 8}, {2.0, 4.0, 4.0}), uniform_extinction(1.5, source));
    scene.nodes.at("volume").transform = scene::Transform{.translation = {-1.0, 0.0, 0.0}};
    scene.camera->edit([](scene::Camera& camera) { camera.view_height = 3.0; });
    add_mesh(scene, "ball", sphere_mesh(96), glm::dvec3(0.0));
    settle(scene, Classification::preintegrated, 0.5);
    const glm::ivec2 pixels(31, 31);
    const Image image = draw(scene, pixels);
    for (const glm::ivec2 at : {glm::ivec2(8, 15), glm::ivec2(12, 19), glm::ivec2(20, 15), glm::ivec2(22, 12)}) {
        const glm::dvec3 p = scene::camera_ray(**scene.camera, at.x + 0.5, at.y + 0.5, 31, 31).origin_world;
        const double z = std::sqrt(1.0 - p.x * p.x - p.y * p.y);
        const double alpha = p.x < 0.0 ? -std::expm1(-1.5 * (2.0 - z)) : 0.0;
        // 96 rings of flat triangles lie up to 1 - cos(pi / 192) = 1.3e-4 below the sphere, more where it slopes.
        EXPECT_NEAR(image.pixel(at.x, at.y)[0], alpha, p.x < 0.0 ? 1.5e-3 : 1e-6) << at.x << ", " << at.y;
    }
    EXPECT_GT(image.pixel(2, 15)[0], 0.99) << "beside the ball all 4 m of matter";
}

TEST_F(Drawing, TheNearestOfTwoMeshesIsSeen) {
    for (const scene::Projection projection : both_projections) {
        scene::Scene scene = scene_seen_from(5.0, projection, 1.0);
        scene.environment = scene::Environment{.radiance = glm::dvec3(1.0)};
        add_mesh(scene, "a near", quad_mesh(2.0F), {0.9, 0.0, 0.0}, {.translation = {0.0, 0.0, 1e-3}});
        add_mesh(scene, "b far", quad_mesh(2.0F), {0.0, 0.9, 0.0});
        EXPECT_NEAR(draw(scene, few_pixels).pixel(3, 3)[0], 0.9, 1e-6) << "near one drawn first";
        scene.nodes.at("a near").transform = scene::Transform{.translation = {0.0, 0.0, -1e-3}};
        EXPECT_NEAR(draw(scene, few_pixels).pixel(3, 3)[1], 0.9, 1e-6) << "near one drawn last";
    }
}

}  // namespace
}  // namespace bruma::render
