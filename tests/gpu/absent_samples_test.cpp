// Volumes of which some samples are absent or far from all others. Shelves: reference and closed form, said at each
// test.
#include <cmath>
#include <cstring>
#include <limits>

#include "drawing.h"
#include "measure/metrics/image_error.h"
#include "path_tracing.h"

namespace bruma::render {
namespace {

using AbsentSamples = PathTraced;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

double wave(glm::ivec3 at) {
    const glm::dvec3 x = (glm::dvec3(at) + 0.5) / 24.0;
    return 0.5 + 0.2 * std::sin(5.0 * x.x + 1.0) + 0.2 * std::cos(4.0 * x.y) * std::sin(3.0 * x.z + 0.5);
}

/// A ball amid the volume, one corner and a few single samples.
bool is_away(glm::ivec3 at) {
    const glm::dvec3 from_ball = glm::dvec3(at) - glm::dvec3(13.0, 9.0, 15.0);
    return glm::length(from_ball) < 6.3 || at.x + at.y - at.z > 30 || noise(at, 5) < 0.002;
}

/// int16 with its smallest value where nothing was measured, as scanners write it.
std::shared_ptr<const scene::VolumeGrid> padded_scan() {
    auto grid = std::make_shared<scene::VolumeGrid>();
    grid->name = "scan";
    grid->size = glm::ivec3(24);
    grid->spacing = glm::dvec3(1.0 / 24);
    grid->type = scene::VoxelType::int16;
    std::vector<std::int16_t> samples;
    for (int n = 0; n < 24 * 24 * 24; ++n) {
        const glm::ivec3 at(n % 24, n / 24 % 24, n / 576);
        samples.push_back(is_away(at) ? std::int16_t(-32768) : std::int16_t(std::lround(2000.0 * wave(at))));
    }
    grid->voxels.resize(samples.size() * sizeof(std::int16_t));
    std::memcpy(grid->voxels.data(), samples.data(), grid->voxels.size());
    scene::finish_grid(*grid, scene::Fills::left_out);
    return grid;
}

/// The lowest values are opaque, so that a hole which is drawn as one of them is seen.
scene::TransferFunction low_is_dense() {
    scene::TransferFunction tf;
    tf.reference_length = 0.2;
    tf.opacity = {{0.0, 0.5}, {0.5, 0.1}, {1.0, 0.4}};
    tf.color = {{0.1, {0.9, 0.3, 0.1}}, {0.9, {0.2, 0.5, 1.0}}};
    return tf;
}

TEST_F(AbsentSamples, AreDrawnAsNothingWhereTheReferenceSeesNothing) {
    const auto floats = grid_of(glm::ivec3(24), glm::dvec3(1.0 / 24),
                                [](glm::ivec3 at) { return is_away(at) ? double(nan) : wave(at); });
    for (const auto& grid : {floats, padded_scan()}) {
        ASSERT_FALSE(grid->absent.empty());
        scene::Scene scene = scene_with(grid, low_is_dense());
        scene.camera = oblique_camera(scene);
        scene.lights["key"] = scene::Light{};
        for (const bool with_lamps : {false, true}) {
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) {
                optics.lighting = with_lamps ? scene::VolumeLighting::gradient : scene::VolumeLighting::none;
            });
            const Image expected = truth(scene, {48, 48}, 1e-5);
            for (const Classification classification : both_classifications) {
                settle(scene, classification, 0.125);
                const double rmse = measure::compare_images(draw(scene, {48, 48}), expected).rmse;
                report(grid->name + (with_lamps ? ", lit, " : ", unlit, ") + name_of(classification) + ": RMSE", rmse);
                // A hole ends within a segment, an eighth of a voxel here, which is half of one on average: some 0.3 %
                // of the way through matter at each edge. Drawn as the smallest value they would differ by 0.1.
                EXPECT_LE(rmse, 4e-3);
            }
        }
    }
}

TEST_F(AbsentSamples, AreLeaptOverWithoutChangingABit) {
    scene::Scene scene = scene_with(padded_scan(), low_is_dense());
    scene.camera = oblique_camera(scene);
    for (const Classification classification : both_classifications) {
        settle(scene, classification, 0.5);
        const Image leapt = draw(scene, {40, 40});
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.empty_space_skipping = false; });
        EXPECT_TRUE(same_bits(leapt, draw(scene, {40, 40})));
        scene.rendering.edit([](scene::RenderSettings& settings) { settings.empty_space_skipping = true; });
    }
}

