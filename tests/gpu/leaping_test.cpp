// Shelf: closed form. Leaping over what is empty changes no bit; ending early changes no more than its bound.
#include <algorithm>
#include <cmath>
#include <random>

#include "drawing.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

scene::Scene builtin_like(std::shared_ptr<const scene::VolumeGrid> grid, scene::TransferFunction tf) {
    scene::Scene scene = scene_with(std::move(grid), std::move(tf));
    scene.camera = oblique_camera(scene);
    return scene;
}

TEST_F(Drawing, Test06EarlyTermination) {
    for (const char* const name : {"bucky", "marschner-lobb"}) {
        const auto grid = scene::builtin_volume(name);
        scene::Scene scene = builtin_like(grid, scene::suggested_transfer_function(*grid));
        // Thick enough that most rays end; colours are at most 1 and nothing is lit, so the bound is on radiance 1.
        volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { optics.density_scale = 20.0; });
        scene.background = scene::Background{.top = glm::dvec3(1.0), .bottom = glm::dvec3(1.0)};
        for (const Classification classification : both_classifications) {
            settle(scene, classification, 0.5);
            const Image whole = draw(scene, {64, 64});
            const std::uint64_t all_samples = count(scene, {64, 64}).samples;
            double last = 1.0;
            for (const double stop : {0.05, 1.0 / 510.0, 1.0 / 6600.0}) {
                scene.rendering.edit([&](scene::RenderSettings& settings) {
                    settings.early_termination = true;
                    settings.stop_transmittance = stop;
                });
                const double difference = largest_difference(draw(scene, {64, 64}), whole);
                // 1e-6 is the float rounding of sums near 1.
                EXPECT_LE(difference, stop + 1e-6) << name << ", " << name_of(classification) << ", stop " << stop;
                EXPECT_LE(difference, last);
                last = difference;
                EXPECT_LT(count(scene, {64, 64}).samples, all_samples) << "else nothing ended early";
            }
        }
    }
}

/// Every kind of data that leaping may meet.
std::shared_ptr<const scene::VolumeGrid> random_volume(int kind, std::mt19937& generator) {
    const auto seed = std::uint32_t(generator());
    const glm::ivec3 size(7 + int(generator() % 30), 7 + int(generator() % 30), 7 + int(generator() % 30));
    const glm::dvec3 spacing = kind % 3 == 2 ? glm::dvec3(1.0, 1.7, 0.6) : glm::dvec3(1.0);
    return grid_of(size, spacing, [&](glm::ivec3 at) {
        switch (kind % 4) {
            case 0:
                return noise(at, seed);
            case 1:
                return noise(at / 6, seed) > 0.7 ? noise(at, seed) : 0.1 * noise(at / 3, seed + 1);
            case 2:
                return std::exp(-0.02 * double(glm::dot(glm::dvec3(at - size / 2), glm::dvec3(at - size / 2))));
            default:
                return at == size / 3 ? 1.0 : 0.0;
        }
    });
}

scene::TransferFunction random_transfer_function(int kind, std::mt19937& generator) {
    std::uniform_real_distribution<double> unit;
    scene::TransferFunction tf;
    tf.reference_length = 3.0;
    tf.color = {{0.0, {unit(generator), 0.3, 0.8}}, {1.0, {0.2, unit(generator), 0.1}}};
    const double peak = 0.1 + 0.8 * unit(generator);
    switch (kind) {
        case 0:
            tf.opacity = {{0.0, 0.0}};
            break;  // nothing
        case 1:
            tf.opacity = {{0.0, 0.3}, {1.0, 0.6}};
            break;  // everything
        case 2:
            tf.opacity = {{peak - 0.002, 0.0}, {peak, 0.9}, {peak + 0.002, 0.0}};
            break;  // a sharp peak
        case 3:
            tf.opacity = {{0.5, 0.0}, {0.5, 0.7}};
            break;  // a step
        case 4:
            tf.opacity = {{0.2, 0.0}, {0.3, 0.5}, {0.4, 0.0}, {0.8, 0.0}, {1.0, 1.0}};
            break;  // two
        case 5:
            tf.opacity = {{0.0, 0.9}, {0.05, 0.0}};
            break;  // the lowest end
        case 6:
            tf.window = {0.4, 0.5};  // narrower than the data
            tf.opacity = {{0.2, 0.0}, {0.5, 0.5}, {0.8, 0.0}};
            break;
        default:
            tf.window = {0.9, 0.3};  // reversed
            tf.opacity = {{0.3, 0.0}, {0.9, 0.8}};
            break;
    }
    return tf;
}

