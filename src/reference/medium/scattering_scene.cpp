#include "reference/medium/scattering_scene.h"

namespace bruma::reference {

ScatteringScene::ScatteringScene(const scene::Scene& scene)
    : volumes(prepare_volumes(scene)),
      environment(scene.environment->radiance),
      camera_back_world(scene::camera_frame(**scene.camera).back_world) {
    for (const auto& [name, light] : scene.lights) {
        if (scene::shines(*light)) {
            lights.push_back(*light);
        }
    }
}

}  // namespace bruma::reference