TEST_F(AbsentSamples, OfAHalfAreAClippedHalfUnderEveryLight) {
    // Closed form: matter ends at the last plane of samples that are present. Values run linearly across it, so that
    // gradients beside the absent ones are those of the whole.
    const auto half = [](bool absent) {
        return grid_of(glm::ivec3(24), glm::dvec3(1.0 / 24), [absent](glm::ivec3 at) {
            return absent && at.x > 14 ? double(nan) : 0.02 * at.x + 0.015 * at.y + 0.001 * (at.z % 5);
        });
    };
    for (const scene::VolumeLighting lighting :
         {scene::VolumeLighting::none, scene::VolumeLighting::gradient, scene::VolumeLighting::light_volume,
          scene::VolumeLighting::shadow_rays, scene::VolumeLighting::path_traced}) {
        const auto picture = [&](bool absent) {
            scene::Scene scene = scene_with(half(absent), low_is_dense());
            scene.camera = oblique_camera(scene);
            scene.lights["key"] = scene::Light{.direction_world = {0.6, 0.8, 0.5}, .intensity = 6.0};
            volume_in(scene).optics.edit([&](scene::VolumeOptics& optics) { optics.lighting = lighting; });
            volume_in(scene).transfer_function.edit([](scene::TransferFunction& tf) { tf.window = {0.0, 0.85}; });
            if (!absent) {
                volume_in(scene).clip.edit([](scene::ClipBox& clip) { clip.high.x = 14.5 / 24.0; });
            }
            settle(scene, Classification::preintegrated, 0.25);
            return lighting == scene::VolumeLighting::path_traced ? trace(scene, {32, 32}, {.samples = 256}).mean
                                                                  : draw(scene, {32, 32});
        };
        const double rmse = measure::compare_images(picture(true), picture(false)).rmse;
        const std::string name(scene::enum_words<scene::VolumeLighting>()[std::size_t(lighting)]);
        report(name + ": RMSE of absent beside clipped", rmse);
        // Light grids have other cells, of two voxels, over the whole than over the half; 256 paths leave noise of some
        // 0.02. Absent samples that scatter or shadow as the smallest value does would make 0.1 and more.
        const bool exact = lighting == scene::VolumeLighting::none || lighting == scene::VolumeLighting::gradient;
        EXPECT_LE(rmse, exact ? 4e-3 : 0.03) << name;
    }
}

scene::Scene ramp_scene(double outlier) {
    constexpr int edge = 48;
    const auto grid = grid_of(glm::ivec3(edge), glm::dvec3(1.0 / edge), [outlier](glm::ivec3 at) {
        return outlier != 0.0 && at == glm::ivec3(40, 40, 45) ? outlier : at.x / (edge - 1.0);
    });
    scene::TransferFunction tf;
    tf.window = {0.0, 1.0};
    tf.reference_length = 1.0 / edge;
    tf.opacity = {{0.0, 0.0}, {0.3, 0.02}, {1.0, 0.3}};
    tf.color = {{0.0, {0.8, 0.4, 0.2}}, {1.0, {0.9, 0.9, 0.8}}};
    scene::Scene scene = scene_with(grid, tf);
    scene.camera = oblique_camera(scene);
    scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
    volume_in(scene).optics.edit([](scene::VolumeOptics& optics) { lit(optics); });
    return scene;
}

TEST_F(AbsentSamples, OneVoxelFarFromAllOthersTakesNoShadingAway) {
    const Image expected = draw(ramp_scene(0.0), {64, 64});
    for (const double outlier : {1e6, -1e6, 1e12, 40.0}) {
        const double rmse = measure::compare_images(draw(ramp_scene(outlier), {64, 64}), expected).rmse;
        report("RMSE with one voxel of " + std::to_string(outlier), rmse);
        // The voxel itself and its neighbours show in 0.3 % of the pixels, by less than 0.1 each: sqrt(0.003) * 0.07.
        EXPECT_GT(rmse, 1e-5) << "the voxel itself is seen";
        EXPECT_LE(rmse, 4e-3);
    }
}

TEST_F(AbsentSamples, OneVoxelFarFromAllOthersIsShadedAsTheReferenceHasIt) {
    const scene::Scene scene = ramp_scene(1e6);
    const Image expected = truth(scene, {48, 48}, 1e-5);
    const double rmse = measure::compare_images(draw(scene, {48, 48}), expected).rmse;
    report("RMSE from the reference", rmse);
    EXPECT_LE(rmse, 2e-3);  // half a step of an 8-bit display, as for other data at a step of one voxel
}

}  // namespace
}  // namespace bruma::render
