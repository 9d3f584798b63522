#pragma once
#include <vector>

#include "reference/volume/prepared_volume.h"
#include "scene/scene.h"

namespace bruma::reference {

/// A scene made ready for light that scatters. May be used from several threads.
struct ScatteringScene {
    /// Throws InputError as `prepare_volumes` does.
    explicit ScatteringScene(const scene::Scene& scene);

    /// Light as it arrives at a point from one of the `lights`, without anything in between.
    scene::Incident incident(const scene::Light& light, glm::dvec3 point_world) const {
        return scene::incident_light(light, point_world, camera_back_world);
    }

    std::vector<PreparedVolume> volumes;
    std::vector<scene::Light> lights;  ///< those that shine
    glm::dvec3 environment;            ///< radiance from all sides
    glm::dvec3 camera_back_world;      ///< where a headlight shines from
};

}  // namespace bruma::reference
