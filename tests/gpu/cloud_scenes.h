#pragma once
#include "reference/clouds/cloud_field.h"
#include "scene/builtin/builtin_clouds.h"

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

/// Weather of one value everywhere.
inline void set_even_weather(scene::Scene& scene, glm::u8vec4 weather) {
    auto map = std::make_shared<scene::WeatherMap>();
    map->name = "even";
    map->width = map->height = 8;
    for (int n = 0; n < 64; ++n) {
        map->rgba.insert(map->rgba.end(), {weather.r, weather.g, weather.b, weather.a});
    }
    scene::clouds_in(scene).map = std::shared_ptr<const scene::WeatherMap>(std::move(map));
}

/// The scene's density, in double.
inline reference::CloudField exact_field(scene::Scene& scene) {
    const scene::Clouds& clouds = scene::clouds_in(scene);
    return {*clouds.layer, *clouds.map, reference::normative_cloud_noise(), scene.time->now_s};
}

}  // namespace bruma::render
