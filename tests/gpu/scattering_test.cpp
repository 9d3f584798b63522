// Pictures of media that scatter, and which passes light needs. Shelves: closed form and reference, said at each test.
#include <algorithm>
#include <cmath>

#include "base/installation.h"
#include "drawing.h"
#include "measure/metrics/image_error.h"
#include "reference/medium/render_scattering.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

using Scattering = Drawing;
using Names = std::vector<std::string>;

scene::Scene scattering_scene(std::shared_ptr<const scene::VolumeGrid> grid, scene::TransferFunction tf) {
    scene::Scene scene = scene_with(std::move(grid), std::move(tf));
    scene.camera = oblique_camera(scene);
    volume_in(scene).optics.edit(
        [](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::light_volume; });
    volume_in(scene).light_volume.edit([](scene::LightVolumeSettings& settings) { settings.diffuse = false; });
    scene.lights["sun"] = scene::Light{.direction_world = {-0.6, 0.8, 0.5}, .intensity = 12.0};
    return scene;
}

scene::Scene blobs_scene() {
    const auto grid = grid_of(glm::ivec3(32), glm::dvec3(0.03), [](glm::ivec3 at) {
        const glm::dvec3 x = (glm::dvec3(at) + 0.5) / 32.0;
        double sum = 0.0;
        for (const glm::dvec3 centre :
             {glm::dvec3(0.3, 0.35, 0.6), glm::dvec3(0.68, 0.6, 0.35), glm::dvec3(0.5, 0.75, 0.7)}) {
            const glm::dvec3 way = x - centre;
            sum += std::exp(-glm::dot(way, way) / 0.02);
        }
        return sum;
    });
    scene::TransferFunction tf;
    tf.window = {0.0, 1.0};
    tf.opacity = {{0.1, 0.0}, {1.0, 0.2}};
    tf.color = {{0.0, {0.9, 0.6, 0.3}}, {1.0, {0.3, 0.7, 0.9}}};
    tf.reference_length = 0.03;
    return scattering_scene(grid, tf);
}

/// Single scattering in double precision: its picture and the error of ours, with display range 1.
double error_of(const Image& image, const scene::Scene& scene, glm::ivec2 pixels) {
    reference::ScatteringOptions options;
    options.paths = reference::LightPaths::single;
    options.tolerance = 1e-4;
    const auto expected = reference::render_scattering(scene, pixels.x, pixels.y, options);
    return measure::compare_images(image, expected.image).rmse;
}

TEST_F(Scattering, SlabSingleScatteringInClosedForm) {
    // Homogeneous slab, sigma H = 3, albedo 0.8, g = 0.3, E = 1, eye on the normal (Chandrasekhar, Radiative Transfer):
    // L = w p E / k (1 - exp(-sigma H k)), k = 1 + 1 / mu.
    for (const auto& [cosine, expected] : {std::pair(1.0, 0.013151752), std::pair(0.5, 0.011782148)}) {
        scene::Scene scene = scattering_scene(
            grid_of({128, 128, 32}, {8e-3, 8e-3, 1.0 / 32}, [](glm::ivec3) { return 0.5; }), uniform_extinction(3.0));
        volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) {
            tf.color = {{0.0, glm::dvec3(1.0)}};
        });
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) {
            optics.albedo = glm::dvec3(0.8);
            optics.g = 0.3;
        });
        scene.lights["sun"] =
            scene::Light{.direction_world = {std::sqrt(1.0 - cosine * cosine), 0.0, cosine}, .intensity = 1.0};
        // The slab is 1 m thick and 128 m wide in effect: light enters through its face alone where we look.
        scene.nodes.at("volume").transform = scene::Transform{.scale = {100.0, 100.0, 1.0}};
        scene.camera = scene::Camera{.projection = scene::Projection::orthographic,
                                     .eye_world = {0.0, 0.0, 3.0},
                                     .target_world = glm::dvec3(0.0),
                                     .view_height = 0.1};
        settle(scene, Classification::post, 0.05);
        for (const auto lighting : {scene::VolumeLighting::light_volume, scene::VolumeLighting::shadow_rays}) {
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
            const Image image = draw(scene, {3, 3});
            report("radiance over expected", image.pixel(1, 1)[0] / expected);
            // Light is looked up between cells 1/16 of the slab apart: curvature (k sigma / 16)^2 / 8.
            EXPECT_NEAR(image.pixel(1, 1)[0] / expected, 1.0, 0.01);
        }
    }
}

