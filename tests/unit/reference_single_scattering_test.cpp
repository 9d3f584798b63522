// Shelf: closed form. Light scattered once, where it can be written down; and laws that hold in any medium.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "reference/medium/single_scattering.h"
#include "reference/phase_function.h"
#include "reference/volume/transmittance.h"
#include "reference_scattering_scenes.h"

namespace bruma::reference {
namespace {

glm::dvec3 scattered_once(const scene::Scene& scene, const scene::Ray& ray, double tolerance = 1e-8) {
    const ScatteringScene media(scene);
    return SingleScattering(media, tolerance).trace(ray).radiance;
}

const scene::Ray down{{0.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 0.0};

TEST(ReferenceSingleScattering, SlabLitFromTheSideOfTheEye) {
    // L = w p E / (mu_v k) (1 - exp(-sigma H k)), k = 1 / mu_v + 1 / mu_l; sigma H = 3, w = 0.8, g = 0.3, E = 1. The
    // numbers were computed apart.
    auto scene = slab_scene(3.0, 0.8, 0.3);
    const auto radiance = [&](double cosine_light) {
        scene.lights["sun"] = scene::Light{
            .direction_world = {std::sqrt(1.0 - cosine_light * cosine_light), 0.0, cosine_light}, .intensity = 1.0};
        return scattered_once(scene, down);
    };
    EXPECT_NEAR(radiance(1.0).x, 0.013151752, 1e-9);
    EXPECT_NEAR(radiance(0.5).y, 0.011782148, 1e-9);
    for (const double cosine : {0.05, 0.3, 0.9}) {
        const double k = 1.0 + 1.0 / cosine;
        const double expected = 0.8 * henyey_greenstein(-cosine, 0.3) / k * -std::expm1(-3.0 * k);
        EXPECT_NEAR(radiance(cosine).z, expected, 1e-8) << cosine;
    }
}

TEST(ReferenceSingleScattering, SlabLitFromBehind) {
    // Through the slab straight on every path is as long: L = w p E sigma H exp(-sigma H).
    auto scene = slab_scene(2.0, 0.6, -0.4);
    scene.lights["sun"] = scene::Light{.direction_world = {0.0, 0.0, -3.0}, .intensity = 5.0};
    EXPECT_NEAR(scattered_once(scene, down).x, 0.6 * henyey_greenstein(1.0, -0.4) * 5.0 * 2.0 * std::exp(-2.0), 1e-7);
}

TEST(ReferenceSingleScattering, PointLightInThinMatter) {
    // Without extinction to speak of: L = sigma p I integral of dt / r^2 = sigma I / (4 pi) (angle seen) / distance.
    const double sigma = 1e-9;
    auto scene = scene_with(homogeneous(glm::ivec3(3), glm::dvec3(2.0)), uniform_extinction(sigma));
    let_scatter(scene, 1.0, 0.0);
    for (const double aside : {0.5, 0.01, 1e-4}) {
        scene.lights["lamp"] = lamp({aside, 0.0, 0.25}, 7e9);
        const double angle = std::atan(0.75 / aside) + std::atan(1.25 / aside);
        const double expected = sigma * 7e9 / (4.0 * std::numbers::pi) * angle / aside;
        EXPECT_NEAR(scattered_once(scene, down).x / expected, 1.0, 1e-6) << aside;
    }
}

TEST(ReferenceSingleScattering, SpotShinesInItsConeOnly) {
    auto scene = slab_scene(1.0, 1.0, 0.0);
    auto spot = lamp({0.0, 0.0, 3.0});
    spot.kind = scene::LightKind::spot;
    spot.direction_world = {0.0, 0.0, 1.0};
    spot.spot_angle_deg = 10.0;
    spot.spot_softness = 0.0;
    scene.lights["spot"] = spot;
    const glm::dvec3 inside = scattered_once(scene, down);
    EXPECT_EQ(scattered_once(scene, {{2.0, 0.0, 5.0}, {0.0, 0.0, -1.0}, 0.0}), glm::dvec3(0.0));
    spot.kind = scene::LightKind::point;
    scene.lights["spot"] = spot;
    EXPECT_NEAR(inside.x, scattered_once(scene, down).x, 1e-7);
}

TEST(ReferenceSingleScattering, VolumesShadowEachOther) {
    // The plate hangs between the sun and the slab, beside the ray to the eye; it is 0.5 m thick.
    auto scene = slab_scene(3.0, 0.8, 0.0);
    scene.lights["sun"] = sun({1.0, 0.0, 1.0});
    const glm::dvec3 lit = scattered_once(scene, down);
    scene.nodes["plate"] = scene.nodes["volume"];
    volume_in(scene, "plate").grid = homogeneous({2, 3, 4}, {4.0, 4.0, 0.5});
    volume_in(scene, "plate").transfer_function = uniform_extinction(1.3, glm::dvec3(0.0));
    scene.nodes["plate"].transform = scene::Transform{.translation = {3.0, 0.0, 3.0}};
    for (const auto lighting : {scene::VolumeLighting::none, scene::VolumeLighting::shadow_rays}) {
        volume_in(scene, "plate").optics = scene::VolumeOptics{.lighting = lighting};
        EXPECT_NEAR(scattered_once(scene, down).x / lit.x, std::exp(-1.3 * 0.5 * std::numbers::sqrt2), 1e-6);
    }
}

TEST(ReferenceSingleScattering, AlbedoIsBoundedAndEmissionIsAdded) {
    auto scene = slab_scene(2.0, 1.0, 0.0);
    volume_in(scene).transfer_function = uniform_extinction(2.0, {0.5, 2.0, 0.25});
    scene.lights["sun"] = sun({0.0, 0.0, 1.0});
    const glm::dvec3 lit = scattered_once(scene, down);
    EXPECT_NEAR(lit.x, 0.5 * lit.y, 1e-8) << "albedo above 1 counts as 1";
    volume_in(scene).optics.edit([](auto& optics) { optics.emission = 3.0; });
    const glm::dvec3 glowing = scattered_once(scene, down) - lit;
    EXPECT_NEAR(glowing.y, 3.0 * 2.0 * -std::expm1(-2.0), 1e-7);
    EXPECT_NEAR(glowing.z, 3.0 * 0.25 * -std::expm1(-2.0), 1e-7);
}

TEST(ReferenceSingleScattering, ForwardPeakIsBrightTowardsTheLight) {
    // Test 18: the sign of g. The eye looks along `down`: first against the light, then with it.
    for (const double g : {0.8, -0.8}) {
        auto scene = slab_scene(1.0, 1.0, g);
        scene.lights["sun"] = sun({0.1, 0.0, -1.0});
        const double towards = scattered_once(scene, down).x;
        scene.lights["sun"] = sun({0.1, 0.0, 1.0});
        const double away = scattered_once(scene, down).x;
        EXPECT_TRUE(g > 0.0 ? towards > 20.0 * away : away > 20.0 * towards);
    }
}

TEST(ReferenceSingleScattering, TwoLightsAreTheSumOfEach) {
    // Test 23, through heterogeneous matter; each picture is 1e-6 from the truth.
    auto both = noisy_scene(0.9, 0.4, {0.8, 0.5, 0.2});
    both.lights["sun"] = sun({0.3, 1.0, 0.4}, {1.0, 0.9, 0.7});
    both.lights["lamp"] = lamp({0.3, 0.2, 0.9}, 2.0);
    auto first = both;
    first.lights.erase("lamp");
    auto second = both;
    second.lights.erase("sun");
    const ScatteringOptions options{.paths = LightPaths::single, .tolerance = 1e-6};
    const auto sum = render_scattering(both, 8, 8, options);
    const auto one = render_scattering(first, 8, 8, options);
    const auto two = render_scattering(second, 8, 8, options);
    for (std::size_t n = 0; n < sum.image.rgba.size(); ++n) {
        if (n % 4 != 3) {
            EXPECT_NEAR(sum.image.rgba[n], one.image.rgba[n] + two.image.rgba[n], 1e-5);
        }
    }
    EXPECT_LT(sum.largest_error, 1e-4);
}

TEST(ReferenceSingleScattering, StatedErrorHolds) {
    auto scene = noisy_scene(0.9, 0.6);
    scene.lights["sun"] = sun({0.3, 1.0, 0.4});
    scene.lights["lamp"] = lamp({0.1, 0.1, 0.1});
    const auto fine = render_scattering(scene, 12, 12, {.paths = LightPaths::single, .tolerance = 1e-7});
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        const auto coarse = render_scattering(scene, 12, 12, {.paths = LightPaths::single, .tolerance = tolerance});
        EXPECT_LT(coarse.evaluations, fine.evaluations);
        for (std::size_t n = 0; n < fine.error.size(); ++n) {
            EXPECT_NEAR(coarse.image.rgba[4 * n], fine.image.rgba[4 * n], coarse.error[n].x + fine.error[n].x);
        }
        EXPECT_LT(coarse.largest_error, 100.0 * tolerance);
    }
}

TEST(ReferenceSingleScattering, LeapingChangesNothing) {
    auto scene = noisy_scene(0.9, 0.6);
    scene.lights["sun"] = sun({0.3, 1.0, 0.4});
    const auto leapt = render_scattering(scene, 8, 8, {.paths = LightPaths::single, .tolerance = 1e-5});
    const auto whole = render_scattering(scene, 8, 8, {.paths = LightPaths::single, .tolerance = 1e-5, .leap = false});
    for (std::size_t n = 0; n < leapt.error.size(); ++n) {
        EXPECT_NEAR(leapt.image.rgba[4 * n], whole.image.rgba[4 * n], leapt.error[n].x + whole.error[n].x);
    }
    EXPECT_LT(leapt.evaluations, whole.evaluations);
}

TEST(ReferenceSingleScattering, SurfacesReflectInTheShadow) {
    // A ramp of data has one gradient: where it is all surface, Lambert's law and the highlight replace the phase
    // function, and the light from the left passes the matter on its way. Seen from +z, the ray at x = 0.
    auto scene = scene_with(grid_of(glm::ivec3(21), glm::dvec3(0.05), [](glm::ivec3 at) { return double(at.x); }),
                            uniform_extinction(1e-3, {0.6, 0.4, 0.2}));
    volume_in(scene).clip = scene::ClipBox{glm::dvec3(0.1), glm::dvec3(0.9)};
    volume_in(scene).optics = scene::VolumeOptics{.lighting = scene::VolumeLighting::shadow_rays,
                                                  .albedo = glm::dvec3(0.5),
                                                  .surfaces = true,
                                                  .diffuse = 0.8,
                                                  .specular = 0.0};
    scene.lights["sun"] = sun({-3.0, 0.0, 4.0});  // irradiance pi; the normal is -x
    const ScatteringScene media(scene);
    const RayResult result = SingleScattering(media, 1e-10).trace(down);
    const double opacity = 1.0 - result.transmittance;
    EXPECT_NEAR(result.radiance.x / opacity, 0.5 * 0.6 * 0.8 * 0.6, 2e-3 * 0.15) << "thin matter is hardly in shadow";
    volume_in(scene).optics.edit([](auto& optics) { optics.density_scale = 3000.0; });
    const ScatteringScene dense(scene);
    EXPECT_LT(SingleScattering(dense, 1e-10).trace(down).radiance.x, 0.144 * 0.7) << "dense matter is";
}

TEST(ReferenceTransmittance, IsThatOfTheEmissionAbsorptionIntegral) {
    auto scene = noisy_scene(1.0, 0.0);
    const ScatteringScene media(scene);
    const SingleScattering rays(media, 1e-12);
    for (int n = 0; n < 50; ++n) {
        const scene::Ray ray = ray_from({2.0 * noise({n, 0, 0}) - 1.0, 2.0 * noise({n, 1, 0}) - 1.0, 2.0},
                                        {0.6 * noise({n, 2, 0}) - 0.3, 0.6 * noise({n, 3, 0}) - 0.3, 0.0});
        const double truth = rays.trace_unscattered(ray).transmittance;
        for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
            const auto passed = transmittance(media.volumes, ray, 1e300, tolerance, 1e-12, true);
            EXPECT_NEAR(passed.value, truth, passed.error + 1e-12);
            EXPECT_LT(passed.error, tolerance);
        }
        // Up to a point inside and on from there.
        const double middle = 2.1;
        const auto near = transmittance(media.volumes, ray, middle, 1e-9, 1e-12, true);
        const auto far =
            transmittance(media.volumes, {ray.origin_world, ray.direction_world, middle}, 1e300, 1e-9, 1e-12, true);
        EXPECT_NEAR(near.value * far.value, truth, 1e-8);
    }
}

}  // namespace
}  // namespace bruma::reference
