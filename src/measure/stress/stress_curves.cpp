#include <fmt/core.h>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

scene::Scene with_curves(const std::function<void(scene::TransferFunction&)>& change) {
    scene::TransferFunction tf = gentle_curves();
    change(tf);
    return stress_scene(smooth_grid(), tf);
}

scene::Scene with_density(double scale) {
    scene::Scene scene = stress_scene();
    stress_volume(scene).optics.edit([scale](scene::VolumeOptics& o) { o.density_scale = scale; });
    return scene;
}

}  // namespace

void stress_curves(StressRig& rig) {
    rig.group("curves");
    // Thick matter is a surface: its place along the ray within a quarter of a voxel decides the colour, which here
    // changes by 0.7 over some ten voxels; 0.03 was the worst seen.
    constexpr double surface = 6e-2;
    // A jump is a ramp of 1/1020 of the window in the tables.
    constexpr double jump = 2e-2;
    constexpr double smooth = 1e-3;
    rig.picture("opaque", "opacity 1 everywhere", with_curves([](auto& tf) { tf.opacity = {{0.0, 1.0}}; }), surface);
    rig.picture("transparent", "opacity 0 everywhere", with_curves([](auto& tf) { tf.opacity = {{0.0, 0.0}}; }), 1e-6);
    rig.picture("no-points", "no control points at all", with_curves([](auto& tf) {
                    tf.opacity.clear();
                    tf.color.clear();
                }),
                1e-6);
    rig.picture("step", "two points at one position", with_curves([](auto& tf) {
                    tf.opacity = {{0.4, 0.0}, {0.4, 0.3}, {1.0, 0.3}};
                }),
                jump);
    rig.picture("step-to-opaque", "from 0 to 1 at one position", with_curves([](auto& tf) {
                    tf.opacity = {{0.4, 0.0}, {0.4, 1.0}, {1.0, 1.0}};
                }));
    rig.picture("many-steps", "fifty points at one position", with_curves([](auto& tf) {
                    tf.opacity = {{0.0, 0.0}};
                    for (int n = 0; n < 50; ++n) {
                        tf.opacity.push_back({0.5, n % 2 ? 1.0 : 0.0});
                    }
                    tf.opacity.push_back({1.0, 0.3});
                }));
    rig.picture("window-empty", "both ends of the window at 0.5", with_curves([](auto& tf) {
                    tf.window = std::array{0.5, 0.5};
                }));
    for (const double width : {1e-6, 1e-12, 1e-30, 1e-300}) {
        rig.picture(fmt::format("window-{:g}", width), "a window of that width", with_curves([width](auto& tf) {
                        tf.window = std::array{0.0, width};
                    }));
    }
    rig.picture("window-reversed", "upper end below the lower", with_curves([](auto& tf) {
                    tf.window = std::array{1.0, 0.0};
                }),
                smooth);
    rig.picture("window-outside", "a window that no value meets", with_curves([](auto& tf) {
                    tf.window = std::array{5.0, 6.0};
                }),
                smooth);
    rig.picture("window-huge", "-1e300 to 1e300", with_curves([](auto& tf) { tf.window = std::array{-1e300, 1e300}; }));
    for (const double length : {1e-12, 1e-6, 1.0, 1e12}) {
        rig.picture(fmt::format("reference-length-{:g}", length), "opacity over that many metres",
                    with_curves([length](auto& tf) { tf.reference_length = length; }),
                    length < 1e-3 ? surface : smooth);
    }
    rig.picture("density-0", "extinction times 0", with_density(0.0), 1e-6);
    rig.picture("density-1e-9", "extinction times 1e-9", with_density(1e-9), smooth);
    rig.picture("density-1e9", "extinction times 1e9", with_density(1e9), surface);
    rig.picture("density-and-length", "extinction times 1e9, over 1e-12 m", [] {
        scene::Scene scene = with_density(1e9);
        stress_volume(scene).transfer_function.edit([](auto& tf) { tf.reference_length = 1e-12; });
        return scene;
    }());
    rig.picture(
        "500-points", "opacity and colour at random in 500 points", with_curves([](auto& tf) {
            tf.opacity.clear();
            tf.color.clear();
            for (std::size_t n = 0; n < 500; ++n) {
                tf.opacity.push_back({double(n) / 499.0, 0.4 * stress_noise(n)});
                tf.color.push_back({double(n) / 499.0, {stress_noise(n, 2), stress_noise(n, 3), stress_noise(n, 4)}});
            }
        }),
        0.2);  // two points to each of the 255 bins of the colour table: half of the curve is not in it
    rig.picture("emission-1e6", "light of its own, a million times the colour", with_curves([](auto& tf) {
                    tf.emission = {{0.0, 1e6}};
                }),
                smooth);
    rig.picture("color-0", "black matter", with_curves([](auto& tf) { tf.color = {{0.0, glm::dvec3(0.0)}}; }), smooth);
    rig.picture("domain-reversed", "positions counted from 1 to 0", with_curves([](auto& tf) {
                    tf.domain = {1.0, 0.0};
                }),
                smooth);
    rig.picture("domain-1e-300", "positions within 1e-300", with_curves([](auto& tf) { tf.domain = {0.0, 1e-300}; }));
}

}  // namespace bruma::measure
