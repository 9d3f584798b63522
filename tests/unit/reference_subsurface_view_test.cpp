// Shelf: closed form and the other reference. Pictures of translucent meshes, in the scene's metres.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "base/error.h"
#include "reference/subsurface/subsurface_view.h"
#include "subsurface_truth.h"

namespace bruma::reference {
namespace {

using std::numbers::pi;

scene::Camera from_above(double height) {
    scene::Camera camera;
    camera.projection = scene::Projection::orthographic;
    camera.eye_world = {0.0, 0.0, 0.2};
    camera.target_world = {0.0, 0.0, 0.0};
    camera.view_height = height;
    return camera;
}

scene::Light light_from(glm::dvec3 direction) {
    scene::Light light;
    light.direction_world = direction;
    light.color = {1.0, 0.8, 0.6};
    light.intensity = 2.0;
    return light;
}

TriangleMesh in_metres(TriangleMesh mesh) {
    for (glm::dvec3& position : mesh.positions) {
        position *= 1e-3;
    }
    return mesh;
}

TEST(SubsurfaceView, FaceOfALargeBoxIsTheHalfSpace) {
    const TriangleMesh box = in_metres(box_mesh({-60.0, -60.0, -60.0}, {60.0, 60.0, 0.0}));
    SubsurfaceViewOptions options;
    options.model = SubsurfaceModel::directional_dipole;
    const SubsurfaceView view =
        render_subsurface(box, skin1(), {light_from({0.0, 0.0, 1.0})}, from_above(0.001), 3, 3, options);
    const double t = fresnel_transmittance(1.0, 1.3);
    for (int c = 0; c < 3; ++c) {
        const Dipole dipole(skin1().channel(c), SubsurfaceModel::directional_dipole);
        const double integral = integrate_plane(dipole.diffusion().sigma_tr, 1e-2 * dipole.diffusion().d,
                                                [&](double rho) { return flat_s_d(dipole, 1.3, 0.0, rho, 0.0); });
        const double expected = 2.0 * glm::dvec3(1.0, 0.8, 0.6)[c] * t * t * integral;
        EXPECT_NEAR(view.image.pixel(1, 1)[c], expected, 1e-3 * expected) << c;
        EXPECT_GT(view.error[4][c], 0.0F);
        EXPECT_LE(view.error[4][c], 1.1e-3 * expected);
    }
    EXPECT_EQ(view.image.pixel(1, 1)[3], 1.0F);
    EXPECT_GT(view.evaluations, 0U);
}

/// Mean over the pixels whose surface faces the eye by between two cosines, of L / T_21 times 4 pi C_phi(1/eta): the
/// exitance there. The sphere of radius 10 mm stands at the origin under an orthographic camera.
double exitance_between(const SubsurfaceView& view, double height_mm, double low, double high, double eta,
                        int channel) {
    double flux = 0.0;
    double area = 0.0;
    for (int y = 0; y < view.image.height; ++y) {
        for (int x = 0; x < view.image.width; ++x) {
            const double px = ((x + 0.5) / view.image.width - 0.5) * height_mm;
            const double py = ((y + 0.5) / view.image.height - 0.5) * height_mm;
            const double cosine = std::sqrt(std::max(0.0, 1.0 - (px * px + py * py) / 100.0));
            if (cosine > low && cosine < high) {
                flux += view.image.pixel(x, y)[channel] / fresnel_transmittance(cosine, eta) / cosine;
                area += 1.0 / cosine;
            }
        }
    }
    return flux / area * 4.0 * pi * diffuse_boundary(eta).c_phi_inverse;
}

TEST(SubsurfaceView, WalksShowTheExitanceOfTheSphere) {
    const SphereTruth& truth = sphere_truths[1];
    const TriangleMesh sphere = in_metres(sphere_mesh(10.0, 4));
    SubsurfaceViewOptions options;
    options.method = SubsurfaceMethod::random_walk;
    options.paths = 90'000;
    scene::Light light = light_from({0.0, 0.0, 1.0});
    light.color = {0.0, 0.5, 0.0};  // green alone is walked; E = 1
    const SubsurfaceView front = render_subsurface(sphere, potato(), {light}, from_above(0.021), 60, 60, options);
    light.direction_world = {0.0, 0.0, -1.0};
    const SubsurfaceView back = render_subsurface(sphere, potato(), {light}, from_above(0.021), 60, 60, options);
    for (int bin = 0; bin < 2; ++bin) {
        // A sixth of 90 000 photons in a bin gives 0.8 %, 60 pixels across for its edge 0.5 %; behind, a fiftieth.
        EXPECT_NEAR(exitance_between(front, 21.0, 0.8 - 0.2 * bin, 1.0 - 0.2 * bin, 1.3, 1),
                    truth.walk[std::size_t(9 - bin)], 0.03 * truth.walk[std::size_t(9 - bin)]);
        EXPECT_NEAR(exitance_between(back, 21.0, 0.8 - 0.2 * bin, 1.0 - 0.2 * bin, 1.3, 1),
                    truth.walk[std::size_t(bin)], 0.10 * truth.walk[std::size_t(bin)]);
    }
    EXPECT_EQ(front.image.pixel(30, 30)[0], 0.0F);
    EXPECT_GT(front.error[30 * 60 + 30].y, 0.0F);
    // Photons of one channel start in a disk of 1.001 radii around flat faces; some few may slip through a seam.
    EXPECT_NEAR(double(front.paths), 89'700, 300);
    EXPECT_LE(front.lost, front.paths / 1000);
}

TEST(SubsurfaceView, StatedErrorOfWalksIsTheirScatter) {
    const TriangleMesh sphere = in_metres(sphere_mesh(10.0, 3));
    SubsurfaceViewOptions options;
    options.method = SubsurfaceMethod::random_walk;
    options.paths = 3'200;
    scene::Light light = light_from({0.3, 0.2, 1.0});
    light.color = {0.0, 0.0, 0.5};
    constexpr unsigned runs = 24;
    double sum = 0.0;
    double squares = 0.0;
    double stated = 0.0;
    for (unsigned run = 0; run < runs; ++run) {
        options.seed = run + 1;
        const SubsurfaceView view = render_subsurface(sphere, potato(), {light}, from_above(0.04), 5, 5, options);
        const double value = view.image.pixel(2, 2)[2];
        sum += value;
        squares += value * value;
        stated += std::pow(view.error[12].z, 2) / runs;
    }
    const double scatter = (squares - sum * sum / runs) / (runs - 1);
    // A variance from 24 runs is known to 30 %, one standard deviation.
    EXPECT_GT(stated / scatter, 0.4);
    EXPECT_LT(stated / scatter, 2.5);
}

TEST(SubsurfaceView, PerspectiveAndPointLightAgreeBetweenMethods) {
    // Away from the sphere's rim the two methods differ by what the model gets wrong; a medium in which the normalised
    // dipole is right on flat ground, and a body much larger than its mean free path, bring that under 15 %.
    const TriangleMesh sphere = in_metres(sphere_mesh(20.0, 4));
    scene::Camera camera;
    camera.eye_world = {0.0, 0.0, 0.1};
    camera.vertical_angle_deg = 10.0;
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.position_world = {0.02, 0.01, 0.1};
    light.intensity = 0.01;
    light.color = {0.0, 0.0, 1.0};
    SubsurfaceViewOptions options;
    options.quadrature.tolerance = 1e-2;
    const SubsurfaceView model = render_subsurface(sphere, skin1(), {light}, camera, 3, 3, options);
    options.method = SubsurfaceMethod::random_walk;
    options.paths = 300'000;
    const SubsurfaceView walk = render_subsurface(sphere, skin1(), {light}, camera, 3, 3, options);
    const double found = walk.image.pixel(1, 1)[2];
    EXPECT_NEAR(found, model.image.pixel(1, 1)[2], 0.12 * found + 4.0 * walk.error[4].z);
    EXPECT_LT(walk.error[4].z, 0.05 * found);
    EXPECT_GT(found, 0.0);
}

TEST(SubsurfaceView, LightsAreTurnedIntoMillimetres) {
    scene::Camera camera = from_above(1.0);
    scene::Light light;
    light.kind = scene::LightKind::point;
    light.position_world = {0.0, 2.0, 0.0};
    light.intensity = 3.0;
    const BodyLight point = body_light(light, camera);
    EXPECT_FALSE(point.directional);
    EXPECT_EQ(point.position, glm::dvec3(0.0, 2000.0, 0.0));
    EXPECT_DOUBLE_EQ(point.strength.x / (2000.0 * 2000.0), 3.0 / 4.0) << "irradiance 2 m away, given at 1 m";
    EXPECT_EQ(share_towards(point, {0.0, 0.0, 1.0}), 1.0);
    light.kind = scene::LightKind::spot;
    light.direction_world = {0.0, 2.0, 0.0};
    light.spot_angle_deg = 60.0;
    light.spot_softness = 1.0;
    const BodyLight spot = body_light(light, camera);
    EXPECT_FALSE(spot.directional);
    EXPECT_EQ(spot.position, point.position);
    // Smoothstep from a cosine of one half to one: half of it in the middle.
    EXPECT_EQ(share_towards(spot, {0.0, 1.0, 0.0}), 1.0);
    EXPECT_NEAR(share_towards(spot, {std::sqrt(1.0 - 0.75 * 0.75), 0.75, 0.0}), 0.5, 1e-12);
    EXPECT_EQ(share_towards(spot, {0.9, 0.4, 0.0}), 0.0);
    light.kind = scene::LightKind::headlight;
    EXPECT_EQ(body_light(light, camera).to_light, glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_EQ(body_light(light, camera).strength, glm::dvec3(3.0));
    light.on = false;
    EXPECT_EQ(body_light(light, camera).strength, glm::dvec3(0.0));
}

TEST(SubsurfaceView, ThreadsDoNotMatterAndUnscatteredLightPasses) {
    const TriangleMesh box = in_metres(box_mesh(glm::dvec3(-2.0), glm::dvec3(2.0)));
    const SubsurfaceMedium thin{{0.01, 0.02, 0.3}, glm::dvec3(0.01), glm::dvec3(0.0), 1.3};
    SubsurfaceViewOptions options;
    options.method = SubsurfaceMethod::random_walk;
    options.paths = 2'000;
    options.environment = [](glm::dvec3 direction) { return glm::dvec3(direction.z < -0.9 ? 3.0 : 0.0); };
    const SubsurfaceView lit =
        render_subsurface(box, thin, {light_from({0.1, 0.2, 1.0})}, from_above(0.006), 8, 8, options);
    SubsurfaceView again;
    tbb::task_arena(1).execute([&] {
        again = render_subsurface(box, thin, {light_from({0.1, 0.2, 1.0})}, from_above(0.006), 8, 8, options);
    });
    EXPECT_EQ(lit.image.rgba, again.image.rgba);
    const SubsurfaceView dark = render_subsurface(box, thin, {}, from_above(0.006), 8, 8, options);
    const double t = fresnel_transmittance(1.0, 1.3);
    for (int c = 0; c < 3; ++c) {
        const double expected = 3.0 * t * t * unscattered_transmittance(thin.channel(c), 4.0);
        EXPECT_NEAR(dark.image.pixel(4, 4)[c], expected, 1e-6) << c;
        EXPECT_EQ(dark.image.pixel(0, 0)[c], 0.0F) << "beside the box";
    }
    EXPECT_EQ(dark.image.pixel(0, 0)[3], 0.0F);
}

TEST(SubsurfaceView, RefusesWhatCannotBeDrawn) {
    const TriangleMesh box = box_mesh(glm::dvec3(-1.0), glm::dvec3(1.0));
    EXPECT_THROW(render_subsurface(box, potato(), {}, {}, 0, 4), InputError);
    EXPECT_THROW(render_subsurface({}, potato(), {}, {}, 4, 4), InputError);
    SubsurfaceMedium clear = potato();
    clear.sigma_s.y = 0.0;
    EXPECT_THROW(render_subsurface(box, clear, {}, {}, 4, 4), InputError);
}

}  // namespace
}  // namespace bruma::reference