/// A slab of 1 m, in effect without sides, seen and lit along its normal.
scene::Scene slab_lit_from_the_eye(double optical_depth, double albedo) {
    scene::Scene scene = scattering_scene(grid_of({8, 8, 64}, {8e-3, 8e-3, 1.0 / 64}, [](glm::ivec3) { return 0.5; }),
                                          uniform_extinction(optical_depth));
    volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) { tf.color = {{0.0, glm::dvec3(1.0)}}; });
    volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.albedo = glm::dvec3(albedo); });
    volume_in(scene).light_volume.edit([](scene::LightVolumeSettings& settings) {
        settings.diffuse = true;
        settings.spread = 0.0;
        settings.precision = scene::LightPrecision::single;
    });
    scene.lights["sun"] = scene::Light{.direction_world = {0.0, 0.0, 1.0}, .intensity = 1.0};
    scene.nodes.at("volume").transform = scene::Transform{.scale = {100.0, 100.0, 1.0}};
    scene.camera = scene::Camera{.projection = scene::Projection::orthographic,
                                 .eye_world = {0.0, 0.0, 3.0},
                                 .target_world = glm::dvec3(0.0),
                                 .view_height = 0.1};
    settle(scene, Classification::post, 0.05);
    return scene;
}

TEST_F(Scattering, DiffuseLightOfASlabInClosedForm) {
    // With the sweep's own model, direct light exp(-s) and diffuse light exp(-(1 - w) s) - exp(-s) at optical depth s,
    // both scattered evenly towards the eye: L = w E / 4 pi (1 - exp(-(2 - w) d)) / (2 - w). A lookup that only
    // interpolates cells, sixteen over a depth of 6, is off by several percent; one that follows the recurrence over
    // the last stretch is left with the curvature of what it starts from.
    const double pi = std::acos(-1.0);
    for (const double albedo : {0.5, 0.9, 1.0}) {
        for (const double depth : {1.0, 6.0}) {
            const double expected = albedo / (4.0 * pi) * -std::expm1(-(2.0 - albedo) * depth) / (2.0 - albedo);
            scene::Scene scene = slab_lit_from_the_eye(depth, albedo);
            const double ratio = draw(scene, {3, 3}).pixel(1, 1)[0] / expected;
            report("albedo " + std::to_string(albedo) + ", depth " + std::to_string(depth) + ": over closed form",
                   ratio);
            EXPECT_NEAR(ratio, 1.0, 0.01);
        }
    }
}

