#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "measure/stress/stress_clouds.h"
#include "scene/builtin/builtin_clouds.h"

namespace bruma::measure {
namespace {

/// Numbers in [0,1), the same on every machine.
class Random {
  public:
    double between(double a, double b) { return a + (b - a) * double(generator_() >> 8U) * 0x1p-24; }
    /// Evenly in the logarithm.
    double decades(double a, double b) { return std::pow(10.0, between(a, b)); }

  private:
    std::mt19937 generator_{11};
};

/// Another sort of cloud, from a metre to 20 km thick, at any height and hour, indoors or under a sky.
void change_weather(Random& random, scene::Scene& scene, const std::vector<scene::Scene>& presets) {
    const auto camera = scene.camera;
    const auto time = scene.time;
    scene = presets[std::size_t(random.between(0.0, double(presets.size())))];
    scene.camera = camera;
    scene.time = time;
    scene::clouds_in(scene).layer.edit([&](scene::CloudLayer& layer) {
        layer.coverage = std::clamp(random.between(-0.2, 1.2), 0.0, 1.0);
        layer.density = random.decades(-3.0, 2.0);
        layer.bottom_m = random.decades(0.0, 4.0);
        layer.top_m = layer.bottom_m + random.decades(0.0, std::log10(20e3));
        layer.wind_azimuth_deg = random.between(-180.0, 180.0);
        layer.bounds = random.between(0.0, 1.0) < 0.2 ? scene::CloudBounds::box : scene::CloudBounds::shell;
    });
    scene::clouds_in(scene).optics.edit(
        [&](scene::CloudOptics& optics) { optics.lighting = scene::CloudLighting(int(random.between(0.0, 2.0))); });
    const double elevation_deg = random.between(-10.0, 90.0), elevation = glm::radians(elevation_deg);
    if (random.between(0.0, 1.0) < 0.5) {
        scene.outdoors.emplace();
        scene.outdoors->sun.edit([&](scene::Sun& sun) { sun.elevation_deg = elevation_deg; });
    }
    scene.lights.at("sun").edit([&](scene::Light& sun) {
        sun.direction_world = {0.5 * std::cos(elevation), std::sin(elevation), -0.8 * std::cos(elevation)};
    });
}

void move(Random& random, scene::Scene& scene) {
    scene.camera->edit([&](scene::Camera& camera) {
        const double away = random.decades(3.0, 6.0);
        camera.eye_world = {random.between(-away, away), random.decades(0.0, 5.0), random.between(-away, away)};
        camera.target_world = camera.eye_world + glm::dvec3(0.5, random.between(-1.0, 1.0), -0.8);
    });
    scene.time.edit([&](scene::Timeline& timeline) {
        timeline.now_s =
            random.between(0.0, 1.0) < 0.1 ? random.between(-1e7, 1e7) : timeline.now_s + random.between(0.0, 100.0);
    });
}

void expect_sound(const gl::Texture& texture, int channels, const char* what) {
    const glm::ivec3 size = texture.size();
    std::vector<float> texels(std::size_t(channels) * size.x * size.y);
    texture.download({channels == 4 ? GLenum(GL_RGBA) : GLenum(GL_RED), GL_FLOAT}, texels.size() * sizeof(float),
                     texels.data());
    for (std::size_t n = 0; n < texels.size(); ++n) {
        const bool transmittance = channels == 4 && n % 4 == 3;
        if (!std::isfinite(texels[n]) || texels[n] < 0.0F || (transmittance && texels[n] > 1.0F)) {
            throw std::runtime_error(fmt::format("{} holds {}", what, texels[n]));
        }
    }
}

}  // namespace

void stress_cloud_history(StressRig& rig, int frames) {
    rig.number("history", fmt::format("{} frames of random parameters through reprojection", frames), 1e9, [&] {
        std::vector<scene::Scene> presets;
        for (std::size_t n = 0; n < scene::enum_words<scene::CloudType>().size(); ++n) {
            presets.push_back(scene::builtin_cloud_scene(scene::CloudType(n)));
            scene::clouds_in(presets.back()).march.edit([](scene::CloudMarch& march) {
                march.grid_columns = 32;
                march.grid_slices = 12;
                march.reprojection = scene::CloudReprojection::always;
            });
        }
        Random random;
        scene::Scene scene = presets.front();
        double brightest = 0.0;
        for (int frame = 0; frame < frames; ++frame) {
            if (frame % 4 == 0) {
                change_weather(random, scene, presets);
            }
            move(random, scene);
            try {
                for (const float value : rig.draw(scene, {24, 16}).rgba) {
                    brightest = std::max(brightest, double(value));
                }
                for (const render::CloudPicture* history : rig.renderer().cloud_pictures()) {
                    expect_sound(history->radiance, 4, "radiance");
                    expect_sound(history->distance, 1, "distance");
                }
            } catch (const std::runtime_error& fault) {
                throw std::runtime_error(fmt::format("frame {}: {}", frame, fault.what()));
            }
        }
        return brightest;
    });
}

}  // namespace bruma::measure
