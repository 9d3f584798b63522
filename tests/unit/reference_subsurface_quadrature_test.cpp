// Shelf: closed form and independent programs. The BSSRDF integrated over meshes.
#include <gtest/gtest.h>

#include "reference/subsurface/subsurface_quadrature.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;
const glm::dvec3 up(0.0, 0.0, 1.0);

SurfacePoint seen_along(const RayMesh& mesh, glm::dvec3 from, glm::dvec3 direction) {
    const auto hit = mesh.first_hit(from, direction);
    EXPECT_TRUE(hit);
    return {hit->position, hit->shading_normal};
}

/// The integral over the plane z = 0 under a directional light.
double flat_integral(const Dipole& dipole, double eta, double angle_deg) {
    constexpr int azimuths = 64;
    return integrate_plane(dipole.diffusion().sigma_tr, 1e-2 * dipole.diffusion().d, [&](double rho) {
        double sum = 0.0;
        for (int n = 0; n < azimuths; ++n) {
            sum += flat_s_d(dipole, eta, angle_deg, rho, 2.0 * pi * (n + 0.5) / azimuths);
        }
        return sum / azimuths;
    });
}

TEST(SubsurfaceQuadrature, LargeFlatFaceIsTheHalfSpace) {
    // Two triangles of 120 mm: the peak under x_o is a thousandth of them and must be found.
    const RayMesh box(box_mesh({-60.0, -60.0, -60.0}, {60.0, 60.0, 0.0}));
    for (const double angle_deg : {0.0, 60.0}) {
        const double angle = angle_deg * pi / 180.0;
        const glm::dvec3 to_light(std::sin(angle), 0.0, std::cos(angle));
        const Bssrdf bssrdf(skin1(), SubsurfaceModel::directional_dipole);
        const SubsurfaceQuadrature quadrature(box, bssrdf, {{true, to_light, {}, glm::dvec3(2.0)}});
        const QuadratureResult found = quadrature.at({{0.013, -0.4, 0.0}, up});
        const double t_12 = fresnel_transmittance(to_light.z, 1.3);
        for (int c = 0; c < 3; ++c) {
            const double expected = 2.0 * to_light.z * t_12 * flat_integral(bssrdf.channel(c), 1.3, angle_deg);
            EXPECT_NEAR(found.value[c], expected, found.error[c]) << "its own bound, " << angle_deg;
            EXPECT_LE(found.error[c], 1.001e-3 * found.value[c]);
            EXPECT_NEAR(found.value[c], expected, 3e-4 * expected) << "and better in truth";
        }
    }
}