TEST_F(Scattering, Test16ShadowRaysKeepAnEdgeWithinTwoVoxels) {
    // Closed form: the shadow of a straight edge is a step, at any angle of the light. What widens it is the data's own
    // interpolation at the wall's end (one voxel) and that of the cells of light (one more).
    constexpr int n = 64, fine = 4;
    for (const double shift : {0.1, 0.25, 0.5}) {
        scene::Scene scene =
            scattering_scene(grid_of({n, 4, n}, glm::dvec3(0.01),
                                     [](glm::ivec3 at) { return at.z >= n - 3 && at.x < n / 4 ? 1.0 : 0.2; }),
                             {});
        volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) {
            tf.window = {0.0, 1.0};
            tf.color = {{0.0, glm::dvec3(1.0)}};
            tf.opacity = {{0.0, 1e-3}, {0.4, 1e-3}, {0.6, 0.9999}, {1.0, 0.9999}};
            tf.reference_length = 0.005;
        });
        volume_in(scene).optics.edit(
            [](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::shadow_rays; });
        volume_in(scene).light_volume.edit(
            [](scene::LightVolumeSettings& settings) { settings.resolution = scene::LightResolution::full; });
        scene.lights["sun"] = scene::Light{.direction_world = {-shift, 0.0, 1.0}, .intensity = 10.0};
        // Looking along y, x to the left, `fine` pixels per voxel; the bottom rows are the slice farthest from the
        // wall.
        scene.camera = scene::Camera{.projection = scene::Projection::orthographic,
                                     .eye_world = {0.0, 3.0, 0.0},
                                     .target_world = glm::dvec3(0.0),
                                     .up_world = {0.0, 0.0, 1.0},
                                     .view_height = 0.64};
        settle(scene, Classification::post, 0.5);
        const Image image = draw(scene, glm::ivec2(n * fine));
        std::vector<double> row;  // along x
        for (int x = 0; x < n * fine; ++x) {
            row.push_back(image.pixel(n * fine - 1 - x, n * fine - fine / 2)[0]);
        }
        // Light enters below the wall too, through the side: what is sought is the way from the darkest place to the
        // light behind the wall's end.
        const int darkest = int(std::min_element(row.begin(), row.end()) - row.begin());
        const double lit = row[n * fine - 8];
        const auto crossing = [&](double level) {
            int x = darkest;
            while (x + 1 < n * fine && row[std::size_t(x)] < level * lit) {
                ++x;
            }
            const double before = row[std::size_t(std::max(x - 1, 0))];
            return (x - 0.5 + (level * lit - before) / (row[std::size_t(x)] - before)) / fine;  // voxels
        };
        const double width = crossing(0.9) - crossing(0.1);
        report("voxels from 10 to 90 % at shift " + std::to_string(shift), width);
        EXPECT_LT(row[std::size_t(darkest)], 0.01 * lit);
        EXPECT_GT(width, 0.01);
        EXPECT_LE(width, 2.0);
        EXPECT_NEAR(crossing(0.5), n / 4 + shift * (n - 3), 1.5);  // where geometry has it
    }
}

TEST_F(Scattering, HalfResolutionAgainstTheReference) {
    for (const bool bucky : {false, true}) {
        scene::Scene scene = blobs_scene();
        if (bucky) {
            const auto grid = scene::builtin_volume("bucky");
            scene = scattering_scene(grid, scene::suggested_transfer_function(*grid));
        }
        for (const auto lighting : {scene::VolumeLighting::light_volume, scene::VolumeLighting::shadow_rays}) {
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
            const double error = error_of(draw(scene, {48, 48}), scene, {48, 48});
            report(std::string(bucky ? "bucky" : "blobs") + ", RMSE against single scattering", error);
            EXPECT_LE(error, 0.01);  // asked for: 0.02; measured 0.001 to 0.007
        }
        scene.lights["lamp"] = scene::Light{.kind = scene::LightKind::point,
                                            .position_world = {0.002, 0.001, 0.003},
                                            .color = {0.3, 0.6, 1.0},
                                            .intensity = 1e-3};
        const double error = error_of(draw(scene, {48, 48}), scene, {48, 48});
        report("with a lamp inside", error);
        EXPECT_LE(error, 0.02);
    }
}

TEST_F(Scattering, Test18LooksBrighterTowardsTheLightWhenForward) {
    // Closed form: the sign of g.
    double brightness[2] = {};
    for (int n = 0; n < 2; ++n) {
        scene::Scene scene = blobs_scene();
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.g = 0.8; });
        const glm::dvec3 back = n == 0 ? glm::dvec3(0.6, -0.8, -0.5) : glm::dvec3(-0.6, 0.8, 0.5);
        scene.camera = oblique_camera(scene, back);
        const Image image = draw(scene, {24, 24});
        for (int k = 0; k < 24 * 24; ++k) {
            brightness[n] += image.rgba[std::size_t(k) * 4];
        }
    }
    EXPECT_GT(brightness[0], 3.0 * brightness[1]);
}

