#include <fmt/core.h>

#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

namespace bruma::measure {
namespace {

scene::Scene with_settings(const std::function<void(scene::RenderSettings&)>& change) {
    scene::Scene scene = stress_scene();
    scene.rendering.edit(change);
    return scene;
}

/// Volumes that overlap, each moved and turned a little.
scene::Scene overlapping(int count, bool lit = false) {
    scene::Scene scene = stress_scene();
    for (int n = 1; n < count; ++n) {
        add_volume(
            scene, fmt::format("volume-{}", n), smooth_grid(), gentle_curves(),
            {.translation = glm::dvec3(2e-3, -1e-3, 1.5e-3) * double(n), .rotation_deg = {11.0 * n, 7.0 * n, 0.0}});
    }
    if (lit) {
        scene.lights["head"] = scene::Light{.kind = scene::LightKind::headlight};
        for (auto& [name, node] : scene.nodes) {
            std::get<scene::Volume>(node.content).optics.edit([](scene::VolumeOptics& o) {
                o.lighting = scene::VolumeLighting::gradient;
            });
        }
    }
    look_at_all(scene);
    return scene;
}

enum class SlabError { of_opacity, of_radiance_relative };

/// How far a homogeneous slab of radiance 1 is from 1 - exp(-sigma D), over all pixels of an orthographic view.
double slab_error(StressRig& rig, double step, scene::Classification classification, double optical_depth,
                  SlabError which = SlabError::of_opacity) {
    scene::TransferFunction tf;
    tf.opacity = {{0.0, -std::expm1(-0.5)}};  // optical depth 1/2 over the reference length
    tf.reference_length = 0.5 * 256e-3 / optical_depth;
    scene::Scene scene = stress_scene(float_grid({2, 2, 256}, [](std::size_t) { return 1.0; }), tf);
    scene.background = scene::Background{};
    scene.rendering.edit([&](scene::RenderSettings& s) {
        s.step = step;
        s.classification = classification;
        s.refine = false;  // so many steps are meant, not twice as many
    });
    scene.camera = scene::Camera{.projection = scene::Projection::orthographic,
                                 .eye_world = {0.0, 0.0, 0.2},
                                 .view_height = 1e-3,
                                 .near_distance = 1e-6};
    const Image image = rig.draw(scene, {8, 8});
    const double truth = -std::expm1(-optical_depth);
    double worst = 0.0;
    for (std::size_t n = 0; n < image.pixel_count(); ++n) {
        const float* pixel = &image.rgba[4 * n];
        worst = std::max(
            worst, which == SlabError::of_opacity ? std::abs(pixel[3] - truth) : std::abs(pixel[0] - truth) / truth);
    }
    return worst;
}

}  // namespace

void stress_march(StressRig& rig) {
    rig.group("march");
    constexpr double smooth = 1e-3;  // smooth data, quarter steps, and the table's 1/1020
    using scene::Classification;
    rig.picture("step-0.01", "steps of a hundredth of a voxel", with_settings([](auto& s) { s.step = 0.01; }), smooth);
    rig.picture("step-64", "steps longer than the volume", with_settings([](auto& s) { s.step = 64.0; }));
    rig.picture("post-step-0.01", "the same, post-classified", with_settings([](auto& s) {
                    s.step = 0.01;
                    s.classification = Classification::post;
                }),
                smooth);
    rig.picture("post-step-64", "the same, post-classified", with_settings([](auto& s) {
                    s.step = 64.0;
                    s.classification = Classification::post;
                }));
    for (const double stop : {0.0, 1e-3, 1.0}) {
        rig.picture(fmt::format("stop-{:g}", stop), "rays end below that transmittance", with_settings([stop](auto& s) {
                        s.early_termination = true;
                        s.stop_transmittance = stop;
                    }),
                    stop < 1.0 ? std::optional(smooth + stop) : std::nullopt);
    }
    for (const scene::Jitter jitter : {scene::Jitter::off, scene::Jitter::hashed, scene::Jitter::blue_noise}) {
        const std::string word(scene::enum_words<scene::Jitter>()[std::size_t(jitter)]);
        rig.picture("jitter-" + word, "first segment shortened by it",
                    with_settings([jitter](auto& s) { s.jitter = jitter; }), smooth);
        rig.picture("jitter-" + word + "-post", "the same, post-classified", with_settings([jitter](auto& s) {
                        s.jitter = jitter;
                        s.classification = Classification::post;
                    }),
                    5e-3);  // midpoints at quarter steps
    }
    rig.picture(
        "no-volume", "nothing but the background",
        [] {
            scene::Scene scene = stress_scene();
            scene.nodes.at("volume").visible = false;
            return scene;
        }(),
        1e-6);
    // Where boxes begin inside of a segment it is cut at one end for each volume alone; lights of several mix there.
    for (const int count : {1, 3, 6}) {
        rig.picture(fmt::format("overlapping-{}", count), "volumes in each other", overlapping(count), 2e-3);
    }
    rig.picture("overlapping-6-lit", "the same, lit", overlapping(6, true), 5e-3);

    // Rounding grows with the number of steps: some 2.5e-8 for each, so 1e-5 for 256 and 1.1e-4 for 4096.
    for (const Classification classification : {Classification::post, Classification::preintegrated}) {
        const std::string word(scene::enum_words<Classification>()[std::size_t(classification)]);
        for (const double depth : {1e-5, 1.0, 8.0}) {
            rig.number(fmt::format("slab-256-{}-{:g}", word, depth), "256 steps against 1 - exp(-sigma D)", 1e-5,
                       [&] { return slab_error(rig, 1.0, classification, depth); });
            rig.number(fmt::format("slab-4096-{}-{:g}", word, depth), "4096 steps against 1 - exp(-sigma D)", 1.1e-4,
                       [&] { return slab_error(rig, 1.0 / 16.0, classification, depth); });
        }
        // Thin matter must keep its light: the series of the opacity has all digits where 1 - exp has none. (Opacity
        // itself is 1 - transmittance and cannot hold less than 2^-24 a step.)
        rig.number(fmt::format("slab-thin-{}", word), "light of 4096 steps of optical depth 2.4e-9 each, relative",
                   1e-3,
                   [&] { return slab_error(rig, 1.0 / 16.0, classification, 1e-5, SlabError::of_radiance_relative); });
    }
}

}  // namespace bruma::measure
