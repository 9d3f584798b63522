#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/progress.h"
#include "scene/scene.h"

namespace bruma::io {

/// What files with common coordinates share.
struct CommonCoordinates {
    std::optional<double> millimetres_per_unit;  ///< of meshes that do not say theirs; empty: not settled yet
    glm::dvec3 origin_m{0.0};                    ///< what stands at 0 of the world
    bool settled = false;                        ///< something stands in the scene already
};
CommonCoordinates common_coordinates(const scene::Scene& scene);

/// A mesh for a new node called `name`, and how the node is turned and moved before it is put beside others. Of the
/// settings those about its source hold before it is read. What is far from the origin of its file (see
/// scene::make_mesh) stands at 0, unless the scene keeps common coordinates, and what plainly has z as its up axis is
/// turned so that y is; both are said. Throws as `load_mesh`.
struct AddedMesh {
    scene::Mesh mesh;
    scene::Transform transform;
};
AddedMesh read_added_mesh(const scene::Scene& scene, const std::string& name, const std::string& file,
                          std::span<const std::string> settings, const Progress& progress,
                          const std::vector<std::filesystem::path>& preset_folders);

}  // namespace bruma::io