TEST(SubsurfaceQuadrature, SphereExitanceInBins) {
    for (const SphereTruth& truth : sphere_truths) {
        const RayMesh sphere(sphere_mesh(truth.radius, 4));
        const SubsurfaceMedium medium{glm::dvec3(truth.channel.sigma_a), glm::dvec3(truth.channel.sigma_s),
                                      glm::dvec3(0.0), truth.channel.eta};
        const Bssrdf bssrdf(medium, SubsurfaceModel::directional_dipole);
        const SubsurfaceQuadrature quadrature(sphere, bssrdf, {{true, up, {}, glm::dvec3(1.0)}}, {2e-3, 300'000});
        const GaussLegendre rule(2);
        for (std::size_t bin = 0; bin < 10; ++bin) {
            const double low = -1.0 + 0.2 * double(bin);
            const double mean = rule.integrate(low, low + 0.2, [&](double cosine) {
                const double azimuth = 0.7 + double(bin);
                const double sine = std::sqrt(1.0 - cosine * cosine);
                const glm::dvec3 normal(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
                return quadrature.at(seen_along(sphere, 2.0 * truth.radius * normal, -normal)).value.x;
            });
            // The published column is good to 1 %; beside the terminator, where the mean within a bin bends, to 2 %.
            const bool terminator = bin == 4 || bin == 5;
            EXPECT_NEAR(bssrdf.exitance_per_radiance() * mean / 0.2, truth.dipole[bin],
                        (terminator ? 0.03 : 0.015) * truth.dipole[bin])
                << truth.name << ", bin " << bin;
        }
    }
}

TEST(SubsurfaceQuadrature, ShadowTakesWhatLiesInIt) {
    // A plate over one half of a face: in normal light exactly half of the plane's integral is left under its edge.
    TriangleMesh mesh = box_mesh({-60.0, -60.0, -60.0}, {60.0, 60.0, 0.0});
    const TriangleMesh plate = box_mesh({0.0, -70.0, 20.0}, {70.0, 70.0, 25.0});
    for (const glm::uvec3 triangle : plate.triangles) {
        mesh.triangles.push_back(triangle + unsigned(mesh.positions.size()));
    }
    mesh.positions.insert(mesh.positions.end(), plate.positions.begin(), plate.positions.end());
    const RayMesh shaded(mesh);
    const Bssrdf bssrdf(skin1(), SubsurfaceModel::directional_dipole);
    const SubsurfaceQuadrature quadrature(shaded, bssrdf, {{true, up, {}, glm::dvec3(1.0)}}, {2e-3, 1'000'000});
    const QuadratureResult found = quadrature.at({{0.0, 0.0, 0.0}, up});
    for (int c = 0; c < 3; ++c) {
        const double whole = fresnel_transmittance(1.0, 1.3) * flat_integral(bssrdf.channel(c), 1.3, 0.0);
        EXPECT_NEAR(found.value[c], 0.5 * whole, 0.004 * whole) << c;
    }
}

TEST(SubsurfaceQuadrature, FarPointLightIsADirectionalOne) {
    const RayMesh sphere(sphere_mesh(8.0, 3, {1.0, 2.0, 3.0}));
    const Bssrdf bssrdf(potato(), SubsurfaceModel::normalised_directional_dipole);
    const glm::dvec3 toward = glm::normalize(glm::dvec3(0.3, 0.5, 1.0));
    const double distance = 1e7;  // mm; the light's directions differ by 1e-6
    const SubsurfaceQuadrature far(
        sphere, bssrdf, {{false, {}, glm::dvec3(1.0, 2.0, 3.0) + distance * toward, glm::dvec3(distance * distance)}});
    const SubsurfaceQuadrature parallel(sphere, bssrdf, {{true, toward, {}, glm::dvec3(1.0)}});
    const SurfacePoint exit = seen_along(sphere, {40.0, 2.0, 3.0}, {-1.0, 0.0, 0.0});
    const glm::dvec3 a = far.at(exit).value;
    const glm::dvec3 b = parallel.at(exit).value;
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], 2e-5 * b[c]);
    }
    // Twice as near, four times as bright but for the size of the body.
    const auto at_distance = [&](double d) {
        const SubsurfaceQuadrature near(sphere, bssrdf,
                                        {{false, {}, glm::dvec3(1.0, 2.0, 3.0) + d * toward, glm::dvec3(1.0)}});
        return near.at(exit).value.x;
    };
    EXPECT_NEAR(at_distance(2000.0) / at_distance(4000.0), 4.0, 0.03);
}

TEST(SubsurfaceQuadrature, LightsAddAndDarknessIsDark) {
    const RayMesh sphere(sphere_mesh(8.0, 3));
    const Bssrdf bssrdf(marble(), SubsurfaceModel::directional_dipole);
    const BodyLight one{true, up, {}, {1.0, 0.5, 0.0}};
    const BodyLight two{true, {1.0, 0.0, 0.0}, {}, {0.0, 0.5, 2.0}};
    const SurfacePoint exit = seen_along(sphere, {20.0, 15.0, 10.0}, -glm::normalize(glm::dvec3(20.0, 15.0, 10.0)));
    const glm::dvec3 sum = SubsurfaceQuadrature(sphere, bssrdf, {one, two}).at(exit).value;
    const glm::dvec3 apart = SubsurfaceQuadrature(sphere, bssrdf, {one}).at(exit).value +
                             SubsurfaceQuadrature(sphere, bssrdf, {two}).at(exit).value;
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(sum[c], apart[c], 2e-3 * apart[c]);
    }
    EXPECT_EQ(SubsurfaceQuadrature(sphere, bssrdf, {}).at(exit).value, glm::dvec3(0.0));
}

TEST(SubsurfaceQuadrature, TighterToleranceComesCloser) {
    const RayMesh sphere(sphere_mesh(5.0, 3));
    const Bssrdf bssrdf(marble(), SubsurfaceModel::directional_dipole);
    const BodyLight light{true, glm::normalize(glm::dvec3(1.0, 0.2, 1.0)), {}, glm::dvec3(1.0)};
    const SurfacePoint exit = seen_along(sphere, {2.0, 1.0, 30.0}, {0.0, 0.0, -1.0});
    const glm::dvec3 best = SubsurfaceQuadrature(sphere, bssrdf, {light}, {2e-5, 20'000'000}).at(exit).value;
    std::uint64_t before = 0;
    for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
        const QuadratureResult found = SubsurfaceQuadrature(sphere, bssrdf, {light}, {tolerance}).at(exit);
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(std::abs(found.value[c] - best[c]), found.error[c] + 2e-5 * best[c])
                << "the stated error is a bound";
            EXPECT_LE(found.error[c], 1.0001 * tolerance * found.value[c]);
        }
        EXPECT_GE(found.evaluations, before);
        before = found.evaluations;
    }
}

}  // namespace
}  // namespace bruma::reference
