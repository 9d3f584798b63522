#include "drawing.h"

#include <fmt/core.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "io/volume/raw_volume.h"
#include "offscreen.h"
#include "reference/volume/emission_absorption.h"

namespace bruma::render {

const char* name_of(Classification classification) {
    return classification == Classification::post ? "post" : "preintegrated";
}

void Drawing::SetUp() {
    if (const std::string why = Offscreen::open(); !why.empty()) {
        GTEST_SKIP() << "no context to draw with: " << why;
    }
    driver_errors_before_ = context::driver_error_count();
}

void Drawing::TearDown() {
    EXPECT_EQ(context::driver_error_count(), driver_errors_before_) << "the driver reported errors";
}

gl::ShaderLibrary& Drawing::shaders() {
    return Offscreen::shaders();
}

Image Drawing::draw(const scene::Scene& scene, glm::ivec2 pixels) {
    Renderer renderer(shaders());
    renderer.render(scene, {pixels, 1.0});
    Image image = renderer.read_picture();
    EXPECT_TRUE(all_finite(image));
    return image;
}

SampleTotals Drawing::count(const scene::Scene& scene, glm::ivec2 pixels) {
    Renderer renderer(shaders());
    return renderer.count_samples(scene, {pixels, 1.0});
}

testing::AssertionResult all_finite(const Image& image) {
    std::size_t broken = 0;
    for (const float value : image.rgba) {
        broken += std::isfinite(value) ? 0 : 1;
    }
    if (broken == 0) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << broken << " of " << image.rgba.size() << " numbers are not finite";
}

double largest_difference(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height) {
        return std::numeric_limits<double>::infinity();
    }
    double largest = 0.0;
    for (std::size_t n = 0; n < a.rgba.size(); ++n) {
        const double difference = std::abs(double(a.rgba[n]) - b.rgba[n]);
        if (!std::isfinite(difference)) {
            return std::numeric_limits<double>::infinity();
        }
        largest = std::max(largest, difference);
    }
    return largest;
}

bool same_bits(const Image& a, const Image& b) {
    return a.rgba.size() == b.rgba.size() &&
           std::memcmp(a.rgba.data(), b.rgba.data(), a.rgba.size() * sizeof(float)) == 0;
}

void settle(scene::Scene& scene, Classification classification, double step_voxels, bool refine) {
    scene.rendering.edit([&](scene::RenderSettings& settings) {
        settings.classification = classification;
        settings.refine = refine;
        settings.step = step_voxels;
        settings.early_termination = false;
    });
}

scene::VolumeOptics& lit(scene::VolumeOptics& optics) {
    optics.lighting = scene::VolumeLighting::gradient;
    return optics;
}

Image truth(const scene::Scene& scene, glm::ivec2 pixels, double tolerance) {
    const auto result = reference::render_emission_absorption(scene, pixels.x, pixels.y, {.tolerance = tolerance});
    EXPECT_LE(result.rms_error, 100.0 * tolerance) << "the reference does not stand by itself";
    return result.image;
}

void report(const std::string& what, double value) {
    testing::Test::RecordProperty(what, fmt::format("{:.4g}", value));
    fmt::print("    {}: {:.4g}\n", what, value);
}

scene::Camera oblique_camera(const scene::Scene& scene, glm::dvec3 back_world) {
    return scene::fit_camera(scene::world_bounds(scene), 1.0, back_world);
}

std::shared_ptr<const scene::VolumeGrid> measured_volume(const std::string& file) {
    const char* const folder = std::getenv("BRUMA_DATA");
    if (folder == nullptr) {
        return nullptr;
    }
    return io::load_raw_volume(std::filesystem::path(folder) / "volumes" / file, {}).grid;
}

scene::TransferFunction linear_extinction(double sigma_0, double sigma_1, glm::dvec3 color_0, glm::dvec3 color_1) {
    scene::TransferFunction tf;
    tf.reference_length = 1.0 / std::max(sigma_0, sigma_1);
    tf.opacity.clear();
    for (int n = 0; n < depth_entries; ++n) {
        const double u = double(n) / (depth_entries - 1);
        tf.opacity.push_back({u, -std::expm1(-tf.reference_length * (sigma_0 + u * (sigma_1 - sigma_0)))});
    }
    tf.color = {{0.0, color_0}, {1.0, color_1}};
    tf.window = {0.0, 1.0};
    return tf;
}

}  // namespace bruma::render
