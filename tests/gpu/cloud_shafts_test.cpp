// Shelf: independent reference. Air and ground in the shadows of clouds: what pictures lose by them against the same
// integral in double precision, with the straight optical depth towards the sun at every step of the ray.
#include <algorithm>

#include "cloud_scenes.h"
#include "kept_renderer.h"
#include "opaque_mesh.h"
#include "reference/clouds/render_clouds.h"

namespace bruma::render {
namespace {

class CloudShafts : public KeptRenderer {
  protected:
    struct Ray {
        double eye_m, view_elevation_deg, view_azimuth_deg, sun_elevation_deg;
    };
    /// A picture of one cell of the shafts' grid, so narrow that it is one ray.
    static scene::Scene scene_of(scene::CloudType type, const Ray& ray) {
        scene::Scene scene = scene::clouds_under_sky_scene();
        clouds_in(scene) = scene::preset_clouds(type);
        scene::make_missing_map(clouds_in(scene));
        clouds_in(scene).march.edit([](scene::CloudMarch& march) { march.grid_columns = 192; });
        scene.outdoors->sun.edit([&](scene::Sun& sun) { sun.elevation_deg = ray.sun_elevation_deg; });
        scene.camera->edit([&](scene::Camera& camera) {
            const double elevation = glm::radians(ray.view_elevation_deg), azimuth = glm::radians(ray.view_azimuth_deg);
            camera.eye_world = {0.0, ray.eye_m, 0.0};
            camera.target_world =
                camera.eye_world + glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                              -std::cos(elevation) * std::cos(azimuth));
            camera.vertical_angle_deg = 0.05;
        });
        return scene;
    }
    /// What the picture loses when the air lies in shadows.
    glm::dvec3 found(scene::Scene scene) {
        glm::dvec3 lost(0.0);
        for (const bool shafts : {false, true}) {
            scene.outdoors->sky.edit([&](scene::Sky& sky) { sky.shafts = shafts; });
            renderer->render(scene, {pixels, 1.0});
            const Image image = renderer->read_picture();
            EXPECT_TRUE(all_finite(image));
            const float* const rgba = image.pixel(2, 2);
            lost += (shafts ? -1.0 : 1.0) * glm::dvec3(rgba[0], rgba[1], rgba[2]);
        }
        return lost;
    }
    struct Exact {
        glm::dvec3 lost{0.0};
        glm::dvec3 lit{0.0};         ///< radiance of all the air, without clouds
        glm::dvec3 lit_ground{0.0};  ///< of the ground under the sun alone, as it is seen
    };
    /// For a ray that ends at `end_m`: before the clouds, at their mean distance, and behind them.
    Exact exact(scene::Scene& scene, double end_m) const {
        const scene::Camera& camera = **scene.camera;
        const scene::Atmosphere& atmosphere = *scene.outdoors->atmosphere;
        const std::vector<reference::CloudMedium> media{reference::medium_of(
            exact_field(scene),
            reference::CloudGeometry(*clouds_in(scene).layer, camera.eye_world, atmosphere.planet_radius_m),
            *clouds_in(scene).optics)};
        const reference::CloudSky sky(scene, {});
        const scene::Ray ray = scene::camera_ray(camera, 2.5, 2.5, pixels.x, pixels.y);
        const double longest = clouds_in(scene).march->reach_m;
        const auto lit = sky.air_along(ray, longest), shaded = sky.air_along(ray, longest, media, 48);
        const auto missing = [&](double distance) { return lit(distance).radiance - shaded(distance).radiance; };
        const double end = std::min(std::min(end_m, longest),
                                    media.front().geometry.ground_distance(ray.origin_world, ray.direction_world));
        // By what the picture holds of the clouds themselves, which other tests judge.
        const CloudPicture& clouds = *renderer->cloud_pictures().front();
        std::vector<float> radiance(std::size_t(4) * pixels.x * pixels.y), distance(radiance.size() / 4);
        clouds.radiance.download({GL_RGBA, GL_FLOAT}, radiance.size() * sizeof(float), radiance.data());
        clouds.distance.download({GL_RED, GL_FLOAT}, distance.size() * sizeof(float), distance.data());
        const std::size_t middle = std::size_t(pixels.y - 1 - 2) * pixels.x + 2;
        const double passed = radiance[4 * middle + 3];
        glm::dvec3 lost = (1.0 - passed) * missing(distance[middle]) + passed * missing(end), ground(0.0);
        if (end < std::min(end_m, longest)) {
            const glm::dvec3 to_sun = sky.light().to_sun_world;
            const glm::dvec3 at = ray.origin_world + end * ray.direction_world;
            const glm::dvec3 center(camera.eye_world.x, -atmosphere.planet_radius_m, camera.eye_world.z);
            const double climb = glm::dot(glm::normalize(at - center), to_sun);
            ground = lit(end).transmittance * scene.outdoors->sun->irradiance * atmosphere.ground_albedo /
                     glm::pi<double>() * climb * reference::AtmosphereTables(atmosphere).sun_transmittance(0.0, climb);
            const double depth = reference::optical_depth(media, at, to_sun, 192);
            lost +=
                passed * ground * (1.0 - reference::light_on_ground_below_clouds(depth, climb, media.front().optics));
        }
        return {lost, lit(end).radiance, ground};
    }
    static double largest(const glm::dvec3& v) { return std::max({v.r, v.g, v.b}); }

