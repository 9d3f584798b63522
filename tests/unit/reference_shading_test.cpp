// Shelf: closed form. A linear ramp of data has one gradient everywhere, so that its shading is one number.
#include <gtest/gtest.h>

#include <numbers>

#include "reference/volume/emission_absorption.h"
#include "reference_scenes.h"

namespace bruma::reference {
namespace {

/// Data that rises along x by one unit per sample, of constant extinction, clipped to where the gradient is constant.
scene::Scene ramp(glm::dvec3 spacing = glm::dvec3(0.05)) {
    auto scene = scene_with(grid_of(glm::ivec3(21), spacing, [](glm::ivec3 at) { return double(at.x); }),
                            uniform_extinction(4.0, {0.6, 0.4, 0.2}));
    volume_in(scene).clip = scene::ClipBox{glm::dvec3(0.1), glm::dvec3(0.9)};
    volume_in(scene).optics = scene::VolumeOptics{.lighting = scene::VolumeLighting::gradient};
    return scene;
}

const scene::Ray view{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 0.0};

/// Source radiance where it is the same along the whole ray.
glm::dvec3 source(const scene::Scene& scene, const scene::Ray& ray = view) {
    const RayResult result = trace(scene, ray);
    return result.radiance / (1.0 - result.transmittance);
}

void expect_near(glm::dvec3 a, glm::dvec3 b, double tolerance = 1e-9) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(a[channel], b[channel], tolerance);
    }
}

const glm::dvec3 color(0.6, 0.4, 0.2);

void set_light(scene::Scene& scene, glm::dvec3 direction) {
    scene.lights["sun"] =
        scene::Light{.direction_world = direction, .color = {1.0, 0.5, 0.25}, .intensity = 2.0 * std::numbers::pi};
}
const glm::dvec3 irradiance(2.0, 1.0, 0.5);  // over pi

void change(scene::Scene& scene, const std::function<void(scene::VolumeOptics&)>& edit) {
    volume_in(scene).optics.edit(edit);
}

TEST(ReferenceShading, DiffuseFollowsTheCosineOneAndTwoSided) {
    auto scene = ramp();
    change(scene, [](auto& optics) { optics.specular = 0.0; });
    // The data rises towards +x: the normal looks to -x.
    const double cosine = 0.6;
    for (const double side : {-1.0, 1.0}) {
        set_light(scene, {side * 3.0 * cosine, 0.0, 3.0 * 0.8});
        change(scene, [](auto& optics) { optics.two_sided = true; });
        expect_near(source(scene), color * (0.15 + 0.85 * irradiance * cosine));
        change(scene, [](auto& optics) { optics.two_sided = false; });
        expect_near(source(scene), color * (0.15 + 0.85 * irradiance * (side < 0.0 ? cosine : 0.0)));
    }
    // One-sided matter lit on the side of its normal shines the same when seen from behind.
    set_light(scene, {-1.0, 0.0, 0.0});
    expect_near(source(scene, ray_from({3.0, 0.0, 4.0}, {0.0, 0.0, 0.0})), color * (0.15 + 0.85 * irradiance));
    scene.lights["sun"].edit([](auto& light) { light.on = false; });
    expect_near(source(scene), color * 0.15);
}

TEST(ReferenceShading, HighlightsOfBlinnAndPhong) {
    auto scene = ramp();
    // The eye at 50 degrees from the normal -x, the light at 30 degrees on the other side.
    const auto at = [](double degrees) {
        return glm::dvec3(-std::cos(glm::radians(degrees)), 0.0, std::sin(glm::radians(degrees)));
    };
    const scene::Ray ray{5.0 * at(50.0), -at(50.0), 0.0};
    set_light(scene, at(-30.0));
    const double cosine = std::cos(glm::radians(30.0));
    const glm::dvec3 matt = color * (0.15 + 0.85 * irradiance * cosine);
    // Half vector at 10 degrees from the normal; mirrored light at 30, 20 degrees from the eye.
    expect_near(source(scene, ray), matt + 0.2 * irradiance * std::pow(std::cos(glm::radians(10.0)), 30.0));
    change(scene, [](auto& optics) { optics.highlight = scene::Highlight::phong; });
    expect_near(source(scene, ray), matt + 0.2 * irradiance * std::pow(std::cos(glm::radians(20.0)), 30.0));
    // From behind, both sides are lit alike, but the highlight belongs to the side that is seen: none.
    const scene::Ray behind{5.0 * at(140.0), -at(140.0), 0.0};
    expect_near(source(scene, behind), matt);
}