TEST_F(Scattering, Test23TwoLightsAreTheSumOfEach) {
    // Closed form, also with the same light twice and with two volumes; samplers of several lights must not be mixed
    // up.
    for (const bool two_volumes : {false, true}) {
        scene::Scene scene = blobs_scene();
        settle(scene, Classification::preintegrated, 1.0, false);
        volume_in(scene).light_volume.edit([](scene::LightVolumeSettings& settings) { settings.diffuse = true; });
        if (two_volumes) {
            scene.nodes["second"] = scene.nodes.at("volume");
            scene.nodes["second"].transform =
                scene::Transform{.translation = {0.02, 0.01, -0.02}, .rotation_deg = {30.0, 70.0, 0.0}};
            volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.g = 0.5; });
        }
        scene.lights.clear();
        const std::map<std::string, scene::Light> lights{
            {"a", {.direction_world = {-0.6, 0.8, 0.5}, .color = {1.0, 0.5, 0.2}, .intensity = 9.0}},
            {"b", {.direction_world = {0.9, 0.1, 0.3}, .color = {0.1, 0.5, 1.0}, .intensity = 5.0}},
            {"c",
             {.kind = scene::LightKind::point,
              .position_world = {0.02, 0.0, 0.03},
              .color = {0.2, 1.0, 0.2},
              .intensity = 4e-2}},
            {"d",
             {.kind = scene::LightKind::spot,
              .direction_world = {0.0, 1.0, 0.2},
              .position_world = {0.0, 0.05, 0.01},
              .intensity = 2e-1}}};
        Image sum(24, 24);
        for (const auto& [name, light] : lights) {
            scene.lights.clear();
            scene.lights[name] = light;
            const Image one = draw(scene, {24, 24});
            double most = 0.0;
            for (std::size_t n = 0; n < sum.rgba.size(); ++n) {
                sum.rgba[n] = n % 4 == 3 ? one.rgba[n] : sum.rgba[n] + one.rgba[n];
                most = std::max(most, n % 4 == 3 ? 0.0 : double(one.rgba[n]));
            }
            EXPECT_GT(most, 0.01) << name << " adds nothing";
        }
        for (const auto& [name, light] : lights) {
            scene.lights[name] = light;
        }
        const double difference = largest_difference(draw(scene, {24, 24}), sum);
        report("largest difference from the sum", difference);
        EXPECT_LE(difference, 1e-5);
    }
}

TEST_F(Scattering, BlackMatterAndDarkLightsCostNothing) {
    gl::ShaderLibrary own(installed_folder("shaders"));
    Renderer renderer(own);
    scene::Scene scene = blobs_scene();
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.albedo = glm::dvec3(0.0); });
    renderer.render(scene, {{8, 8}, 1.0});
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.albedo = glm::dvec3(1.0); });
    scene.lights["sun"].edit([](scene::Light& light) { light.intensity = 0.0; });
    const RunReport& report = renderer.render(scene, {{8, 8}, 1.0});
    for (const PassReport& pass : report) {
        EXPECT_EQ(pass.name.find("light"), std::string::npos) << pass.name;
    }
    for (const std::string& name : own.compiled_names()) {
        EXPECT_EQ(name.find("light_"), std::string::npos) << name;
    }
    for (const float value : renderer.read_picture().rgba) {
        EXPECT_TRUE(std::isfinite(value));
    }
}

class LightPins : public Drawing {
  protected:
    void SetUp() override {
        Drawing::SetUp();
        if (!IsSkipped()) {
            renderer = std::make_unique<Renderer>(shaders());
            volume_in(scene).light_volume.edit([](scene::LightVolumeSettings& settings) { settings.diffuse = true; });
            scene.lights["lamp"] =
                scene::Light{.kind = scene::LightKind::point, .position_world = {0.02, 0.02, 0.02}, .intensity = 1e-3};
            reruns();
        }
    }
    void TearDown() override {
        renderer.reset();
        Drawing::TearDown();
    }
    Names reruns() {
        Names names;
        for (const PassReport& report : renderer->render(scene, {{8, 8}, 1.0})) {
            if (report.ran) {
                names.push_back(report.name);
            }
        }
        std::sort(names.begin(), names.end());
        return names;
    }