    static constexpr glm::ivec2 pixels{4, 4};
};

TEST_F(CloudShafts, LoseWhatTheDoublePrecisionIntegralSays) {
    const std::pair<scene::CloudType, Ray> cases[] = {
        {scene::CloudType::cumulus, {2.0, 12.0, 0.0, 38.0}},
        {scene::CloudType::cumulus, {2.0, 4.0, 0.0, 10.0}},
        {scene::CloudType::cumulus, {2.0, 25.0, -25.0, 10.0}},
        {scene::CloudType::cumulus, {20e3, -30.0, 40.0, 10.0}},
        {scene::CloudType::stratocumulus, {2.0, 8.0, 0.0, 20.0}},
    };
    double squares = 0.0, most_lost = 0.0;
    for (const auto& [type, ray] : cases) {
        scene::Scene scene = scene_of(type, ray);
        const glm::dvec3 lost = found(scene);
        const Exact truth = exact(scene, 1e30);
        const double apart = largest(glm::abs(lost - truth.lost)) / largest(truth.lit);
        // Of the light of the lit air. Columns of 208 m blur the rims, steps at 100 km are as long as clouds.
        EXPECT_LE(apart, 0.012) << ray.eye_m << " m, view " << ray.view_elevation_deg << " deg, sun "
                                << ray.sun_elevation_deg;
        squares += apart * apart / double(std::size(cases));
        most_lost = std::max(most_lost, largest(truth.lost) / largest(truth.lit));
        report("lost share of the air's light", largest(truth.lost) / largest(truth.lit));
        report("difference from double precision", apart);
    }
    EXPECT_LE(std::sqrt(squares), 0.006);
    EXPECT_GE(most_lost, 0.2) << "there is something to lose";
}

TEST_F(CloudShafts, TheGroundOfTheSkyLiesInThem) {
    // Down from below the clouds, where there is little air before the ground.
    double squares = 0.0, lost_share = 0.0;
    int rays = 0;
    for (const double sun : {60.0, 20.0}) {
        for (double azimuth = 0.0; azimuth < 360.0; azimuth += 45.0) {
            scene::Scene scene = scene_of(scene::CloudType::cumulus, {500.0, -6.0, azimuth, sun});
            const glm::dvec3 lost = found(scene);
            const Exact truth = exact(scene, 1e30);
            const double apart = largest(glm::abs(lost - truth.lost)) / largest(truth.lit_ground);
            squares += apart * apart;
            lost_share += largest(truth.lost) / largest(truth.lit_ground);
            ++rays;
        }
    }
    report("lost share of the sun's light on the ground, mean", lost_share / rays);
    report("difference from double precision, RMS", std::sqrt(squares / rays));
    EXPECT_GE(lost_share / rays, 0.15) << "there is something to lose";
    // Columns of 104 m blur the rims of shadows.
    EXPECT_LE(std::sqrt(squares / rays), 0.02);
}

TEST_F(CloudShafts, EndAtSurfaces) {
    // A plate across the ray 6 km away: only the air before it can be dark.
    const Ray ray{2.0, 8.0, 0.0, 12.0};
    scene::Scene scene = scene_of(scene::CloudType::cumulus, ray);
    const glm::dvec3 ahead = (*scene.camera)->target_world - (*scene.camera)->eye_world;
    add_mesh(scene, "plate", quad_mesh(2000.0F), glm::dvec3(0.0),
             {.translation = (*scene.camera)->eye_world + 6000.0 * ahead});
    const glm::dvec3 lost = found(scene);
    const Exact truth = exact(scene, 6000.0);
    EXPECT_LE(largest(glm::abs(lost - truth.lost)), 0.012 * largest(truth.lit));
    scene.nodes.at("plate").visible = false;
    EXPECT_LT(largest(lost), 0.5 * largest(found(scene))) << "less than without it";
}

}  // namespace
}  // namespace bruma::render
