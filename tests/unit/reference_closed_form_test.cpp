// Shelf: closed form. The reference renderer against integrals that can be written down.
#include <gtest/gtest.h>

#include <numbers>

#include "base/error.h"
#include "reference/volume/emission_absorption.h"
#include "reference_scenes.h"

namespace bruma::reference {
namespace {

/// The length of a line inside the box [-extent/2, extent/2], by clipping it against each face in turn.
double length_inside(const scene::Ray& ray, glm::dvec3 extent) {
    double begin = 0.0;
    double end = 1e300;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const double outward = side * ray.direction_world[axis];
            const double gap = 0.5 * extent[axis] - side * ray.origin_world[axis];
            if (outward > 0.0) {
                end = std::min(end, gap / outward);
            } else if (outward < 0.0) {
                begin = std::max(begin, gap / outward);
            } else if (gap < 0.0) {
                end = -1.0;
            }
        }
    }
    return std::max(0.0, end - begin);
}

std::vector<scene::Ray> oblique_rays() {
    std::vector<scene::Ray> rays;
    for (int n = 0; n < 40; ++n) {
        const glm::dvec3 from(noise({n, 0, 0}) - 0.5, noise({n, 1, 0}) - 0.5, noise({n, 2, 0}) - 0.5);
        const glm::dvec3 to(noise({n, 3, 0}) - 0.5, noise({n, 4, 0}) - 0.5, noise({n, 5, 0}) - 0.5);
        rays.push_back(ray_from(6.0 * from, 0.8 * to));
    }
    return rays;
}

// Double precision leaves some 1e-15 per cell crossed; 1e-9 leaves room for a few hundred cells and no fault.
constexpr double exact = 1e-9;

TEST(ReferenceClosedForm, HomogeneousSlabAtEveryResolution) {
    const glm::dvec3 extent(1.0, 0.8, 0.6);
    const double sigma = 2.3;
    const glm::dvec3 color(0.2, 0.5, 0.9);
    for (const glm::ivec3 size : {glm::ivec3(1), glm::ivec3(64), glm::ivec3(64, 64, 7)}) {
        const EmissionAbsorption media(scene_with(homogeneous(size, extent), uniform_extinction(sigma, color)));
        int hits = 0;
        for (const scene::Ray& ray : oblique_rays()) {
            const double alpha = -std::expm1(-sigma * length_inside(ray, extent));
            const RayResult result = media.trace(ray);
            EXPECT_NEAR(1.0 - result.transmittance, alpha, exact);
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_NEAR(result.radiance[channel], color[channel] * alpha, exact);
            }
            hits += alpha > 0.0 ? 1 : 0;
        }
        EXPECT_GT(hits, 15) << "too few rays meet the slab for this test to mean something";
    }
}

/// s = i along x over 65 samples; clipped to the part between the outermost samples, where s is linear in x.
scene::Scene ramp_scene(scene::TransferFunction tf) {
    auto scene =
        scene_with(grid_of({65, 3, 3}, glm::dvec3(1.0 / 64.0), [](glm::ivec3 at) { return double(at.x); }), tf);
    volume_in(scene).clip = scene::ClipBox{{0.5 / 65.0, 0.0, 0.0}, {1.0 - 0.5 / 65.0, 1.0, 1.0}};
    return scene;
}

