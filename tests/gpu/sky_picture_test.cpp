// Shelf: independent reference, and closed forms where one is named. The sky as it is drawn, pixel by pixel.
#include <cmath>

#include "opaque_mesh.h"
#include "reference/sky/sky_preetham.h"
#include "scene/sky/sun_lamp.h"
#include "sky_scenes.h"

namespace bruma::render {
namespace {

class SkyPicture : public Drawing {};

const reference::AtmosphereTables& black_ground_tables() {
    static const reference::AtmosphereTables tables = [] {
        scene::Atmosphere air;
        air.ground_albedo = glm::dvec3(0.0);
        return reference::AtmosphereTables(air);
    }();
    return tables;
}

glm::dvec3 pixel_of(const Image& image, int x, int y) {
    const float* rgba = image.pixel(x, y);
    return {rgba[0], rgba[1], rgba[2]};
}

double largest_part(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Root mean square difference from the reference over the reference's mean.
double relative_rmse(const scene::Scene& scene, const Image& image, double sun_margin_rad) {
    const glm::dvec3 to_sun = scene::to_sun_world(*scene.outdoors->sun);
    const scene::Camera& camera = **scene.camera;
    double squares = 0.0, sum = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const scene::Ray ray = scene::camera_ray(camera, x + 0.5, y + 0.5, image.width, image.height);
            if (std::acos(std::min(1.0, glm::dot(ray.direction_world, to_sun))) < sun_margin_rad) {
                continue;
            }
            // The planet goes with the camera, and one metre is the lowest eye.
            glm::dvec3 from = ray.origin_world - glm::dvec3(camera.eye_world.x, 0.0, camera.eye_world.z);
            from.y = std::max(from.y, 1.0);
            const glm::dvec3 exact =
                reference::sky_path(black_ground_tables(), from, ray.direction_world, to_sun, 400).air.radiance;
            const glm::dvec3 apart = pixel_of(image, x, y) - exact;
            squares += glm::dot(apart, apart);
            sum += exact.x + exact.y + exact.z;
        }
    }
    return std::sqrt(squares * 3.0 * image.width * image.height) / sum;
}

void blacken_ground(scene::Scene& scene) {
    scene.outdoors->atmosphere.edit([](scene::Atmosphere& air) { air.ground_albedo = glm::dvec3(0.0); });
}

TEST_F(SkyPicture, IsTheReferenceFromTheGroundUp) {
    double worst = 0.0;
    for (const double altitude : {0.0, 2.0, 10e3, 100e3}) {
        for (const double elevation : {60.0, 8.0, 0.0, -5.0}) {
            scene::Scene scene = sky_scene(altitude, elevation, altitude > 20e3 ? -10.0 : 10.0);
            blacken_ground(scene);
            const double rmse = relative_rmse(scene, draw(scene, {36, 24}), 6.0 * rad);
            // Midpoints of 40 segments where the reference takes 400, and rows that are linear in between. The edge of
            // the planet's shadow falls between midpoints; by day 0.003 holds.
            EXPECT_LE(rmse, elevation > 0.0 ? 0.003 : 0.025) << altitude << " m, sun " << elevation;
            worst = std::max(worst, rmse);
        }
    }
    report("largest RMSE of the picture over its mean", worst);
}

TEST_F(SkyPicture, IsTheReferenceFromSpaceAndUnderParallelRays) {
    double worst = 0.0;
    for (const double altitude : {200e3, 3000e3}) {
        for (const double elevation : {50.0, -20.0}) {
            // At the limb, where the air is.
            const double limb = std::asin(reference::horizon_climb({}, altitude)) / rad;
            scene::Scene scene = sky_scene(altitude, elevation, limb, 20.0);
            blacken_ground(scene);
            const double rmse = relative_rmse(scene, draw(scene, {36, 24}), 6.0 * rad);
            // The edge of the planet's shadow falls between midpoints; by day 0.003 holds.
            EXPECT_LE(rmse, elevation > 0.0 ? 0.003 : 0.04) << altitude << " m, sun " << elevation;
            worst = std::max(worst, rmse);
        }
    }
    for (const double height : {1.0, 40e3}) {
        scene::Scene scene = sky_scene(30e3, 20.0, 5.0);
        scene.camera->edit([height](scene::Camera& camera) {
            camera.projection = scene::Projection::orthographic;
            camera.view_height = height;
        });
        blacken_ground(scene);
        const double rmse = relative_rmse(scene, draw(scene, {18, 12}), 0.0);
        EXPECT_LE(rmse, 0.003) << height;
        worst = std::max(worst, rmse);
    }
    report("largest RMSE of the marched picture over its mean", worst);
}

TEST_F(SkyPicture, GroundIsUnderSunAndSky) {
    // Closed form but for the sky's light on a plane.
    for (const double elevation : {50.0, 5.0, -2.0}) {
        scene::Scene scene = sky_scene(2.0, elevation, -80.0, 20.0);
        const scene::Atmosphere& air = *scene.outdoors->atmosphere;
        const glm::dvec3 to_sun = scene::to_sun_world(*scene.outdoors->sun);
        const reference::AtmosphereTables tables(air);
        const reference::SkyView view(tables, 1.0, to_sun, {192, 108}, 100);
        const glm::dvec3 expected =
            air.ground_albedo * std::numbers::inv_pi *
            (std::max(0.0, to_sun.y) * scene::sun_transmittance(air, 0.0, to_sun.y) + view.planar_irradiance());
        const glm::dvec3 found = pixel_of(draw(scene, {9, 9}), 4, 4);
        EXPECT_LE(largest_part((found - expected) / expected), 0.02) << elevation;
    }
}

TEST_F(SkyPicture, TheDiscKeepsTheSunsLight) {
    // Closed form: what the disc sends is the irradiance behind the air.
    for (const bool limb : {true, false}) {
        scene::Scene scene = sky_scene(2.0, 40.0, 40.0, 1.0);
        scene.outdoors->sun.edit([limb](scene::Sun& sun) {
            sun.azimuth_deg = 0.0;
            sun.limb_darkening = limb;
            sun.irradiance = {1.0, 2.0, 3.0};
        });
        const int edge = 64;
        const Image image = draw(scene, {edge, edge});
        const double pixel = 2.0 * std::tan(0.5 * rad) / edge;
        const glm::dvec3 beside = pixel_of(image, 0, 0);
        glm::dvec3 sum(0.0);
        for (int y = 0; y < edge; ++y) {
            for (int x = 0; x < edge; ++x) {
                sum += (pixel_of(image, x, y) - beside) * (pixel * pixel);
            }
        }
        const glm::dvec3 expected =
            scene.outdoors->sun->irradiance * scene::sun_transmittance({}, 2.0, std::sin(40.0 * rad));
        // The rim's darkest ring is drawn a pixel further in, 35 pixels from the middle.
        EXPECT_LE(largest_part(sum / expected - 1.0), 0.015);
        const glm::dvec3 middle = pixel_of(image, edge / 2, edge / 2);
        const int at = edge / 2 + int(0.8 * 0.26786 * edge);
        const glm::dvec3 rim = pixel_of(image, at, edge / 2);
        if (limb) {
            const double m = std::sqrt(1.0 - std::pow((at + 0.5 - 0.5 * edge) / (0.26786 * edge), 2.0));
            EXPECT_NEAR(rim.b / middle.b, std::pow(m, 0.652), 0.01);
            EXPECT_NEAR(rim.r / middle.r, std::pow(m, 0.397), 0.01);
        } else {
            EXPECT_NEAR(rim.b / middle.b, 1.0, 1e-3);
        }
    }
}

TEST_F(SkyPicture, TheDiscSetsAtTheHorizon) {
    scene::Scene scene = sky_scene(2.0, 0.0, 0.0, 2.0);
    scene.outdoors->sun.edit([](scene::Sun& sun) { sun.azimuth_deg = 0.0; });
    const Image image = draw(scene, {64, 64});
    EXPECT_GT(pixel_of(image, 32, 30).r, 30.0 * pixel_of(image, 10, 30).r) << "its upper half is seen";
    EXPECT_LT(pixel_of(image, 32, 36).r, 2.0 * pixel_of(image, 10, 36).r) << "its lower half is not";
}

/// Golden values of Preetham 1999 in the unit of the picture.
glm::dvec3 preetham_picture(const glm::dvec3& Yxy) {
    return glm::max(reference::rec709_from_Yxy(Yxy), 0.0) / 127.5;
}

TEST_F(SkyPicture, PreethamHasItsCheckValues) {
    struct Check {
        double view_elevation_deg, view_azimuth_deg;
        glm::dvec3 Yxy;
    };
    for (const Check& check :
         {Check{90.0, 0.0, {3.487327, 0.238013, 0.241988}}, Check{45.0, 0.0, {14.575902, 0.268477, 0.274622}},
          Check{45.0, 180.0, {3.885409, 0.231945, 0.240741}}}) {
        scene::Scene scene = sky_scene(2.0, 30.0);
        scene.outdoors->sky.edit([](scene::Sky& sky) { sky.model = scene::SkyModel::preetham; });
        scene.outdoors->sun.edit([](scene::Sun& sun) { sun.azimuth_deg = 0.0; });
        scene.camera->edit([&](scene::Camera& camera) {
            const double elevation = check.view_elevation_deg * rad, azimuth = check.view_azimuth_deg * rad;
            camera.target_world =
                camera.eye_world + glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                              -std::cos(elevation) * std::cos(azimuth));
            camera.vertical_angle_deg = 1.0;
        });
        const glm::dvec3 found = pixel_of(draw(scene, {3, 3}), 1, 1), expected = preetham_picture(check.Yxy);
        // Check values of six digits, and the exponentials of a GPU.
        EXPECT_LE(largest_part((found - expected) / expected.g), 3e-5) << check.view_elevation_deg;
    }
}

