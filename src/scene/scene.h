#pragma once
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <string>
#include <variant>

#include "base/revision.h"
#include "scene/camera.h"
#include "scene/clouds/clouds.h"
#include "scene/light.h"
#include "scene/mesh/mesh.h"
#include "scene/rendering.h"
#include "scene/sky/sky.h"
#include "scene/timeline.h"
#include "scene/volume/volume.h"

namespace bruma::scene {

/// Parent from model: scale first, then rotation (x, then y, then z axis), then translation.
struct Transform {
    glm::dvec3 translation{0.0};   ///< metres
    glm::dvec3 rotation_deg{0.0};  ///< right-handed angles about x, y, z, applied in this order
    glm::dvec3 scale{1.0};
    bool operator==(const Transform&) const = default;
};
glm::dmat4 parent_from_model(const Transform& transform);

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Transform>
void visit_fields(Self& transform, Visitor&& visit) {
    visit(Field{.name = "translation", .unit = "m", .sentence = "where its origin stands in the parent's space"},
          transform.translation);
    visit(Field{.name = "rotation",
                .unit = "deg",
                .sentence = "about x, then y, then z",
                .panel_min = -180.0,
                .panel_max = 180.0},
          transform.rotation_deg);
    visit(Field{.name = "scale", .sentence = "along each of its own axes; not 0", .min = -1e9, .max = 1e9},
          transform.scale);
}

/// A node without content, only there to move others.
struct Group {};

/// Something in the world, placed relative to its parent.
struct Node {
    std::string parent;  ///< name of another node; empty: the world
    bool visible = true;
    Tracked<Transform> transform;
    std::variant<Group, Volume, Mesh, Clouds> content;
};

/// Sun and air around everything. The ground is y = 0, and the planet goes with the camera: up is y and the altitude of
/// the camera is its y wherever it stands; away from it the ground curves down.
struct Outdoors {
    Tracked<Sky> sky;
    Tracked<Sun> sun;
    Tracked<Atmosphere> atmosphere;
};

/// How files that are added find their place.
struct Placement {
    bool common_coordinates = false;  ///< where their own coordinates say, and not side by side
    bool operator==(const Placement&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Placement>
void visit_fields(Self& placement, Visitor&& visit) {
    visit(Field{.name = "common_coordinates",
                .sentence = "files that are added stand where their own coordinates say: neither side by side nor set "
                            "upright, in one unit, volumes with their first sample at 0"},
          placement.common_coordinates);
}

/// All that a picture depends on. Plain data; no GL and no files.
struct Scene {
    /// Unset until someone chooses: the scene is then framed by `fit_camera`.
    std::optional<Tracked<Camera>> camera;
    /// Unset: the background is seen behind all, and only `lights` shine.
    std::optional<Outdoors> outdoors;
    Tracked<Background> background;
    Tracked<Environment> environment;
    Tracked<RenderSettings> rendering;
    Tracked<Display> display;
    Tracked<Timeline> time;
    Tracked<Placement> placement;
    std::map<std::string, Tracked<Light>> lights;
    std::map<std::string, Node> nodes;
};

/// World from the node's model space through all its parents; of a mesh from that of its triangles, wherever the
/// coordinates of its file stand. The scene must have passed `check`. Takes time with the number of parents.
glm::dmat4 world_from_model(const Scene& scene, const std::string& node_name);

/// World from texture space [0,1]^3 of a volume node.
glm::dmat4 world_from_texture(const Scene& scene, const std::string& node_name);

/// Whether the node and all its parents are visible.
bool is_shown(const Scene& scene, const std::string& node_name);

/// Throws InputError for what no picture can be made of: unknown or cyclic parents, transforms without inverse, empty
/// clip boxes, transfer functions without width, lights without direction.
void check(const Scene& scene);

struct Bounds {
    glm::dvec3 low{0.0}, high{0.0};  ///< world, metres
};
/// Box around all shown nodes; a unit box when there are none.
Bounds world_bounds(const Scene& scene);

/// A camera that shows all of `bounds` from the direction `back_world`, a little to the right and above by default.
Camera fit_camera(const Bounds& bounds, double aspect, glm::dvec3 back_world = {0.5, 0.35, 0.9},
                  glm::dvec3 up_world = {0.0, 1.0, 0.0});

/// Names of all shown volume nodes, in order.
std::vector<std::string> shown_volumes(const Scene& scene);
/// Names of all shown mesh nodes, in order.
std::vector<std::string> shown_meshes(const Scene& scene);
/// Names of all shown nodes with clouds, in order.
std::vector<std::string> shown_clouds(const Scene& scene);

}  // namespace bruma::scene
