#include <fmt/core.h>

#include <cmath>

#include "measure/stress/stress_clouds.h"
#include "scene/builtin/builtin_clouds.h"

namespace bruma::measure {
namespace {

using Change = std::function<void(scene::Scene&)>;

/// The same one each time, as old as the first: what a case does not change is not made again.
scene::Scene small_scene() {
    static const scene::Scene made = [] {
        scene::Scene scene = scene::builtin_cloud_scene(scene::CloudType::cumulus);
        scene::clouds_in(scene).march.edit([](scene::CloudMarch& march) {
            march.grid_columns = 64;
            march.grid_slices = 16;
        });
        return scene;
    }();
    return made;
}

void stand_at(scene::Scene& scene, double altitude_m, double rise) {
    scene.camera->edit([&](scene::Camera& camera) {
        camera.eye_world = {0.0, altitude_m, 0.0};
        camera.target_world = camera.eye_world + glm::dvec3(0.5, rise, -0.8);
    });
}

void set_sun_elevation(scene::Scene& scene, double elevation_deg) {
    const double elevation = glm::radians(elevation_deg);
    scene.lights.at("sun").edit([&](scene::Light& sun) {
        sun.direction_world = {0.5 * std::cos(elevation), std::sin(elevation), -0.8 * std::cos(elevation)};
    });
}

/// A map of one value in all its texels.
void set_map(scene::Scene& scene, int width, int height, glm::u8vec4 weather) {
    auto map = std::make_shared<scene::WeatherMap>();
    map->name = "even";
    map->width = width;
    map->height = height;
    for (std::size_t n = 0; n < std::size_t(width) * height; ++n) {
        map->rgba.insert(map->rgba.end(), {weather.r, weather.g, weather.b, weather.a});
    }
    scene::clouds_in(scene).map = std::shared_ptr<const scene::WeatherMap>(std::move(map));
}

/// What all pictures of clouds must keep: no radiance below 0, none above what any lobe could focus.
double brightest(const Image& image) {
    double most = 0.0;
    for (std::size_t n = 0; n < image.rgba.size(); ++n) {
        if (image.rgba[n] < 0.0F) {
            return std::numeric_limits<double>::infinity();
        }
        most = std::max(most, n % 4 == 3 ? 0.0 : double(image.rgba[n]));
    }
    return most;
}

class Cases {
  public:
    explicit Cases(StressRig& rig) : rig_(rig) {}

    /// From below, inside and above, with both models of light.
    void sound(const std::string& name, const std::string& what, const Change& change) {
        rig_.number(name, what, most_radiance, [&] {
            double most = 0.0;
            for (const double altitude : {2.0, 2200.0, 6000.0}) {
                for (const auto lighting : {scene::CloudLighting::physical, scene::CloudLighting::artistic}) {
                    scene::Scene scene = small_scene();
                    stand_at(scene, altitude, altitude > 4000.0 ? -0.3 : 0.2);
                    scene::clouds_in(scene).optics.edit(
                        [&](scene::CloudOptics& optics) { optics.lighting = lighting; });
                    change(scene);
                    most = std::max(most, brightest(rig_.draw(scene)));
                }
            }
            return most;
        });
    }
    /// The picture must be that without clouds.
    void clear(const std::string& name, const std::string& what, const Change& change) {
        rig_.number(name, what, 1e-6, [&] {
            scene::Scene scene = small_scene();
            change(scene);
            const Image found = rig_.draw(scene);
            scene.nodes.at("sky").visible = false;
            return largest_difference(found, rig_.draw(scene));
        });
    }

