// Shelf: closed form. Rays against spheres and boxes whose hits can be written down.
#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"
#include "reference/random.h"
#include "reference/subsurface/ray_mesh.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

glm::dvec3 direction(RandomStream& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double phi = 2.0 * std::numbers::pi * random.uniform();
    return {std::sqrt(1.0 - z * z) * std::cos(phi), std::sqrt(1.0 - z * z) * std::sin(phi), z};
}

TEST(RayMesh, BoxIsHitWhereItsPlanesAre) {
    for (const double size : {1e-6, 1.0, 1e6}) {
        const glm::dvec3 shift = 3.0 * size * glm::dvec3(5.0, -7.0, 2.0);
        const RayMesh box(box_mesh(shift - size, shift + size));
        RandomStream random(1, 0, 0);
        for (int n = 0; n < 2000; ++n) {
            const glm::dvec3 local(1.8 * random.uniform() - 0.9, 1.8 * random.uniform() - 0.9,
                                   1.8 * random.uniform() - 0.9);
            const glm::dvec3 d = direction(random);
            double expected = 1e300;
            for (int axis = 0; axis < 3; ++axis) {
                expected = std::min(expected, (std::copysign(1.0, d[axis]) - local[axis]) / d[axis]);
            }
            const auto hit = box.first_hit(shift + size * local, d);
            ASSERT_TRUE(hit);
            // Double precision, but for coordinates of 20 times the box's size; grazing rays keep float's.
            EXPECT_NEAR(hit->t / size, expected, 1e-12) << size;
            EXPECT_GT(glm::dot(hit->geometric_normal, d), 0.0);
            EXPECT_NEAR(glm::length(hit->position - shift - size * (local + expected * d)) / size, 0.0, 1e-5);
            EXPECT_TRUE(box.blocked(shift + size * local, d));
            EXPECT_FALSE(box.blocked(shift + size * local, d, 0.999 * expected * size));
            EXPECT_FALSE(box.first_hit(shift + size * local, d, 0.999 * expected * size));
        }
    }
}

TEST(RayMesh, ClosedMeshLetsNothingOutAndShadesSmoothly) {
    const RayMesh sphere(sphere_mesh(10.0, 4, {1.0, 2.0, 3.0}));
    EXPECT_NEAR(sphere.bounding_radius(), 10.0, 0.1);
    RandomStream random(2, 0, 0);
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 from = glm::dvec3(1.0, 2.0, 3.0) + 9.0 * random.uniform() * direction(random);
        const glm::dvec3 d = direction(random);
        const auto hit = sphere.first_hit(from, d);
        ASSERT_TRUE(hit) << "a ray inside slipped through a seam";
        const glm::dvec3 radial = glm::normalize(hit->position - glm::dvec3(1.0, 2.0, 3.0));
        EXPECT_GT(glm::dot(radial, hit->shading_normal), 0.99999);  // edges of 0.06 radii: sagitta and slope below 1e-3
        EXPECT_GT(glm::dot(radial, hit->geometric_normal), 0.998);
        EXPECT_NEAR(glm::length(from + hit->t * d - hit->position), 0.0, 1e-4);
    }
}

TEST(RayMesh, RaysFromTheSurfaceDoNotMeetTheirOwnTriangle) {
    const RayMesh sphere(sphere_mesh(10.0, 4));
    RandomStream random(3, 0, 0);
    for (int n = 0; n < 20000; ++n) {
        const glm::dvec3 d = direction(random);
        const auto hit = sphere.first_hit(glm::dvec3(0.0), d);
        ASSERT_TRUE(hit);
        // Outwards nothing is left to meet. Six degrees above its face a ray has risen by six roundings of a float when
        // it may first hit; flatter ones are not asked.
        EXPECT_FALSE(sphere.blocked(hit->position, hit->geometric_normal));
        const glm::dvec3 other = direction(random);
        const double rise = glm::dot(other, hit->geometric_normal);
        if (rise > 0.1) {
            EXPECT_FALSE(sphere.blocked(hit->position, other));
        } else if (rise < -0.1) {
            EXPECT_TRUE(sphere.blocked(hit->position, other));
        }
    }
}

TEST(RayMesh, RefusesWhatIsNoSurface) {
    EXPECT_THROW(RayMesh(TriangleMesh{}), InputError);
    TriangleMesh mesh = box_mesh(glm::dvec3(0.0), glm::dvec3(1.0));
    mesh.triangles[3].y = 8;
    EXPECT_THROW(RayMesh{mesh}, InputError);
    mesh = box_mesh(glm::dvec3(0.0), glm::dvec3(1.0));
    mesh.positions[2].x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(RayMesh{mesh}, InputError);
    mesh = box_mesh(glm::dvec3(0.0), glm::dvec3(1.0));
    mesh.normals.resize(3);
    EXPECT_THROW(RayMesh{mesh}, InputError);
    EXPECT_THROW(RayMesh{box_mesh(glm::dvec3(1.0), glm::dvec3(1.0))}, InputError);
}

TEST(RayMesh, TrianglesWithoutAreaAreNeverHit) {
    TriangleMesh mesh = box_mesh(glm::dvec3(-1.0), glm::dvec3(1.0));
    mesh.positions.emplace_back(0.0, 0.0, 0.0);
    mesh.positions.emplace_back(0.0, 0.0, 0.5);
    mesh.triangles.emplace_back(8, 8, 8);
    mesh.triangles.emplace_back(8, 9, 9);
    const RayMesh box(mesh);
    const auto hit = box.first_hit({0.0, -0.9, 0.2}, {0.0, 1.0, 0.0});
    ASSERT_TRUE(hit);
    EXPECT_DOUBLE_EQ(hit->t, 1.9);
}

}  // namespace
}  // namespace bruma::reference