    scene::Scene scene = blobs_scene();
    std::unique_ptr<Renderer> renderer;
    const Names lamp_sweeps{"march", "volume: diffuse light of all", "volume: diffuse light of lamp",
                            "volume: light of all", "volume: light of lamp"};
    const Names all_light{"march",
                          "volume: diffuse light medium",
                          "volume: diffuse light of all",
                          "volume: diffuse light of lamp",
                          "volume: diffuse light of sun",
                          "volume: light medium",
                          "volume: light of all",
                          "volume: light of lamp",
                          "volume: light of sun"};
};

TEST_F(LightPins, TheCameraRerunsNoSweep) {
    scene.camera->edit([](scene::Camera& camera) { camera.eye_world.x += 0.01; });
    EXPECT_EQ(reruns(), Names{"march"});
}

TEST_F(LightPins, ALightRerunsItsOwnSweeps) {
    scene.lights["lamp"].edit([](scene::Light& light) { light.position_world.x += 0.001; });
    EXPECT_EQ(reruns(), lamp_sweeps);
    // Colour and intensity are factors of what was swept.
    scene.lights["lamp"].edit([](scene::Light& light) { light.color = {1.0, 0.2, 0.1}; });
    EXPECT_EQ(reruns(), Names{"march"});
    scene.lights["lamp"].edit([](scene::Light& light) { light.on = false; });
    EXPECT_EQ(reruns(), Names{"march"});
    scene.lights["lamp"].edit([](scene::Light& light) { light.on = true; });
    EXPECT_EQ(reruns(), lamp_sweeps);
}

TEST_F(LightPins, OpticsRerunWhatTheyConcern) {
    const auto edit = [&](auto change) { volume_in(scene).optics.edit(change); };
    edit([](scene::VolumeOptics& optics) { optics.g = 0.5; });
    EXPECT_EQ(reruns(), Names{"march"});
    edit([](scene::VolumeOptics& optics) { optics.albedo = glm::dvec3(0.5); });
    EXPECT_EQ(reruns(), (Names{"march", "volume: diffuse light medium", "volume: diffuse light of all",
                               "volume: diffuse light of lamp", "volume: diffuse light of sun", "volume: tables"}));
    edit([](scene::VolumeOptics& optics) { optics.emission = 0.5; });
    EXPECT_EQ(reruns(), (Names{"march", "volume: tables"}));
    Names with_tables = all_light;
    with_tables.push_back("volume: tables");
    edit([](scene::VolumeOptics& optics) { optics.density_scale = 2.0; });
    EXPECT_EQ(reruns(), with_tables);
}

TEST_F(LightPins, TransferFunctionClipAndPlaceRerunAllLight) {
    volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) { tf.opacity.push_back({0.97, 0.11}); });
    Names expected = all_light;
    expected.insert(expected.end(), {"volume: occupancy", "volume: tables"});
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(reruns(), expected);
    volume_in(scene).clip = scene::ClipBox{{0.0, 0.0, 0.0}, {0.7, 1.0, 1.0}};
    EXPECT_EQ(reruns(), all_light);
    scene.nodes.at("volume").transform = scene::Transform{.rotation_deg = {0.0, 30.0, 0.0}};
    EXPECT_EQ(reruns(), all_light);
}

TEST_F(LightPins, SettingsOfTheLightRerunWhatTheyConcern) {
    const auto edit = [&](auto change) { volume_in(scene).light_volume.edit(change); };
    edit([](scene::LightVolumeSettings& settings) { settings.spread = 0.1; });
    EXPECT_EQ(reruns(), (Names{"march", "volume: diffuse light of all", "volume: diffuse light of lamp",
                               "volume: diffuse light of sun"}));
    edit([](scene::LightVolumeSettings& settings) { settings.near_steps = 1; });
    EXPECT_EQ(reruns(), Names{"march"});
    edit([](scene::LightVolumeSettings& settings) { settings.diffuse = false; });
    EXPECT_EQ(reruns(), Names{"march"});
    scene.rendering.edit([](scene::RenderSettings& settings) { settings.step = 0.5; });
    EXPECT_EQ(reruns(), (Names{"march", "volume: tables"}));
}

}  // namespace
}  // namespace bruma::render
