// Shelf: double-precision reference, and published exitances of spheres. The light inside translucent meshes, through
// all passes.
#include <array>
#include <cmath>
#include <numbers>

#include "subsurface_truth.h"
#include "translucent_truth.h"

namespace bruma::render {
namespace {

using std::numbers::pi;

class Translucent : public Drawing {
  protected:
    Image draw_after(const scene::Scene& scene, glm::ivec2 pixels, int passes) {
        Renderer renderer(shaders());
        renderer.render(scene, view_of(pixels, passes));
        Image image = renderer.read_picture();
        EXPECT_TRUE(all_finite(image));
        return image;
    }
};

const scene::Light front_lamp{
    .kind = scene::LightKind::directional, .direction_world = {0.5, 0.4, 0.8}, .color = {1.0, 0.8, 0.6}};

scene::SubsurfaceMedium same_in_all_channels(const reference::SubsurfaceChannel& channel, double scale = 1.0) {
    scene::SubsurfaceMedium medium;
    medium.reduced_scattering = glm::dvec3(channel.sigma_s * (1.0 - channel.g) * scale);
    medium.absorption = glm::dvec3(channel.sigma_a * scale);
    medium.refraction_index = channel.eta;
    return medium;
}

/// Exitance over E_perp of a sphere of radius 10 mm lit along z, averaged over ten equal steps of the cosine of the
/// angle from the lit pole: in a picture taken from the side each column of pixels stands for one cosine.
std::array<double, 10> exitance_bins(const scene::Scene& scene, const Image& image, double eta, int channel) {
    std::array<double, 10> sums{}, weights{};
    const double radius = 0.010;
    std::vector<std::array<double, 3>> seen;  // cosine, exitance
    std::vector<int> of_step(1000, 0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const scene::Ray ray = scene::camera_ray(**scene.camera, x + 0.5, y + 0.5, image.width, image.height);
            const double b = glm::dot(ray.origin_world, ray.direction_world);
            const double root = b * b - glm::dot(ray.origin_world, ray.origin_world) + radius * radius;
            if (root < 0.0) {
                continue;
            }
            const glm::dvec3 p = (ray.origin_world + (-b - std::sqrt(root)) * ray.direction_world) / radius;
            const double facing = -glm::dot(p, ray.direction_world);
            if (facing > 0.12) {
                const double inside = image.pixel(x, y)[channel] / reference::fresnel_transmittance(facing, eta);
                const int step = int((p.z + 1.0) * 0.5 * image.width);
                seen.push_back({p.z, inside * 4.0 * pi * reference::diffuse_boundary(eta).c_phi_inverse, double(step)});
                ++of_step[std::size_t(step)];
            }
        }
    }
    for (const auto& [cosine, exitance, step] : seen) {
        const auto bin = std::min<std::size_t>(9, std::size_t((cosine + 1.0) * 5.0));
        const double weight = 1.0 / of_step[std::size_t(step)];
        sums[bin] += weight * exitance;
        weights[bin] += weight;
    }
    for (std::size_t n = 0; n < 10; ++n) {
        sums[n] /= weights[n];
    }
    return sums;
}

TEST_F(Translucent, SpheresSendOutWhatQuadratureOfTheDipoleSays) {
    const auto& truths = reference::sphere_truths;
    // Two bodies with one index of refraction in one picture; the smaller one's lengths are doubled, and its
    // coefficients halved, which changes nothing.
    scene::SubsurfaceMedium pair = same_in_all_channels(truths[1].channel);
    const scene::SubsurfaceMedium ketchup = same_in_all_channels(truths[2].channel, truths[2].radius / 10.0);
    pair.reduced_scattering.x = ketchup.reduced_scattering.x;
    pair.absorption.x = ketchup.absorption.x;
    struct Case {
        scene::SubsurfaceMedium medium;
        int truth, channel;
    };
    const auto sphere = builtin_triangles("mesh-sphere");
    for (const Case& c : {Case{same_in_all_channels(truths[0].channel), 0, 1}, Case{pair, 1, 1}, Case{pair, 2, 0}}) {
        scene::Scene scene;
        add_translucent(scene, "ball", sphere, c.medium).subsurface.edit([](scene::SubsurfaceSettings& settings) {
            settings.maps = 6;
            settings.map_size = 128;
        });
        scene.lights["key"] = scene::Light{.direction_world = {0.0, 0.0, 1.0}, .intensity = 1.0};
        scene.camera = parallel_camera_around(scene, {1.0, 0.0, 0.0});
        const auto& truth = truths[std::size_t(c.truth)];
        const Image image = draw_after(scene, {120, 120}, 6);
        const std::array<double, 10> bins = exitance_bins(scene, image, truth.channel.eta, c.channel);
        for (std::size_t n = 0; n < bins.size(); ++n) {
            // One percent of the quadrature behind the numbers, one of noise and the maps' texels.
            EXPECT_NEAR(bins[n], truth.dipole[n], 0.02 * truth.dipole[n]) << truth.name << ", bin " << n;
            report(std::string(truth.name) + ", bin " + std::to_string(n) + ", over the truth",
                   bins[n] / truth.dipole[n]);
        }
    }
}

/// A knot that shades itself, stretched and mirrored, in a medium with a third of a millimetre (blue) to four (red)
/// between the place where light enters and where e^-1 of it is left.
scene::Scene knot_scene() {
    scene::Scene scene;
    add_translucent(scene, "knot", builtin_triangles("mesh-knot"), scene::medium_of(scene::Material::skin1));
    scene.nodes.at("knot").transform =
        scene::Transform{.rotation_deg = {20.0, -30.0, 10.0}, .scale = {0.8, -0.7, 0.75}};
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    scene.lights["key"] = front_lamp;
    scene.camera = parallel_camera_around(scene, {0.1, 0.2, 1.0});
    scene.camera->edit([](scene::Camera& camera) { camera.view_height *= 0.6; });
    return scene;
}

TEST_F(Translucent, AKnotUnderEachKindOfLightIsTheQuadratureOverItsSurface) {
    const scene::Light lamps[] = {
        front_lamp,
        {.kind = scene::LightKind::directional, .direction_world = {-0.3, 0.2, -1.0}},
        {.kind = scene::LightKind::point, .position_world = {0.03, 0.06, 0.05}, .intensity = 0.01}};
    const std::string names[] = {"from the front", "from behind", "beside it"};
    scene::Scene scene = knot_scene();
    const glm::ivec2 pixels(11, 11);
    for (std::size_t n = 0; n < std::size(lamps); ++n) {
        scene.lights.at("key") = lamps[n];
        const Image truth = quadrature_picture(scene, pixels);
        scene::Scene alone = scene;
        work_out_each_pixel(alone);
        const Apart points = apart(draw_after(alone, pixels, passes_of_each_pixel), truth);
        report(names[n] + ", each pixel by itself", points);
        ASSERT_GT(points.compared, 90);
        // Noise of 4096 points: 0.5 to 3 in units of the value over 64. It halves the mean 14 times over.
        EXPECT_LE(points.rmse, 0.04) << names[n];
        EXPECT_LE(std::abs(points.mean), 0.006) << names[n];
        EXPECT_LE(std::abs(points.of_all), 0.005) << names[n];
    }
}

TEST_F(Translucent, MapsComeCloserToEachPixelByItselfWithSmallerTexels) {
    scene::Scene scene = knot_scene();
    const glm::ivec2 pixels(48, 48);
    scene::Scene alone = scene;
    work_out_each_pixel(alone);
    const Image truth = draw_after(alone, pixels, passes_of_each_pixel);
    // Light, of which blue is down to e^-1 after 0.7 mm, is smeared over texels of 1.4, 0.7 and 0.5 mm. Noise of 192
    // points in each of them, and of 4096 in each pixel, makes 0.04 of the last.
    const std::pair<int, double> sizes[] = {{32, 0.19}, {64, 0.08}, {96, 0.06}};
    for (const auto& [size, most] : sizes) {
        std::get<scene::Mesh>(scene.nodes.at("knot").content)
            .subsurface.edit([edge = size](scene::SubsurfaceSettings& settings) { settings.map_size = edge; });
        const Apart maps = apart(draw_after(scene, pixels, 12), truth);
        report(std::to_string(size) + " texels along an edge", maps);
        EXPECT_LE(maps.rmse, most) << size;
        EXPECT_LE(std::abs(maps.mean), 0.2 * most) << size << ": smeared borders brighten what is dark";
        EXPECT_LE(std::abs(maps.of_all), 0.08 * most) << size;
    }
}

TEST_F(Translucent, OnePassAloneHasNoBias) {
    scene::Scene scene;
    scene::Mesh& mesh =
        add_translucent(scene, "knot", builtin_triangles("mesh-knot"), scene::medium_of(scene::Material::potato));
    scene.lights["key"] = scene::Light{.direction_world = {0.5, 0.4, 0.8}};
    scene.camera = parallel_camera_around(scene, {0.1, 0.2, 1.0});
    const auto mean = [](const Image& image) {
        glm::dvec3 sum(0.0);
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                for (int c = 0; c < 3; ++c) {
                    sum[c] += image.pixel(x, y)[3] > 0.5F ? image.pixel(x, y)[c] : 0.0;
                }
            }
        }
        return sum;
    };
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    const glm::dvec3 truth = mean(draw_after(scene, {96, 96}, 32));
    for (const int samples : {1, 4}) {
        mesh.subsurface.edit([&](scene::SubsurfaceSettings& settings) { settings.samples = samples; });
        const glm::dvec3 first = mean(draw_after(scene, {96, 96}, 1));
        for (int c = 0; c < 3; ++c) {
            // Some 10 000 texels, each 60 to 200 % off with one point: 2 %. Dividing by accepted points, by maps, or
            // without empty ones would be off by more than 30 %.
            EXPECT_NEAR(first[c] / truth[c], 1.0, 0.06) << samples << " samples, channel " << c;
            report("first pass over converged, " + std::to_string(samples) + " samples", first[c] / truth[c]);
        }
    }
}