std::vector<scene::Camera> cameras(const scene::Scene& scene) {
    const scene::Bounds bounds = scene::world_bounds(scene);
    std::vector<scene::Camera> result;
    for (const glm::dvec3 back : {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(0.5, 0.35, -0.9)}) {
        for (const scene::Projection projection : {scene::Projection::perspective, scene::Projection::orthographic}) {
            scene::Camera camera = scene::fit_camera(bounds, 1.0, back);
            camera.projection = projection;
            result.push_back(camera);
        }
    }
    scene::Camera inside = result[0];
    inside.eye_world = 0.6 * bounds.low + 0.4 * bounds.high;
    inside.vertical_angle_deg = 90.0;
    result.push_back(inside);
    return result;
}

class Leaping : public Drawing {
  protected:
    /// Draws with and without leaping and compares every bit.
    void expect_same_bits(scene::Scene& scene, glm::ivec2 pixels, const std::string& what) {
        // One renderer for both, so that the tables are made once.
        Renderer renderer(shaders());
        Image images[2];
        for (const bool leap : {false, true}) {
            scene.rendering.edit([&](scene::RenderSettings& settings) { settings.empty_space_skipping = leap; });
            bool marched = false;
            for (const PassReport& pass : renderer.render(scene, {pixels, 1.0})) {
                marched = marched || (pass.name == "march" && pass.ran);
            }
            ASSERT_TRUE(marched) << "else a picture is compared with itself";
            images[leap ? 1 : 0] = renderer.read_picture();
            EXPECT_TRUE(all_finite(images[leap ? 1 : 0]));
        }
        const auto& [walked, leapt] = images;
        EXPECT_TRUE(same_bits(leapt, walked)) << what << ": differ by " << largest_difference(leapt, walked);
    }
    /// Share of the samples that leaping leaves out.
    double skipped_share(scene::Scene& scene, glm::ivec2 pixels) {
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.empty_space_skipping = true; });
        const double leapt = double(count(scene, pixels).samples);
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.empty_space_skipping = false; });
        return 1.0 - leapt / double(count(scene, pixels).samples);
    }
};

TEST_F(Leaping, Test07RandomVolumesBitForBit) {
    std::mt19937 generator(2024);
    double most = 0.0, sum = 0.0;
    int counted = 0;
    for (int kind = 0; kind < 8; ++kind) {
        const auto grid = random_volume(kind, generator);
        for (int tf_kind = 0; tf_kind < 8; ++tf_kind) {
            scene::Scene scene = scene_with(grid, random_transfer_function(tf_kind, generator));
            scene.background = scene::Background{.top = {0.2, 0.4, 0.6}, .bottom = {0.6, 0.4, 0.2}};
            if (generator() % 3 == 0) {
                volume_in(scene).clip = scene::ClipBox{{0.1, 0.23, 0.0}, {0.77, 1.0, 0.9}};
            }
            const std::vector<scene::Camera> views = cameras(scene);
            for (const Classification classification : both_classifications) {
                for (const double step : {0.3, 1.0, 2.7}) {
                    // One camera and one jitter each, so that all meet all over the run.
                    scene.camera = views[generator() % views.size()];
                    settle(scene, classification, step);
                    scene.rendering.edit([&](scene::RenderSettings& settings) {
                        settings.jitter = scene::Jitter(generator() % 3);
                        settings.early_termination = generator() % 2 == 0;
                    });
                    expect_same_bits(scene, {24, 24},
                                     "volume " + std::to_string(kind) + ", transfer function " +
                                         std::to_string(tf_kind) + ", " + name_of(classification) + ", step " +
                                         std::to_string(step));
                    if (tf_kind != 1 && step == 1.0) {
                        const double share = skipped_share(scene, {24, 24});
                        most = std::max(most, share);
                        sum += share;
                        ++counted;
                    }
                }
            }
        }
    }
    report("mean share skipped", sum / counted);
    report("largest share skipped", most);
    EXPECT_GT(sum / counted, 0.1) << "else the test says little";
}

