#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "reference_scenes.h"
#include "render/renderer.h"
#include "scene/scene.h"

/// What the tests of pictures share: a context, scenes, and ways to compare.
namespace bruma::render {

using reference::grid_of;
using reference::homogeneous;
using reference::noise;
using reference::rich_transfer_function;
using reference::scene_with;
using reference::uniform_extinction;
using reference::volume_in;
using scene::Classification;

constexpr Classification both_classifications[] = {Classification::post, Classification::preintegrated};
const char* name_of(Classification classification);

/// A test that draws. It is skipped, with a sentence, where no context can be opened, and fails when the driver
/// reported an error meanwhile.
class Drawing : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override;

    gl::ShaderLibrary& shaders();
    /// The scene drawn by a fresh renderer. Fails the test if any number in it is not finite.
    Image draw(const scene::Scene& scene, glm::ivec2 pixels);
    SampleTotals count(const scene::Scene& scene, glm::ivec2 pixels);

  private:
    int driver_errors_before_ = 0;
};

/// Whether every number of the picture is finite; counts those that are not.
testing::AssertionResult all_finite(const Image& image);
/// Largest difference over all channels and pixels; infinite if either is not finite or sizes differ.
double largest_difference(const Image& a, const Image& b);
bool same_bits(const Image& a, const Image& b);

/// No early end, the given step in voxels.
void settle(scene::Scene& scene, Classification classification, double step_voxels, bool refine = true);
scene::VolumeOptics& lit(scene::VolumeOptics& optics);

/// The scene's true picture, with its own error far below what the tests ask.
Image truth(const scene::Scene& scene, glm::ivec2 pixels, double tolerance = 1e-6);

/// Writes one measured number to standard output and to the test's record.
void report(const std::string& what, double value);

/// A perspective camera that sees the unit-sized volume from an oblique direction.
scene::Camera oblique_camera(const scene::Scene& scene, glm::dvec3 back_world = {0.5, 0.35, 0.9});

/// A volume of real data from the folder in BRUMA_DATA, or null.
std::shared_ptr<const scene::VolumeGrid> measured_volume(const std::string& file);

/// A transfer function whose extinction runs linearly between two values, to the last digit of the tables: the opacity
/// is given at each of their entries.
scene::TransferFunction linear_extinction(double sigma_0, double sigma_1, glm::dvec3 color_0, glm::dvec3 color_1);

}  // namespace bruma::render
