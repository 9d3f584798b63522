// Shelf: closed form. Lamps that are far from what they light: as parallel light, and in the views that they have of
// it.
#include "render/light/far_lamps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "render/map_camera.h"
#include "render/subsurface/body_frame.h"

namespace bruma::render {
namespace {

const glm::dvec3 way = glm::normalize(glm::dvec3(0.3, 0.5, -0.8));

TEST(FarLamps, AreParallelLightOfTheSameIrradiance) {
    const glm::dvec3 middle(1.0, -2.0, 3.0);
    scene::Light lamp{.kind = scene::LightKind::point, .intensity = 7.0};
    for (const double distance : {2e4, 1e9, 1e200}) {
        lamp.position_world = middle + distance * way;
        const auto parallel = parallel_from_afar(lamp, middle, 1.0);
        ASSERT_TRUE(parallel);
        EXPECT_EQ(parallel->kind, scene::LightKind::directional);
        EXPECT_NEAR(glm::dot(parallel->direction_world, way), 1.0, 1e-12);
        const double expected = 7.0 / distance / distance;
        EXPECT_NEAR(parallel->intensity, expected, 1e-9 * expected);  // positions are rounded beside the middle
    }
    lamp.position_world = middle + 0.5e4 * way;
    EXPECT_FALSE(parallel_from_afar(lamp, middle, 1.0));
    EXPECT_FALSE(parallel_from_afar(scene::Light{.position_world = middle + 1e9 * way}, middle, 1.0));
}

TEST(FarLamps, KeepTheShareOfTheirCone) {
    scene::Light spot{.kind = scene::LightKind::spot, .position_world = 1e6 * way, .intensity = 1e12};
    spot.direction_world = 5.0 * way;
    EXPECT_NEAR(parallel_from_afar(spot, {}, 1.0)->intensity, 1.0, 1e-12);
    spot.direction_world = -way;
    EXPECT_EQ(parallel_from_afar(spot, {}, 1.0)->intensity, 0.0);
}

TEST(FarLamps, SeeABodyInTexelsOfItsOwnSize) {
    // The corners of a cube of 20 mm are 34.6 mm apart.
    std::vector<glm::dvec3> corners;
    for (int n = 0; n < 8; ++n) {
        corners.emplace_back(n & 1 ? 10.0 : -10.0, n & 2 ? 10.0 : -10.0, n & 4 ? 10.0 : -10.0);
    }
    for (const double distance : {1e3, 1e4, 1e5, 1e6, 1e8}) {
        const MapCamera camera = perspective_camera(corners, distance * way, 64);
        const double texel = distance * std::max(camera.texel.x, camera.texel.y);
        // Four texels are to spare; perspective makes near corners larger.
        EXPECT_LE(texel, 1.05 * 34.65 / 60.0) << distance;
        EXPECT_GE(texel, 20.0 / 64.0) << distance;
    }
}

}  // namespace
}  // namespace bruma::render