TEST(ReferenceClosedForm, LinearExtinctionAndLinearSource) {
    // sigma = k u with u = t / D on a ray along the ramp of D = 1 m. Opacities this small make -ln(1 - o) linear to
    // 5e-11. S = s0 + s1 u. By parts: C = S(0) - S(D) e^-tau(D) + s1 integral of exp(-k t^2 / 2), an error function.
    scene::TransferFunction tf;
    const double k = 5.0;
    tf.reference_length = 1e-10 / k;
    tf.opacity = {{0.0, 0.0}, {1.0, 1e-10}};
    const glm::dvec3 s0(0.1, 0.6, 1.0);
    const glm::dvec3 s1(0.8, -0.5, 0.0);
    tf.color = {{0.0, s0}, {1.0, s0 + s1}};
    const RayResult result = trace(ramp_scene(tf), ray_from({-3.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
    const double passed = std::exp(-0.5 * k);
    EXPECT_NEAR(result.transmittance, passed, exact);
    const double gauss = std::sqrt(std::numbers::pi / (2.0 * k)) * std::erf(std::sqrt(0.5 * k));
    for (int channel = 0; channel < 3; ++channel) {
        const double expected = s0[channel] - (s0[channel] + s1[channel]) * passed + s1[channel] * gauss;
        EXPECT_NEAR(result.radiance[channel], expected, exact);
    }
}

TEST(ReferenceClosedForm, OpacityRampHasItsLogarithm) {
    // o = a u: tau = D ((1 - a) ln(1 - a) + a) / (a l), for D = 1 m.
    scene::TransferFunction tf;
    const double a = 0.95;
    tf.reference_length = 0.3;
    tf.opacity = {{0.0, 0.0}, {1.0, a}};
    const double depth = ((1.0 - a) * std::log1p(-a) + a) / (a * tf.reference_length);
    const RayResult result = trace(ramp_scene(tf), ray_from({-3.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
    EXPECT_NEAR(result.transmittance, std::exp(-depth), exact);
}

TEST(ReferenceClosedForm, JumpOfTheCurveIsCutExactly) {
    // Opaque only for u above 0.4137, which lies inside a cell: the path there is (1 - 0.4137) m long.
    scene::TransferFunction tf;
    tf.reference_length = 1.0;
    tf.opacity = {{0.4137, 0.0}, {0.4137, 0.7}};
    const RayResult result = trace(ramp_scene(tf), ray_from({-3.0, 0.0, 0.0}, {0.0, 0.0, 0.0}));
    EXPECT_NEAR(result.transmittance, std::pow(0.3, 1.0 - 0.4137), exact);
}

TEST(ReferenceClosedForm, EmissionIsInUnitsOfColor) {
    auto tf = uniform_extinction(3.0, {0.3, 0.2, 0.1});
    tf.emission = {{0.0, 1.5}};
    const RayResult result =
        trace(scene_with(homogeneous(glm::ivec3(4), glm::dvec3(1.0)), tf), ray_from({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
    EXPECT_NEAR(result.radiance.x, 0.3 * 2.5 * -std::expm1(-3.0), exact);
    EXPECT_NEAR(result.radiance.z, 0.1 * 2.5 * -std::expm1(-3.0), exact);
}

TEST(ReferenceClosedForm, OverlappingVolumesMultiplyTransmittance) {
    auto scene = scene_with(homogeneous(glm::ivec3(5), glm::dvec3(1.0)), uniform_extinction(1.5, {1.0, 0.0, 0.0}));
    scene.nodes["second"] = scene.nodes["volume"];
    volume_in(scene, "second").transfer_function = uniform_extinction(0.7, {0.0, 1.0, 0.0});
    volume_in(scene, "second").grid = homogeneous({3, 7, 4}, glm::dvec3(1.0));
    scene.nodes["second"].transform = scene::Transform{.translation = {0.0, 0.0, 0.4}};
    // Seen from +z: 0.4 m of the second alone, 0.6 m of both, 0.4 m of the first alone.
    const RayResult result = trace(scene, ray_from({0.01, 0.02, 5.0}, {0.01, 0.02, 0.0}));
    EXPECT_NEAR(result.transmittance, std::exp(-1.5 - 0.7), exact);
    const double both = -std::expm1(-0.6 * 2.2);
    const double before_both = std::exp(-0.4 * 0.7);
    EXPECT_NEAR(result.radiance.x, before_both * (both * 1.5 / 2.2 + std::exp(-0.6 * 2.2) * -std::expm1(-0.4 * 1.5)),
                exact);
    EXPECT_NEAR(result.radiance.y, -std::expm1(-0.4 * 0.7) + before_both * both * 0.7 / 2.2, exact);
}

TEST(ReferenceClosedForm, DegenerateRaysAreFiniteAndRight) {
    const double sigma = 1.7;
    const EmissionAbsorption media(scene_with(homogeneous(glm::ivec3(8), glm::dvec3(1.0)), uniform_extinction(sigma)));
    const auto alpha = [&](const scene::Ray& ray) {
        const RayResult result = media.trace(ray);
        EXPECT_TRUE(std::isfinite(result.radiance.x) && std::isfinite(result.error));
        return 1.0 - result.transmittance;
    };
    const double whole = -std::expm1(-sigma);
    const double half = -std::expm1(-0.5 * sigma);
    EXPECT_NEAR(alpha({{1.0 / 16.0, 3.0 / 16.0, 2.0}, {0.0, 0.0, -1.0}, 0.0}), whole, exact) << "on a voxel plane";
    EXPECT_NEAR(alpha({{0.0, 0.0, 0.5}, {0.0, 0.0, -1.0}, 0.0}), whole, exact) << "origin on the face, inwards";
    EXPECT_NEAR(alpha({{0.0, 0.0, 0.5}, {0.0, 0.0, 1.0}, 0.0}), 0.0, exact) << "origin on the face, outwards";
    EXPECT_NEAR(alpha({{0.5, 0.0, 2.0}, {0.0, 0.0, -1.0}, 0.0}), whole, exact) << "inside a face";
    EXPECT_NEAR(alpha({{0.5, 0.5, 2.0}, {0.0, 0.0, -1.0}, 0.0}), whole, exact) << "along an edge";
    EXPECT_NEAR(alpha({{0.5 + 1e-9, 0.0, 2.0}, {0.0, 0.0, -1.0}, 0.0}), 0.0, exact) << "beside a face";
    EXPECT_NEAR(alpha({{0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 0.0}), half, exact) << "camera inside";
    EXPECT_NEAR(alpha({{0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}, 2.0}), half, exact) << "near plane inside";
    EXPECT_NEAR(alpha({{0.0, 0.0, 2.0}, {0.0, 0.0, -1.0}, 9.0}), 0.0, exact) << "near plane behind";
    EXPECT_NEAR(alpha(ray_from({0.0, 1.0, 0.0}, {0.5, 0.5, 0.0})), 0.0, 1e-6) << "touching an edge";
    EXPECT_NEAR(alpha(ray_from({1.5, 1.5, 1.5}, {0.5, 0.5, 0.5})), -std::expm1(-sigma * std::sqrt(3.0)), exact);
}

TEST(ReferenceClosedForm, ThickMatterShowsItsSkin) {
    // Three million optical depths: what is seen is the source at the entry, S(u = 1) = 0.75, or some 1e-6 m behind.
    // No node of a whole cell's quadrature sees anything at all, so whole and halves would agree on black.
    scene::TransferFunction tf;
    tf.reference_length = 1e-6;
    tf.opacity = {{0.0, 0.95}};
    tf.color = {{0.0, glm::dvec3(0.25)}, {1.0, glm::dvec3(0.75)}};
    auto scene = scene_with(grid_of({2, 2, 5}, glm::dvec3(0.25), [](glm::ivec3 at) { return double(at.z); }), tf);
    const RayResult result = trace(scene, ray_from({0.0, 0.0, 5.0}, {0.0, 0.0, 0.0}));
    EXPECT_NEAR(result.radiance.x, 0.75, 1e-6);
    EXPECT_LT(result.transmittance, 1e-12);
}

TEST(ReferenceClosedForm, PictureHasBackgroundRowsAndAlpha) {
    auto scene = scene_with(homogeneous(glm::ivec3(2), {0.5, 9.0, 1.0}), uniform_extinction(1.0, glm::dvec3(0.0)));
    scene.background = scene::Background{.top = {1.0, 0.0, 0.5}, .bottom = {0.0, 1.0, 0.5}};
    const ReferenceImage result = render_emission_absorption(scene, 8, 4);
    const double passed = std::exp(-1.0);
    for (int y = 0; y < 4; ++y) {
        const double f = (y + 0.5) / 4.0;
        // The slab covers x in [-0.25, 0.25] m of the 2 m wide picture: columns 3 and 4.
        EXPECT_FLOAT_EQ(result.image.pixel(0, y)[0], float(1.0 - f));
        EXPECT_FLOAT_EQ(result.image.pixel(0, y)[3], 0.0F);
        EXPECT_FLOAT_EQ(result.image.pixel(3, y)[0], float((1.0 - f) * passed));
        EXPECT_FLOAT_EQ(result.image.pixel(4, y)[1], float(f * passed));
        EXPECT_FLOAT_EQ(result.image.pixel(4, y)[3], float(1.0 - passed));
    }
    EXPECT_LT(result.largest_error, 1e-6);
    EXPECT_GT(result.evaluations, 0U);
}

TEST(ReferenceClosedForm, RefusesWhatHasNoPicture) {
    auto scene = scene_with(homogeneous(glm::ivec3(2), glm::dvec3(1.0)), uniform_extinction(1.0));
    EXPECT_THROW(render_emission_absorption(scene, 0, 4), InputError);
    scene.camera.reset();
    EXPECT_THROW(render_emission_absorption(scene, 4, 4), InputError);
}

}  // namespace
}  // namespace bruma::reference