TEST_F(Translucent, WhatStandsBehindWeakMatterShinesThrough) {
    scene::SubsurfaceMedium tea;
    tea.absorption = {0.02, 0.1, 0.3};
    tea.reduced_scattering = glm::dvec3(1e-6);
    tea.refraction_index = 1.3;
    scene::Scene scene;
    scene::Mesh& ball = add_translucent(scene, "ball", builtin_triangles("mesh-sphere"), tea);
    scene.environment = scene::Environment{.radiance = {1.0, 2.0, 3.0}};
    scene.camera = parallel_camera_around(scene, {0.3, 0.2, 1.0});
    const Image image = draw_after(scene, {65, 65}, 1);
    ball.subsurface.edit([](scene::SubsurfaceSettings& settings) { settings.unscattered = false; });
    const Image without = draw_after(scene, {65, 65}, 1);
    const double passing = reference::fresnel_transmittance(1.0, 1.3);
    for (int c = 0; c < 3; ++c) {
        // Through the middle of the ball, 20 mm long; facets are off by 5e-4 of its radius.
        const double expected = (c + 1.0) * passing * passing * std::exp(-20.0 * tea.absorption[c]);
        EXPECT_NEAR(image.pixel(32, 32)[c] - without.pixel(32, 32)[c], expected, 5e-3 * expected) << c;
    }
}

TEST_F(Translucent, RadianceDependsOnCoefficientTimesLengthAlone) {
    Image images[2];
    for (int n = 0; n < 2; ++n) {
        const double scale = n == 0 ? 1.0 : 8.0;  // a power of two, so that all roundings are the same
        scene::SubsurfaceMedium medium = scene::medium_of(scene::Material::skin2);
        medium.absorption *= scale;
        medium.reduced_scattering *= scale;
        scene::Scene scene;
        add_translucent(scene, "knot", builtin_triangles("mesh-knot"), medium);
        scene.nodes.at("knot").transform = scene::Transform{.scale = glm::dvec3(1.0 / scale)};
        scene.lights["key"] = scene::Light{.direction_world = {0.5, 0.4, 0.8}};
        scene.camera = parallel_camera_around(scene, {0.1, 0.2, 1.0});
        images[n] = draw_after(scene, {40, 40}, 2);
    }
    // Guards against denormal numbers and the polar decomposition round a last digit here and there.
    EXPECT_LE(largest_difference(images[0], images[1]), 2e-3);
    report("coefficients times 8, lengths over 8", largest_difference(images[0], images[1]));
}

}  // namespace
}  // namespace bruma::render