TEST_F(SkyPicture, ModelsForComparisonAreTheirReference) {
    for (const scene::SkyModel model : {scene::SkyModel::preetham, scene::SkyModel::look}) {
        for (const double elevation : {70.0, 10.0, 0.5, -3.0}) {
            scene::Scene scene = sky_scene(2.0, elevation, 40.0, 75.0);
            scene.outdoors->sky.edit([model](scene::Sky& sky) {
                sky.model = model;
                sky.turbidity = 4.0;
            });
            const glm::dvec3 to_sun = scene::to_sun_world(*scene.outdoors->sun);
            const reference::SkyBackground background(scene, {});
            const Image image = draw(scene, {24, 16});
            double least = 1e9, most = 0.0;
            for (int y = 0; y < image.height; ++y) {
                for (int x = 0; x < image.width; ++x) {
                    const scene::Ray ray =
                        scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, image.width, image.height);
                    if (std::acos(std::min(1.0, glm::dot(ray.direction_world, to_sun))) < 5.0 * rad) {
                        continue;  // the disc
                    }
                    const glm::dvec3 exact = background.radiance(ray, 20), found = pixel_of(image, x, y);
                    const double scale = found.g / exact.g;
                    least = std::min(least, scale);
                    most = std::max(most, scale);
                    ASSERT_LE(largest_part(found / scale - exact), 2e-4 * (largest_part(exact) + 1e-4))
                        << int(model) << " sun " << elevation << " at " << x << ", " << y;
                }
            }
            EXPECT_LE(most / least, 1.0 + 2e-4) << "one scale for the whole sky";
            // The scale is a ratio of sums over the sky by other midpoints.
            EXPECT_NEAR(0.5 * (least + most), 1.0, 0.03) << int(model) << " sun " << elevation;
        }
    }
}

