#include "app/viewer/scene_stamp.h"

#include <algorithm>
#include <functional>
#include <string>

namespace bruma::app {
namespace {

void append_content(SceneStamp& stamp, const scene::Scene& scene) {
    const std::hash<std::string> hash;
    stamp.push_back(scene.background.revision());
    stamp.push_back(scene.environment.revision());
    stamp.push_back(scene.rendering.revision());
    if (scene.outdoors) {
        stamp.push_back(scene.outdoors->sky.revision());
        stamp.push_back(scene.outdoors->sun.revision());
        stamp.push_back(scene.outdoors->atmosphere.revision());
    }
    for (const auto& [name, light] : scene.lights) {
        stamp.push_back(hash(name));
        stamp.push_back(light.revision());
    }
    for (const auto& [name, node] : scene.nodes) {
        stamp.push_back(hash(name));
        stamp.push_back(hash(node.parent));
        stamp.push_back(node.visible ? 1 : 0);
        stamp.push_back(node.transform.revision());
        if (const auto* volume = std::get_if<scene::Volume>(&node.content)) {
            stamp.push_back(volume->grid.revision());
            stamp.push_back(volume->transfer_function.revision());
            stamp.push_back(volume->optics.revision());
            stamp.push_back(volume->clip.revision());
            stamp.push_back(volume->light_volume.revision());
        }
        if (const auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
            stamp.push_back(mesh->triangles.revision());
            stamp.push_back(mesh->surface.revision());
            stamp.push_back(mesh->subsurface.revision());
        }
        if (const auto* clouds = std::get_if<scene::Clouds>(&node.content)) {
            stamp.insert(stamp.end(), {clouds->layer.revision(), clouds->optics.revision(), clouds->weather.revision(),
                                       clouds->march.revision()});
        }
    }
}

}  // namespace

SceneStamp picture_stamp(const scene::Scene& scene) {
    SceneStamp stamp{scene.camera ? scene.camera->revision() : 0, scene.time.revision()};
    append_content(stamp, scene);
    return stamp;
}

bool same_but_for_view(const SceneStamp& first, const SceneStamp& second) {
    return first.size() == second.size() && first.size() >= 2 &&
           std::equal(first.begin() + 2, first.end(), second.begin() + 2);
}

SceneStamp document_stamp(const scene::Scene& scene) {
    SceneStamp stamp{scene.display.revision()};
    const scene::Timeline& time = *scene.time;
    for (const double part : {time.start_s, time.end_s, time.speed, time.frame_rate, time.loop ? 1.0 : 0.0}) {
        stamp.push_back(std::hash<double>()(part));
    }
    append_content(stamp, scene);
    return stamp;
}

}  // namespace bruma::app
