// Shelf: closed form. Edges of meshes: how much of a pixel they cover, and what lies before and behind that share.
#include "kept_renderer.h"
#include "opaque_mesh.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::render {
namespace {

/// Area of a convex polygon within the unit square at `low`, by cutting it at the four sides.
double area_within(std::vector<glm::dvec2> polygon, glm::dvec2 low) {
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 == 0 ? 1.0 : -1.0;
        const double border = side % 2 == 0 ? low[axis] : -(low[axis] + 1.0);
        std::vector<glm::dvec2> cut;
        for (std::size_t n = 0; n < polygon.size(); ++n) {
            const glm::dvec2 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
            const double da = sign * a[axis] - border, db = sign * b[axis] - border;
            if (da >= 0.0) {
                cut.push_back(a);
            }
            if (da * db < 0.0) {
                cut.push_back(a + da / (da - db) * (b - a));
            }
        }
        polygon = cut;
    }
    double twice = 0.0;
    for (std::size_t n = 0; n < polygon.size(); ++n) {
        const glm::dvec2 a = polygon[n], b = polygon[(n + 1) % polygon.size()];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * std::abs(twice);
}

class MeshEdges : public KeptRenderer {
  protected:
    Image picture(scene::Scene& scene, glm::ivec2 pixels, int samples) {
        scene.rendering.edit([&](scene::RenderSettings& settings) { settings.samples = samples; });
        renderer->render(scene, {pixels, 1.0});
        return renderer->read_picture();
    }
};

struct CoverageError {
    double rms = 0.0, mean = 0.0;
};

TEST_F(MeshEdges, CoverAsMuchOfAPixelAsTheirArea) {
    const glm::ivec2 pixels(32, 32);
    CoverageError of[2];
    int edges = 0;
    for (const scene::Projection projection : both_projections) {
        for (const double angle : {0.0, 7.0, 20.0, 33.0, 45.0}) {
            scene::Scene scene = scene_seen_from(3.0, projection, 1.0);
            scene.environment = scene::Environment{.radiance = glm::dvec3(1.0)};
            const scene::Transform transform{.translation = {0.013, -0.021, 0.0}, .rotation_deg = {0.0, 0.0, angle}};
            add_mesh(scene, "quad", quad_mesh(0.3F), glm::dvec3(1.0), transform);
            std::vector<glm::dvec2> corners;
            for (const glm::dvec2 corner :
                 {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)}) {
                const glm::dvec4 p = scene::parent_from_model(transform) * glm::dvec4(double(0.3F) * corner, 0.0, 1.0);
                corners.emplace_back(16.0 + 32.0 * p.x, 16.0 - 32.0 * p.y);
            }
            const Image sampled[2] = {picture(scene, pixels, 4), picture(scene, pixels, 1)};
            for (int y = 0; y < 32; ++y) {
                for (int x = 0; x < 32; ++x) {
                    const double area = area_within(corners, {x, y});
                    for (int k = 0; k < 2; ++k) {
                        const float* const pixel = sampled[k].pixel(x, y);
                        EXPECT_NEAR(pixel[0], pixel[3], 1e-6) << "white before black";
                        if (area < 1e-9 || area > 1.0 - 1e-9) {
                            EXPECT_EQ(pixel[3], area < 0.5 ? 0.0F : 1.0F);
                            continue;
                        }
                        const double error = pixel[3] - area;
                        of[k].rms += error * error;
                        of[k].mean += error;
                        edges += k;
                    }
                }
            }
        }
    }
    for (CoverageError& error : of) {
        error.rms = std::sqrt(error.rms / edges);
        error.mean /= edges;
    }
    report("edge pixels, RMS error of the share that is covered, 4 samples", of[0].rms);
    report("edge pixels, RMS error of the share that is covered, 1 sample", of[1].rms);
    // Steps of a quarter alone are off by 1 / (4 sqrt 12) = 0.07, steps of one by 0.29.
    EXPECT_LT(of[0].rms, 0.12);
    EXPECT_GT(of[1].rms, 0.2);
    EXPECT_NEAR(of[0].mean, 0.0, 0.02);
}

/// Test 22 of a quad in a slab, where the quad covers a share of the pixel only.
TEST_F(MeshEdges, MatterIsBeforeAndBehindTheShareThatIsCovered) {
    const glm::ivec2 pixels(15, 15);
    const glm::dvec3 source(1.0, 0.5, 0.25);
    const double sigma = 3.0;
    double worst = 0.0;
    int halves = 0;
    for (const scene::Projection projection : both_projections) {
        for (const bool backed : {false, true}) {
            scene::Scene scene =
                scene_with(homogeneous({16, 16, 61}, {1.0, 1.0, 0.6}), uniform_extinction(sigma, source));
            scene.camera = scene_seen_from(3.0, projection, 0.5).camera;
            scene.background = scene::Background{.top = glm::dvec3(7.0), .bottom = glm::dvec3(7.0)};
            settle(scene, Classification::preintegrated, 0.7);
            const double z_near = 0.1137, z_far = -0.11;
            add_mesh(scene, "near", quad_mesh(0.13F), glm::dvec3(0.0),
                     {.translation = {0.0, 0.0, z_near}, .rotation_deg = {0.0, 0.0, 30.0}});
            if (backed) {
                add_mesh(scene, "far", quad_mesh(3.0F), glm::dvec3(0.0), {.translation = {0.0, 0.0, z_far}});
            }
            const Image image = picture(scene, pixels, 4);
            // How much of a pixel the near quad covers: by its picture alone, white before black.
            scene::Scene alone = scene;
            alone.nodes.erase("volume");
            alone.nodes.erase("far");
            alone.background = scene::Background{};
            const Image covered = picture(alone, pixels, 4);
            for (int y = 0; y < pixels.y; ++y) {
                for (int x = 0; x < pixels.x; ++x) {
                    const scene::Ray ray = scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, pixels.x, pixels.y);
                    const double stretch = -1.0 / ray.direction_world.z;
                    const auto alpha_from = [&](double z) { return -std::expm1(-sigma * (0.3 - z) * stretch); };
                    const double share = covered.pixel(x, y)[3];
                    const double beyond = alpha_from(backed ? z_far : -0.3);
                    halves += share > 0.0 && share < 1.0 ? 1 : 0;
                    for (int k = 0; k < 3; ++k) {
                        const double expected =
                            share * alpha_from(z_near) * source[k] +
                            (1.0 - share) * (beyond * source[k] + (backed ? 0.0 : 7.0 * (1.0 - beyond)));
                        worst = std::max(worst, std::abs(image.pixel(x, y)[k] - expected));
                    }
                }
            }
        }
    }
    report("quad over a share of a pixel in a slab, largest error", worst);
    EXPECT_GT(halves, 40);
    // Rounding of distances of some 300 steps, times 0.02 of optical depth per step, times a background of 7.
    EXPECT_LE(worst, 7e-5);
}