TEST_F(SkyPicture, IsFiniteAndNeverNegative) {
    Renderer renderer(shaders());
    scene::Scene scene = sky_scene(0.0, 0.0, 0.0, 120.0);
    const auto expect_sound = [&](double altitude, double elevation, double look) {
        scene.outdoors->sun.edit([&](scene::Sun& sun) { sun.elevation_deg = elevation; });
        scene.camera->edit([&](scene::Camera& camera) {
            camera.eye_world.y = altitude;
            camera.target_world = camera.eye_world + glm::dvec3(0.0, std::sin(look * rad), -std::cos(look * rad)) *
                                                         std::max(1.0, std::abs(altitude));
            camera.projection = look == 1.0 ? scene::Projection::orthographic : scene::Projection::perspective;
            camera.view_height = 3e7;
        });
        renderer.render(scene, {{9, 8}, 1.0});
        const Image image = renderer.read_picture();
        ASSERT_TRUE(all_finite(image)) << altitude << " m, sun " << elevation << ", view " << look;
        for (const float value : image.rgba) {
            ASSERT_GE(value, 0.0F) << altitude << " m, sun " << elevation << ", view " << look;
            ASSERT_LE(value, 3e4F);
        }
    };
    for (const scene::SkyModel model :
         {scene::SkyModel::atmosphere, scene::SkyModel::preetham, scene::SkyModel::look}) {
        scene.outdoors->sky.edit([model](scene::Sky& sky) { sky.model = model; });
        for (const double altitude : {-5.0, 0.0, 1500.0, 99999.0, 100e3, 100001.0, 200e3, 1e9}) {
            for (const double elevation : {-90.0, -18.0, -0.27, 0.0, 0.1, 45.0, 90.0}) {
                for (const double look : {-90.0, 0.0, 1.0, 90.0}) {
                    expect_sound(altitude, elevation, look);
                }
            }
        }
    }
}

/// A wall across the view, at a distance, under the sky.
scene::Scene wall_scene(double distance, const glm::dvec3& color) {
    scene::Scene scene = sky_scene(50.0, 30.0, 0.0, 20.0);
    add_mesh(scene, "wall", quad_mesh(1.0F), color,
             {.translation = {0.0, 50.0, -distance}, .scale = glm::dvec3(distance)});
    return scene;
}

