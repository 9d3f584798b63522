#pragma once
#include "scene/builtin_clouds.h"

namespace bruma::render {

enum class CloudView { below, inside, above };
inline constexpr CloudView all_cloud_views[] = {CloudView::below, CloudView::inside, CloudView::above};

inline const char* name_of(CloudView view) {
    return view == CloudView::below ? "below" : view == CloudView::inside ? "inside" : "above";
}

/// A builtin scene of clouds seen from the ground, from inside the layer, or from above it.
inline scene::Scene cloud_scene(scene::CloudType type, CloudView view) {
    scene::Scene scene = scene::builtin_cloud_scene(type);
    const scene::CloudLayer& layer = *std::get<scene::Clouds>(scene.nodes.at("sky").content).layer;
    if (view != CloudView::below) {
        const double share = view == CloudView::inside ? 0.25 : 1.3;
        const double altitude = layer.bottom_m + share * (layer.top_m - layer.bottom_m);
        scene.camera->edit([&](scene::Camera& camera) {
            camera.eye_world = {0.0, altitude, 0.0};
            camera.target_world = camera.eye_world + glm::dvec3(0.5, view == CloudView::inside ? 0.02 : -0.3, -0.8);
        });
    }
    return scene;
}

inline scene::Clouds& clouds_in(scene::Scene& scene) {
    return std::get<scene::Clouds>(scene.nodes.at("sky").content);
}

}  // namespace bruma::render
