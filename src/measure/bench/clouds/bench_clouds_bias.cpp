#include <cmath>

#include "measure/bench/clouds/bench_clouds.h"
#include "reference/clouds/render_clouds.h"

namespace bruma::measure {

CloudBias multiple_scattering_bias(scene::Scene scene, glm::ivec2 pixels, std::uint32_t samples) {
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    reference::CloudImageOptions options;
    options.fixed_step_m = 16.0;
    options.fixed_sun_samples = 64;
    options.march.stop_transmittance = 1e-4;
    const Image by_model = reference::render_clouds(scene, pixels.x, pixels.y, options).image;
    options.paths = reference::LightPaths::multiple;
    options.samples = samples;
    const reference::ScatteringImage paths = reference::render_clouds(scene, pixels.x, pixels.y, options);
    CloudBias bias;
    const double count = double(by_model.pixel_count());
    double variance = 0.0, squares = 0.0;
    for (std::size_t n = 0; n < by_model.pixel_count(); ++n) {
        const double modelled = by_model.rgba[4 * n + 1], true_one = paths.image.rgba[4 * n + 1];
        bias.modelled += modelled / count;
        bias.paths += true_one / count;
        squares += (modelled - true_one) * (modelled - true_one) / count;
        variance += double(paths.error[n].g) * paths.error[n].g / count;
    }
    bias.standard_error = std::sqrt(variance / count);
    bias.rms = std::sqrt(std::max(0.0, squares - variance));  // what the noise of the paths adds is known
    return bias;
}

}  // namespace bruma::measure
