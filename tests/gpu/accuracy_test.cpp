// Shelf: reference. How far a picture at a step of one voxel is from the truth, under transfer functions with sharp
// edges, and which step point-wise classification needs for the same.
#include <array>

#include "drawing.h"
#include "measure/metrics/image_error.h"
#include "scene/builtin/builtin.h"

namespace bruma::render {
namespace {

/// Two shells, each over a twentieth of the range of values.
scene::TransferFunction shells(double voxel_edge) {
    scene::TransferFunction tf;
    tf.reference_length = voxel_edge;
    tf.opacity = {{0.275, 0.0}, {0.3, 0.25}, {0.325, 0.0}, {0.575, 0.0}, {0.6, 0.6}, {0.625, 0.0}};
    tf.color = {{0.3, {0.9, 0.5, 0.2}}, {0.6, {0.3, 0.7, 1.0}}};
    return tf;
}

/// A surface: from nothing to nearly opaque within a fiftieth of the range of values.
scene::TransferFunction surface(double voxel_edge) {
    scene::TransferFunction tf;
    tf.reference_length = voxel_edge;
    tf.opacity = {{0.4, 0.0}, {0.42, 0.9}};
    tf.color = {{0.4, {0.9, 0.5, 0.2}}, {0.8, {0.3, 0.7, 1.0}}};
    return tf;
}

/// Half a step of an 8-bit display (1/510): an error that no such display shows. What is left of it comes from segments
/// whose bend no sample has seen. Seen to fail without the refinement of bent segments (0.0007 to 0.025).
constexpr double tolerance = 2e-3;

class Accuracy : public Drawing {
  protected:
    double rmse(scene::Scene& scene, const Image& expected, Classification classification, double step) {
        settle(scene, classification, step);
        return measure::compare_images(draw(scene, {expected.width, expected.height}), expected).rmse;
    }
    /// The largest step of 1, 1/2, 1/4 ... voxels with which the RMSE is not above `goal`.
    double step_for(scene::Scene& scene, const Image& expected, Classification classification, double goal) {
        double step = 1.0;
        while (step > 0.01 && rmse(scene, expected, classification, step) > goal) {
            step *= 0.5;
        }
        return step;
    }
    /// At a step of one voxel: under the shells, the surface, and the transfer function that a user starts with.
    void expect_accurate(const std::string& name, std::shared_ptr<const scene::VolumeGrid> grid, int edge) {
        const std::array<std::pair<const char*, scene::TransferFunction>, 3> transfer_functions{
            {{"shells", shells(grid->spacing.x)},
             {"surface", surface(grid->spacing.x)},
             {"suggested", scene::suggested_transfer_function(*grid)}}};
        for (std::size_t n = 0; n < 3; ++n) {
            const std::string what = name + ", " + transfer_functions[n].first + ": ";
            scene::Scene scene = scene_with(grid, transfer_functions[n].second);
            scene.camera = oblique_camera(scene);
            const Image expected = truth(scene, {edge, edge}, 1e-5);
            const double fast = rmse(scene, expected, Classification::preintegrated, 1.0);
            report(what + "RMSE preintegrated at step 1", fast);
            EXPECT_LE(fast, tolerance) << what;
            const double halved = rmse(scene, expected, Classification::preintegrated, 0.5);
            report(what + "RMSE preintegrated at step 1/2", halved);
            // Below 1e-4 the tables and floats hold the rest, whatever the step.
            if (fast > 1e-4) {
                EXPECT_LT(halved, 0.6 * fast) << what << "the step is what is left of the error";
            }
            report(what + "RMSE post at step 1", rmse(scene, expected, Classification::post, 1.0));
            report(what + "step of post for the same RMSE", step_for(scene, expected, Classification::post, fast));
            report(what + "step of preintegrated for RMSE 2e-3",
                   step_for(scene, expected, Classification::preintegrated, 2e-3));
            report(what + "step of post for RMSE 2e-3", step_for(scene, expected, Classification::post, 2e-3));
        }
    }
};

TEST_F(Accuracy, Bucky) {
    expect_accurate("bucky", scene::builtin_volume("bucky"), 256);
}

TEST_F(Accuracy, MarschnerLobb) {
    expect_accurate("marschner-lobb", scene::builtin_volume("marschner-lobb"), 256);
}

TEST_F(Accuracy, Bonsai) {
    const auto grid = measured_volume("bonsai-zfp8_256x256x256_uint8.raw");
    if (!grid) {
        GTEST_SKIP() << "BRUMA_DATA is not set to a folder with measured volumes";
    }
    expect_accurate("bonsai", grid, 256);
}

class LongAccuracy : public Accuracy {};

TEST_F(LongAccuracy, AllAtFullSize) {
    expect_accurate("bucky", scene::builtin_volume("bucky"), 512);
    expect_accurate("marschner-lobb", scene::builtin_volume("marschner-lobb"), 512);
    if (const auto grid = measured_volume("bonsai-zfp8_256x256x256_uint8.raw")) {
        expect_accurate("bonsai", grid, 512);
    }
}

}  // namespace
}  // namespace bruma::render
