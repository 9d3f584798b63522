// Shelf: reference, for light of the matter's own and for surfaces lit by the gradient.
#include <cmath>

#include "drawing.h"
#include "measure/metrics/image_error.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

void add_lights(scene::Scene& scene, double length) {
    scene.lights["key"] = scene::Light{.direction_world = {-0.55, 0.8, 0.55}, .color = {1.0, 0.9, 0.7}};
    scene.lights["point"] = scene::Light{.kind = scene::LightKind::point,
                                         .position_world = length * glm::dvec3(0.9, -0.6, 1.1),
                                         .color = {0.4, 0.6, 1.0},
                                         .intensity = 1.5 * length * length};
    scene.lights["spot"] = scene::Light{.kind = scene::LightKind::spot,
                                        .direction_world = {-0.6, 0.2, 1.0},
                                        .position_world = length * glm::dvec3(-0.9, 0.3, 1.5),
                                        .spot_softness = 0.8,
                                        .color = {1.0, 0.3, 0.6},
                                        .intensity = 2.0 * length * length};
    scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight, .intensity = 0.6};
    scene.lights["off"] = scene::Light{.intensity = 50.0, .on = false};
}

std::shared_ptr<const scene::VolumeGrid> wavy(glm::ivec3 size, glm::dvec3 extent) {
    return grid_of(size, extent / glm::dvec3(size), [&](glm::ivec3 at) {
        const glm::dvec3 x = (glm::dvec3(at) + 0.5) / glm::dvec3(size);
        return 0.5 + 0.2 * std::sin(5.0 * x.x + 1.0) + 0.2 * std::cos(4.0 * x.y) * std::sin(3.0 * x.z + 0.5);
    });
}

scene::TransferFunction soft_transfer_function(double reference_length) {
    scene::TransferFunction tf;
    tf.reference_length = reference_length;
    tf.opacity = {{0.2, 0.0}, {0.8, 0.5}};
    tf.color = {{0.1, {0.9, 0.3, 0.1}}, {0.9, {0.2, 0.5, 1.0}}};
    return tf;
}

TEST_F(Drawing, OwnLightWithAndWithoutLamps) {
    scene::Scene scene = scene_with(wavy(glm::ivec3(24), glm::dvec3(1.0)), soft_transfer_function(0.2));
    volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) {
        tf.emission = {{0.3, 0.0}, {0.6, 2.0}, {0.9, 0.0}};
    });
    scene.camera = oblique_camera(scene);
    for (const bool with_lamps : {false, true}) {
        if (with_lamps) {
            add_lights(scene, 1.0);
            volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
        }
        const Image expected = truth(scene, {48, 48});
        for (const Classification classification : both_classifications) {
            settle(scene, classification, 0.25);
            const measure::ImageError error = measure::compare_images(draw(scene, {48, 48}), expected);
            report(std::string("RMSE of own light, ") + (with_lamps ? "lit, " : "unlit, ") + name_of(classification),
                   error.rmse);
            // Measured 1.8e-5 to 2.8e-5, of second order in the step; own light lit as well, or twice, differs by 0.1.
            EXPECT_LE(error.rmse, 6e-5);
        }
    }
}

TEST_F(Drawing, GradientShadingOfSphereAndMarschnerLobb) {
    struct Case {
        const char* name;
        double tolerance;  // measured: up to 4.4e-6 and 1.1e-3, where a highlight has normals that turn within a voxel
    };
    for (const Case& c : {Case{"sphere", 1e-5}, Case{"marschner-lobb", 1.6e-3}}) {
        const auto grid = scene::builtin_volume(c.name);
        scene::Scene scene = scene_with(grid, scene::suggested_transfer_function(*grid));
        scene.camera = oblique_camera(scene);
        add_lights(scene, grid->extent().x);
        for (const scene::Highlight highlight : {scene::Highlight::phong, scene::Highlight::blinn_phong}) {
            for (const bool two_sided : {false, true}) {
                volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) {
                    lit(optics).highlight = highlight;
                    optics.two_sided = two_sided;
                });
                const Image expected = truth(scene, {64, 64}, 1e-5);
                double cover = 0.0;
                for (std::size_t n = 0; n < expected.pixel_count(); ++n) {
                    cover += expected.rgba[4 * n + 3] / double(expected.pixel_count());
                }
                EXPECT_GT(cover, 0.05) << "else there is hardly anything to compare";
                for (const Classification classification : both_classifications) {
                    settle(scene, classification, 0.25);
                    const measure::ImageError error = measure::compare_images(draw(scene, {64, 64}), expected);
                    report(std::string("RMSE of ") + c.name + ", " +
                               (highlight == scene::Highlight::phong ? "phong, " : "blinn, ") +
                               (two_sided ? "two sides, " : "one side, ") + name_of(classification),
                           error.rmse);
                    EXPECT_LE(error.rmse, c.tolerance);
                }
            }
        }
    }
}

TEST_F(Drawing, NormalsOfStretchedVoxels) {
    // A plane of data that leans in all three axes of the world, stored with spacing 1:1:4: one normal everywhere.
    const glm::dvec3 spacing = glm::dvec3(1.0, 1.0, 4.0) / 32.0;
    const auto grid = grid_of({32, 32, 8}, spacing, [&](glm::ivec3 at) {
        return glm::dot(glm::dvec3(at) * spacing, glm::dvec3(0.3, 0.4, 0.3));
    });
    scene::Scene scene = scene_with(grid, uniform_extinction(3.0, {0.8, 0.6, 0.4}));
    volume_in(scene).clip = scene::ClipBox{glm::dvec3(0.15), glm::dvec3(0.85)};
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    scene.lights["key"] = scene::Light{.direction_world = {-0.2, 0.3, 1.0}};
    scene.camera = oblique_camera(scene);
    const Image expected = truth(scene, {24, 24});
    for (const Classification classification : both_classifications) {
        settle(scene, classification, 1.0);
        const double difference = largest_difference(draw(scene, {24, 24}), expected);
        report(std::string("largest difference with normals of stretched voxels, ") + name_of(classification),
               difference);
        // Measured 1.9e-4: the 16 bits of the stored gradients. Without the inverse transpose it would be some 0.1.
        EXPECT_LE(difference, 4e-4);
    }
}

TEST_F(Drawing, Test19StretchedVoxelsEqualEvenOnes) {
    const glm::dvec3 extent(1.0);
    for (const bool with_lamps : {false, true}) {
        for (const Classification classification : both_classifications) {
            Image images[2];
            for (int n = 0; n < 2; ++n) {
                scene::Scene scene = scene_with(wavy({64, 64, n == 0 ? 16 : 64}, extent), soft_transfer_function(0.2));
                volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) { tf.window = {0.0, 1.0}; });
                scene.camera = oblique_camera(scene);
                if (with_lamps) {
                    add_lights(scene, 1.0);
                    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
                }
                settle(scene, classification, 0.5);
                images[n] = draw(scene, {48, 48});
            }
            const measure::ImageError error = measure::compare_images(images[0], images[1]);
            report(std::string("RMSE of 1:1:4 beside 1:1:1, ") + (with_lamps ? "lit, " : "unlit, ") +
                       name_of(classification),
                   error.rmse);
            EXPECT_LE(error.rmse, 0.02) << "2 % on smooth data";
        }
    }
}

}  // namespace
}  // namespace bruma::render
