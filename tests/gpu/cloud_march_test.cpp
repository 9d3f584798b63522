// Shelf: independent reference. Pictures of clouds against the fine march in double precision of the same field and the
// same model of light.
#include <cmath>

#include "cloud_scenes.h"
#include "drawing.h"
#include "reference/clouds/render_clouds.h"

namespace bruma::render {
namespace {

class CloudMarchPicture : public Drawing {};

struct Difference {
    double rmse = 0.0;  ///< of display range, 1
    double bias = 0.0;
};

/// Over what a display shows: radiance up to 1.
Difference difference(const Image& found, const Image& exact) {
    Difference result;
    for (std::size_t n = 0; n < exact.rgba.size(); ++n) {
        if (n % 4 != 3) {
            const double apart = std::min(1.0, double(found.rgba[n])) - std::min(1.0, double(exact.rgba[n]));
            result.rmse += apart * apart;
            result.bias += apart;
        }
    }
    const double count = 3.0 * double(exact.pixel_count());
    return {std::sqrt(result.rmse / count), result.bias / count};
}

/// The truth at the sizes of tests. Half the step and twice the samples move these pictures by 2e-3 at most, a tenth of
/// what is allowed.
Image exact_picture(const scene::Scene& scene, glm::ivec2 pixels, double step_m, int sun_samples) {
    reference::CloudImageOptions options;
    options.fixed_step_m = step_m;
    options.fixed_sun_samples = sun_samples;
    options.march.stop_transmittance = 1e-4;
    return reference::render_clouds(scene, pixels.x, pixels.y, options).image;
}

class CloudPresetPicture : public CloudMarchPicture, public testing::WithParamInterface<scene::CloudType> {};

TEST_P(CloudPresetPicture, IsThatOfDoublePrecision) {
    constexpr glm::ivec2 pixels(12, 7);
    for (const CloudView view : all_cloud_views) {
        const scene::Scene scene = cloud_scene(GetParam(), view);
        const Difference found = difference(draw(scene, pixels), exact_picture(scene, pixels, 24.0, 32));
        EXPECT_LE(found.rmse, 0.02) << name_of(view);
        EXPECT_LE(std::abs(found.bias), 0.01) << name_of(view);
        report(std::string("RMSE ") + name_of(view), found.rmse);
        report(std::string("bias ") + name_of(view), found.bias);
    }
}
TEST_F(CloudMarchPicture, OctavesAreThoseOfDoublePrecision) {
    constexpr glm::ivec2 pixels(12, 7);
    scene::Scene scene = cloud_scene(scene::CloudType::cumulus, CloudView::below);
    clouds_in(scene).optics.edit([](scene::CloudOptics& optics) {
        optics.multiple_scattering = scene::MultipleScattering::octaves;
        optics.albedo = 0.9;
    });
    const Difference found = difference(draw(scene, pixels), exact_picture(scene, pixels, 24.0, 32));
    EXPECT_LE(found.rmse, 0.02);
    EXPECT_LE(std::abs(found.bias), 0.01);
    report("RMSE", found.rmse);
}

INSTANTIATE_TEST_SUITE_P(Presets, CloudPresetPicture,
                         testing::Values(scene::CloudType::cumulus, scene::CloudType::stratocumulus,
                                         scene::CloudType::stratus),
                         [](const auto& preset) {
                             return std::string(scene::enum_words<scene::CloudType>()[std::size_t(preset.param)]);
                         });

}  // namespace
}  // namespace bruma::render