TEST(ReferenceShading, HeadlightShinesAlongTheViewAxis) {
    auto scene = ramp();
    scene.lights["sun"] = scene::Light{.kind = scene::LightKind::headlight};
    change(scene, [](auto& optics) { optics.specular = 0.0; });
    scene::Camera camera = **scene.camera;
    camera.eye_world = {-3.0, 0.0, 4.0};
    scene.camera.emplace(camera);
    expect_near(source(scene), color * (0.15 + 0.85 * 0.6));
}

TEST(ReferenceShading, PointLightFallsWithTheSquare) {
    auto scene = ramp();
    change(scene, [](auto& optics) { optics.specular = 0.0; });
    // So thin a slice that the light's distance, 2 m, is the same throughout: 1e-6 m of it changes 1/r^2 by 1e-6.
    volume_in(scene).clip = scene::ClipBox{{0.1, 0.1, 0.5}, {0.9, 0.9, 0.5 + 1e-6}};
    scene.lights["lamp"] = scene::Light{.kind = scene::LightKind::point,
                                        .position_world = {-1.2, 0.0, 1.6},
                                        .color = glm::dvec3(1.0),
                                        .intensity = 3.0 * std::numbers::pi};
    expect_near(source(scene), color * (0.15 + 0.85 * (3.0 / 4.0) * 0.6), 1e-5);
}

TEST(ReferenceShading, NormalsStandOnTheLevelSurfacesOfStretchedVolumes) {
    auto scene = ramp({0.05, 0.05, 0.2});
    scene.nodes["volume"].transform = scene::Transform{.rotation_deg = {20.0, 30.0, 50.0}, .scale = {1.0, 3.0, 0.5}};
    scene.nodes["volume"].parent = "stretch";
    scene.nodes["stretch"].transform = scene::Transform{.scale = {1.0, 2.5, 0.7}};
    change(scene, [](auto& optics) { optics.specular = 0.0; });
    set_light(scene, {0.2, 0.3, 0.9});
    // The level surface is spanned by the images of y and z.
    const glm::dmat4 world = scene::world_from_texture(scene, "volume");
    const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(world[1]), glm::dvec3(world[2])));
    const double cosine = std::abs(glm::dot(normal, glm::normalize(glm::dvec3(0.2, 0.3, 0.9))));
    expect_near(source(scene), color * (0.15 + 0.85 * irradiance * cosine));
}

TEST(ReferenceShading, SmallGradientsFadeSoftly) {
    auto scene = ramp();
    set_light(scene, {-1.0, 0.0, 0.0});
    // One unit per voxel of a range of 20: a share of 0.05. In the middle of the soft stretch the weight is 1/2.
    const auto with_soft = [&](double from, double to) {
        change(scene, [&](auto& optics) {
            optics.specular = 0.0;
            optics.gradient_soft_from = from;
            optics.gradient_soft_to = to;
        });
        return source(scene);
    };
    const glm::dvec3 shaded = color * (0.15 + 0.85 * irradiance);
    expect_near(with_soft(0.06, 0.07), color);
    expect_near(with_soft(0.04, 0.06), 0.5 * (color + shaded));
    expect_near(with_soft(0.01, 0.0499), shaded);
    expect_near(with_soft(0.0499, 0.0499), shaded);
    expect_near(with_soft(0.0501, 0.0501), color);
}

TEST(ReferenceShading, GradientIsOneSidedAtTheBorder) {
    // Two samples: everywhere one unit per voxel, the border's own difference, not half of it.
    auto scene = scene_with(grid_of({2, 2, 2}, glm::dvec3(0.5), [](glm::ivec3 at) { return double(at.x); }),
                            uniform_extinction(4.0, color));
    volume_in(scene).optics = scene::VolumeOptics{.lighting = scene::VolumeLighting::gradient,
                                                  .specular = 0.0,
                                                  .gradient_soft_from = 0.9,
                                                  .gradient_soft_to = 1.1};
    set_light(scene, {-1.0, 0.0, 0.0});
    expect_near(source(scene), 0.5 * color + 0.5 * color * (0.15 + 0.85 * irradiance));
}

TEST(ReferenceShading, EmissionIsNotShadedAndPlateausStayAsTheyAre) {
    auto scene = scene_with(homogeneous(glm::ivec3(1), glm::dvec3(1.0)), uniform_extinction(4.0, color));
    volume_in(scene).transfer_function.edit([](auto& tf) { tf.emission = {{0.0, 0.5}}; });
    volume_in(scene).optics = scene::VolumeOptics{
        .lighting = scene::VolumeLighting::gradient, .gradient_soft_from = 0.0, .gradient_soft_to = 0.0};
    set_light(scene, {-1.0, 0.0, 0.0});
    expect_near(source(scene), 1.5 * color);

    auto lit = ramp();
    volume_in(lit).transfer_function.edit([](auto& tf) { tf.emission = {{0.0, 0.5}}; });
    expect_near(source(lit), color * (0.15 + 0.5));
}

}  // namespace
}  // namespace bruma::reference