  private:
    /// A lobe of g = 0.8 under irradiance 2 pi sends 22 straight ahead.
    static constexpr double most_radiance = 40.0;
    StressRig& rig_;
};

void stress_cloud_sun(Cases& cases) {
    for (const double elevation : {90.0, 10.0, 3.0, 1.0, 0.1, 0.0, -0.1, -1.0, -5.0, -90.0}) {
        cases.sound(fmt::format("sun-{:g}", elevation), "the sun at this elevation, degrees",
                    [&](scene::Scene& scene) { set_sun_elevation(scene, elevation); });
    }
    cases.sound("no-sun", "no lamp at all", [](scene::Scene& scene) { scene.lights.clear(); });
    cases.sound("cone", "the cone under a setting sun", [](scene::Scene& scene) {
        set_sun_elevation(scene, 0.5);
        scene::clouds_in(scene).march.edit([](auto& march) { march.sun_path = scene::CloudSunPath::cone; });
    });
}

void stress_cloud_cameras(StressRig& rig, Cases& cases) {
    for (const double altitude : {0.0, 1499.999, 1500.0, 2000.0, 4000.0, 100e3, 1e7}) {
        for (const double rise : {-10.0, -0.1, 0.0, 0.1, 10.0}) {
            cases.sound(fmt::format("camera-{:g}m-{:+g}", altitude, rise), "at this altitude, looking so steeply",
                        [&](scene::Scene& scene) { stand_at(scene, altitude, rise); });
        }
    }
    cases.sound("box", "a box, seen along its faces", [](scene::Scene& scene) {
        scene::clouds_in(scene).layer.edit([](auto& layer) { layer.bounds = scene::CloudBounds::box; });
        scene.camera->edit([](auto& camera) {
            camera.eye_world = {-20000.0, 1500.0, 0.0};
            camera.target_world = camera.eye_world + glm::dvec3(1.0, 0.0, 0.0);
        });
    });
    cases.sound("orthographic", "parallel rays", [](scene::Scene& scene) {
        scene.camera->edit([](auto& camera) {
            camera.projection = scene::Projection::orthographic;
            camera.view_height = 5000.0;
        });
    });
    // The map of 40 km comes round every 4000 s: places within it, reduced in double, differ by 1e-12 of it.
    rig.number("late", "the same after the wind has carried whole tiles, at 1e7 s", 1e-4, [&] {
        scene::Scene scene = small_scene();
        scene.time.edit([](auto& timeline) { timeline.now_s = 123.4; });
        const Image early = rig.draw(scene);
        scene.time.edit([](auto& timeline) { timeline.now_s += 2500.0 * 4000.0; });
        return largest_difference(early, rig.draw(scene));
    });
    // What a step of a hundredth of a second changes is as small then as at the beginning.
    rig.number("late-steps", "largest change in 0.01 s at 1e7 s, over that at 0 s", 1.5, [&] {
        scene::Scene scene = small_scene();
        const auto change = [&](double begin_s) {
            double most = 0.0;
            scene.time.edit([&](auto& timeline) { timeline.now_s = begin_s; });
            Image last = rig.draw(scene);
            for (int n = 1; n <= 4; ++n) {
                scene.time.edit([&](auto& timeline) { timeline.now_s = begin_s + 0.01 * n; });
                const Image next = rig.draw(scene);
                most = std::max(most, largest_difference(last, next));
                last = next;
            }
            return most;
        };
        const double early = change(0.0);
        return change(1e7) / early;
    });
}

void stress_cloud_layers(Cases& cases) {
    const auto layer = [](const std::function<void(scene::CloudLayer&)>& change) {
        return [change](scene::Scene& scene) { scene::clouds_in(scene).layer.edit(change); };
    };
    cases.clear("coverage-0", "no coverage", layer([](auto& l) { l.coverage = 0.0; }));
    cases.clear("density-0", "no density", layer([](auto& l) { l.density = 0.0; }));
    cases.sound("coverage-1", "all covered", layer([](auto& l) { l.coverage = 1.0; }));
    cases.sound("density-1e6", "as dense as can be", layer([](auto& l) { l.density = 1e6; }));
    cases.sound("linear", "linear coverage of a half", layer([](auto& l) {
                    l.linear_coverage = true;
                    l.coverage = 0.5;
                }));
    cases.sound("packed-overlay", "packed noise, overlaid placement, detail that grows", layer([](auto& l) {
                    l.packing = scene::NoisePacking::packed;
                    l.coverage_rule = scene::CoverageRule::overlay;
                    l.erosion = scene::CloudErosion::grows;
                    l.coverage = 1.0;
                }));
    for (const double thickness : {1.0, 20e3}) {
        cases.sound(fmt::format("thickness-{:g}m", thickness), "a layer of this thickness",
                    layer([thickness](auto& l) { l.top_m = l.bottom_m + thickness; }));
    }
    for (const int value : {0, 255}) {
        for (int channel = 0; channel < 4; ++channel) {
            glm::u8vec4 weather(128);
            weather[channel] = std::uint8_t(value);
            const auto change = [&](scene::Scene& scene) { set_map(scene, 16, 8, weather); };
            const std::string name = fmt::format("weather-{}-{}", "rgba"[channel], value);
            // Without height or density there is no cloud; without placement in one channel there still may be.
            value == 0 && channel >= 2 ? cases.clear(name, "a channel of the map at this value", change)
                                       : cases.sound(name, "a channel of the map at this value", change);
        }
    }
    cases.clear("weather-0", "a map of zeros", [](scene::Scene& scene) { set_map(scene, 8, 8, glm::u8vec4(0)); });
    cases.sound("map-8x8", "the smallest map", [](scene::Scene& scene) { set_map(scene, 8, 8, {200, 200, 200, 128}); });
    cases.sound("map-8192x8", "a map that is not square", [](scene::Scene& scene) {
        set_map(scene, 8192, 8, {200, 200, 200, 128});
    });
    const auto large = scene::make_weather_map(scene::WeatherPattern::scattered, 1, 2048);
    cases.sound("map-2048x2048", "a large map", [&](scene::Scene& scene) { scene::clouds_in(scene).map = large; });
}

}  // namespace

std::vector<StressVerdict> run_cloud_stress(const StressOptions& options) {
    StressRig rig(options);
    Cases cases(rig);
    rig.group("sun");
    stress_cloud_sun(cases);
    rig.group("cameras");
    stress_cloud_cameras(rig, cases);
    rig.group("layers");
    stress_cloud_layers(cases);
    rig.group("random");
    stress_cloud_history(rig, options.random_scenes);
    return rig.verdicts();
}

}  // namespace bruma::measure