/// Squared errors of the pixels at outlines, beside the mean of 8 x 8 finer ones.
struct OutlineErrors {
    double smooth = 0.0, rough = 0.0;
    int pixels = 0;
};

/// Shelf: the same picture, eight times as fine in both directions.
TEST_F(MeshEdges, AreNearerToAFinerPicture) {
    scene::MeshSource source;
    source.millimetres_per_unit = 40.0;
    const auto knot = scene::builtin_mesh("mesh-knot", source).mesh;
    const glm::ivec2 pixels(40, 40);
    for (const std::string behind : {"a background", "a volume around it", "a sky"}) {
        scene::Scene scene;
        if (behind == "a volume around it") {
            scene = scene_with(homogeneous({16, 16, 16}, glm::dvec3(1.0)), uniform_extinction(1.5, {0.2, 0.4, 0.6}));
            settle(scene, Classification::preintegrated, 0.5);
        }
        add_mesh(scene, "knot", knot, {0.9, 0.8, 0.6});
        const double size = glm::length((*std::get<scene::Mesh>(scene.nodes.at("knot").content).triangles)->high);
        scene.nodes.at("knot").transform = scene::Transform{.scale = glm::dvec3(0.4 / size)};
        scene.lights["key"] = scene::Light{.direction_world = {0.3, 1.0, 0.6}};
        scene.environment = scene::Environment{.radiance = glm::dvec3(0.2)};
        scene.background = scene::Background{.top = {0.1, 0.2, 0.5}, .bottom = {0.5, 0.4, 0.3}};
        if (behind == "a sky") {
            scene.outdoors.emplace();
            scene.outdoors->sun = scene::Sun{.elevation_deg = 30.0, .azimuth_deg = 30.0};
        }
        scene.camera = oblique_camera(scene);
        const Image fine = picture(scene, 8 * pixels, 1);
        const Image smooth = picture(scene, pixels, 4), rough = picture(scene, pixels, 1);
        OutlineErrors errors;
        scene::Scene alone = scene;  // tells where outlines are
        alone.nodes.erase("volume");
        const Image covered = picture(alone, 8 * pixels, 1);
        for (int y = 0; y < pixels.y; ++y) {
            for (int x = 0; x < pixels.x; ++x) {
                glm::dvec3 mean(0.0);
                double share = 0.0;
                for (int n = 0; n < 64; ++n) {
                    const float* const p = fine.pixel(8 * x + n % 8, 8 * y + n / 8);
                    mean += glm::dvec3(p[0], p[1], p[2]) / 64.0;
                    share += covered.pixel(8 * x + n % 8, 8 * y + n / 8)[3] / 64.0;
                }
                if (share <= 0.0 || share >= 1.0) {
                    continue;
                }
                ++errors.pixels;
                for (int k = 0; k < 3; ++k) {
                    errors.smooth += std::pow(smooth.pixel(x, y)[k] - mean[k], 2.0);
                    errors.rough += std::pow(rough.pixel(x, y)[k] - mean[k], 2.0);
                }
            }
        }
        EXPECT_GT(errors.pixels, 60);
        report("outlines before " + behind + ", RMSE, 4 samples", std::sqrt(errors.smooth / (3 * errors.pixels)));
        report("outlines before " + behind + ", RMSE, 1 sample", std::sqrt(errors.rough / (3 * errors.pixels)));
        // A quarter of the step would be a quarter of the error; outlines cross and curve within pixels.
        EXPECT_LT(errors.smooth, 0.25 * errors.rough) << behind;
    }
}

TEST_F(MeshEdges, WithinASurfaceNoBitChanges) {
    scene::Scene scene = scene_seen_from(3.0, scene::Projection::perspective, 1.0);
    scene.environment = scene::Environment{.radiance = glm::dvec3(0.3, 0.7, 1.1)};
    add_mesh(scene, "quad", quad_mesh(2.0F), {0.1, 0.7, 0.3}, {.rotation_deg = {30.0, 20.0, 10.0}});
    EXPECT_TRUE(same_bits(picture(scene, {31, 31}, 1), picture(scene, {31, 31}, 4)));
}

}  // namespace
}  // namespace bruma::render
