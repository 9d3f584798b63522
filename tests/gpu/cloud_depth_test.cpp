// Shelf: independent reference. Clouds in one scene with meshes: rays end at surfaces, whichever is in front.
#include "cloud_scenes.h"
#include "opaque_mesh.h"
#include "reference/clouds/cloud_march.h"
#include "reference/clouds/render_clouds.h"

namespace bruma::render {
namespace {

class CloudDepth : public Drawing {
  protected:
    /// The picture's middle with a glowing wall across the view at a distance.
    glm::dvec3 seen_with_wall(double distance_m) {
        scene::Scene walled = scene;
        add_wall(walled, distance_m);
        const Image image = draw(walled, pixels);
        const float* middle = image.pixel(pixels.x / 2, pixels.y / 2);
        return {middle[0], middle[1], middle[2]};
    }
    static void add_wall(scene::Scene& walled, double distance_m) {
        const scene::Camera& camera = **walled.camera;
        const glm::dvec3 back = scene::camera_frame(camera).back_world;
        const double azimuth = glm::degrees(std::atan2(back.x, back.z));
        add_mesh(walled, "wall", quad_mesh(float(distance_m)), glm::dvec3(0.5),
                 {.translation = camera.eye_world - distance_m * back, .rotation_deg = {0.0, azimuth, 0.0}});
    }
    glm::dvec3 exact_with_wall(double distance_m, const glm::dvec3& wall) {
        const scene::Clouds& clouds = clouds_in(scene);
        const reference::CloudMedium media[] = {reference::medium_of(
            reference::CloudField(*clouds.layer, *clouds.map, reference::normative_cloud_noise(), 0.0),
            reference::CloudGeometry(*clouds.layer, (*scene.camera)->eye_world, 6360e3), *clouds.optics)};
        const scene::Ray ray =
            scene::camera_ray(**scene.camera, pixels.x / 2 + 0.5, pixels.y / 2 + 0.5, pixels.x, pixels.y);
        const auto found =
            reference::march_once(media, reference::cloud_light(scene), ray, 4.0, 64, {.longest_m = distance_m});
        transmittance = found.transmittance;
        return found.radiance + found.transmittance * wall;
    }

    static constexpr glm::ivec2 pixels{33, 33};
    scene::Scene scene;
    double transmittance = 1.0;
};

TEST_F(CloudDepth, RaysEndAtMeshes) {
    scene = cloud_scene(scene::CloudType::stratus, CloudView::inside);
    scene.camera->edit([](scene::Camera& camera) { camera.target_world.y = camera.eye_world.y; });
    clouds_in(scene).march.edit([](scene::CloudMarch& march) {
        march.jitter = scene::Jitter::off;
        march.step_m = 10.0;
    });
    scene::Scene clear = scene;
    clear.nodes.at("sky").visible = false;
    scene::Scene kept = scene;
    for (const double distance : {50.0, 300.0, 1500.0}) {
        scene = clear;
        const glm::dvec3 wall = seen_with_wall(distance);
        scene = kept;
        const glm::dvec3 found = seen_with_wall(distance);
        const glm::dvec3 exact = exact_with_wall(distance, wall);
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(found[k], exact[k], 0.01) << distance << " m";
        }
        report("transmittance up to the wall", transmittance);
    }
}

}  // namespace
}  // namespace bruma::render