TEST_F(Leaping, Test07EveryCameraAndJitterBitForBit) {
    const auto grid = scene::builtin_volume("bucky");
    scene::Scene scene = scene_with(grid, scene::suggested_transfer_function(*grid));
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
    for (const scene::Camera& camera : cameras(scene)) {
        scene.camera = camera;
        for (const Classification classification : both_classifications) {
            for (const scene::Jitter jitter : {scene::Jitter::off, scene::Jitter::hashed, scene::Jitter::blue_noise}) {
                settle(scene, classification, 0.9);
                scene.rendering.edit([&](scene::RenderSettings& settings) { settings.jitter = jitter; });
                expect_same_bits(scene, {40, 40}, name_of(classification));
            }
            EXPECT_GT(skipped_share(scene, {40, 40}), 0.0);
        }
    }
}

TEST_F(Leaping, Test07SeveralVolumesBitForBit) {
    scene::Scene scene = scene::builtin_scene("bucky-cluster");
    for (const Classification classification : both_classifications) {
        for (const double step : {0.6, 2.0}) {
            settle(scene, classification, step);
            expect_same_bits(scene, {64, 36}, name_of(classification));
        }
        report(std::string("share skipped, three volumes, ") + name_of(classification), skipped_share(scene, {64, 36}));
        EXPECT_GT(skipped_share(scene, {64, 36}), 0.0);
    }
}

TEST_F(Leaping, Test07GapsBetweenFullVolumesBitForBit) {
    // Nothing is empty inside the boxes, so that every leap ends or begins at a face, in the middle of a segment.
    std::mt19937 generator(77);
    std::uniform_real_distribution<double> unit;
    scene::Scene scene =
        scene_with(homogeneous({8, 8, 16}, {1.0, 1.0, 0.8}), uniform_extinction(0.7, {1.0, 0.5, 0.25}));
    scene::Node node;
    scene::Volume second;
    second.grid = homogeneous({4, 4, 5}, {2.0, 2.0, 0.5});
    second.transfer_function = uniform_extinction(1.3, {0.2, 0.5, 0.9});
    node.content = second;
    scene.nodes["second"] = node;
    double skipped = 0.0;
    for (int trial = 0; trial < 24; ++trial) {
        scene.nodes.at("second").transform = scene::Transform{
            .translation = {0.0, 0.0, 1.0 + 2.0 * unit(generator)},
            .rotation_deg = trial % 2 == 0 ? glm::dvec3(0.0) : glm::dvec3(20.0 * unit(generator), 10.0, 5.0)};
        scene.camera->edit([&](scene::Camera& camera) { camera.projection = scene::Projection(trial / 2 % 2); });
        for (const Classification classification : both_classifications) {
            settle(scene, classification, trial % 3 == 0 ? 1.0 : 0.3 + unit(generator));
            scene.rendering.edit([&](scene::RenderSettings& s) { s.jitter = scene::Jitter(trial % 3); });
            expect_same_bits(scene, {16, 16}, std::to_string(trial) + ", " + name_of(classification));
            if (trial < 2) {
                skipped = std::max(skipped, skipped_share(scene, {16, 16}));
            }
        }
    }
    report("largest share skipped in gaps", skipped);
    EXPECT_GT(skipped, 0.2);
}

TEST_F(Leaping, Test07MeasuredVolumesBitForBit) {
    struct Case {
        const char* file;
        double from, share;
    };
    for (const Case& c :
         {Case{"bonsai-zfp8_256x256x256_uint8.raw", 0.25, 0.5}, Case{"engine-zfp8_256x256x128_uint8.raw", 0.35, 0.5},
          Case{"CThead_256x256x113_uint16.raw", 0.4, 0.2}}) {
        const auto grid = measured_volume(c.file);
        if (!grid) {
            GTEST_SKIP() << "BRUMA_DATA is not set to a folder with measured volumes";
        }
        scene::TransferFunction tf;
        tf.opacity = {{c.from, 0.0}, {c.from + 0.05, 0.6}};
        tf.reference_length = grid->spacing.x;
        scene::Scene scene = builtin_like(grid, tf);
        for (const Classification classification : both_classifications) {
            settle(scene, classification, 1.0);
            expect_same_bits(scene, {96, 96}, std::string(c.file) + ", " + name_of(classification));
            const double skipped = skipped_share(scene, {96, 96});
            report(std::string("share skipped, ") + grid->name + ", " + name_of(classification), skipped);
            EXPECT_GT(skipped, c.share) << c.file;
        }
    }
}

}  // namespace
}  // namespace bruma::render