TEST_F(SkyPicture, AirStandsBeforeMeshes) {
    for (const double distance : {2.0, 800.0, 20e3}) {
        const scene::Scene scene = wall_scene(distance, glm::dvec3(0.0));
        const glm::dvec3 to_sun = scene::to_sun_world(*scene.outdoors->sun);
        const Image image = draw(scene, {9, 9});
        static const reference::AtmosphereTables tables(*scene.outdoors->atmosphere);
        double largest = 0.0;
        for (const int n : {0, 4, 8}) {
            const glm::dvec3 direction = scene::camera_ray(**scene.camera, n + 0.5, n + 0.5, 9, 9).direction_world;
            const glm::dvec3 exact = tables.air_light(50.0, direction, to_sun, distance / -direction.z, 500).radiance;
            largest = std::max(largest, largest_part((pixel_of(image, n, n) - exact) / exact));
        }
        // Midpoints of 2 km where the reference takes 40 m.
        EXPECT_LE(largest, 0.02) << distance;
        // The same wall in white is dimmed by what the air leaves.
        const glm::dvec3 white = pixel_of(draw(wall_scene(distance, glm::dvec3(1.0)), {9, 9}), 4, 4);
        const glm::dvec3 near = pixel_of(draw(wall_scene(2.0, glm::dvec3(1.0)), {9, 9}), 4, 4);
        const glm::dvec3 left = (white - pixel_of(image, 4, 4)) / near;
        const glm::dvec3 exact_left = tables.air_light(50.0, {0.0, 0.0, -1.0}, to_sun, distance, 500).transmittance;
        EXPECT_LE(largest_part(left - exact_left), 0.01) << distance;
    }
}

TEST_F(SkyPicture, SkyAndGroundKeepToThemselvesAtTheHorizon) {
    // Within a hundredth of a degree of the horizon, where rows that blend both sides are wrong by their difference.
    for (const double altitude : {2.0, 3000.0}) {
        const double dip = std::asin(reference::horizon_climb({}, altitude)) / rad;
        scene::Scene scene = sky_scene(altitude, 25.0, dip, 0.02);
        scene.outdoors->atmosphere.edit([](scene::Atmosphere& air) { air.ground_albedo = glm::dvec3(1.0); });
        const reference::SkyBackground sky(scene, {});
        const Image image = draw(scene, {4, 16});
        for (int y = 0; y < image.height; ++y) {
            const scene::Ray ray = scene::camera_ray(**scene.camera, 1.5, y + 0.5, image.width, image.height);
            const glm::dvec3 exact = sky.radiance(ray, 1000);
            EXPECT_LE(largest_part(pixel_of(image, 1, y) / exact - 1.0), 0.02) << altitude << " m, row " << y;
        }
    }
}

TEST_F(SkyPicture, MeshesAreLitBySunSkyAndGround) {
    // Closed form: a Lambert surface that sees more or less of a sky and a ground, with the sun on it or behind it.
    FrameGraph graph;
    SkyPasses passes(graph, shaders());
    for (const double azimuth : {180.0, 0.0}) {
        for (const double tilt_deg : {0.0, -60.0, 60.0}) {
            scene::Scene scene = wall_scene(2.0, glm::dvec3(0.5));
            scene.nodes.at("wall").transform.edit([tilt_deg](scene::Transform& t) { t.rotation_deg.x = tilt_deg; });
            scene.outdoors->sun.edit([azimuth](scene::Sun& sun) { sun.azimuth_deg = azimuth; });
            const glm::dvec3 found = pixel_of(draw(scene, {9, 9}), 4, 4);
            const scene::Light lamp = scene::sun_lamp(*scene.outdoors->sun, *scene.outdoors->atmosphere);
            passes.update(scene, {}, {8, 8});
            graph.run({passes.light.index});
            std::array<glm::vec4, 4> light{};
            graph.product(passes.light)->buffer.read<glm::vec4>(light);
            const glm::dvec3 normal(0.0, -std::sin(tilt_deg * rad), std::cos(tilt_deg * rad));
            const glm::dvec3 around = glm::mix(glm::dvec3(light[3]), glm::dvec3(light[2]), 0.5 + 0.5 * normal.y);
            const double cosine = std::max(0.0, glm::dot(lamp.direction_world, normal));
            const glm::dvec3 expected = 0.5 * (around + lamp.color * cosine * std::numbers::inv_pi);
            EXPECT_LE(largest_part(found / expected - 1.0), 2e-3) << "sun at " << azimuth << ", tilt " << tilt_deg;
        }
    }
}

}  // namespace
}  // namespace bruma::render
