#include "scene/scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <unordered_map>
#include <unordered_set>

#include "base/error.h"
#include "base/nearest_name.h"

namespace bruma::scene {
namespace {

bool all_finite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Null at the top, and where a name is none of a node.
const Node* parent_of(const Scene& scene, const Node& node) {
    const auto found = node.parent.empty() ? scene.nodes.end() : scene.nodes.find(node.parent);
    return found == scene.nodes.end() ? nullptr : &found->second;
}

/// A value of each node that follows from its parent's; `world` stands above the topmost. Each node is visited once,
/// without recursion, however long the chains of parents are.
template <class Value, class Combine>
std::unordered_map<const Node*, Value> from_parents(const Scene& scene, const Value& world, Combine&& combine) {
    std::unordered_map<const Node*, Value> known;
    std::vector<const Node*> way;
    for (const auto& [name, node] : scene.nodes) {
        const Node* at = &node;
        for (; at != nullptr && !known.contains(at); at = parent_of(scene, *at)) {
            way.push_back(at);
        }
        Value value = at != nullptr ? known.at(at) : world;
        for (; !way.empty(); way.pop_back()) {
            value = combine(value, *way.back());
            known.emplace(way.back(), value);
        }
    }
    return known;
}

void check_parents(const Scene& scene) {
    std::unordered_set<const Node*> good;
    for (const auto& [name, node] : scene.nodes) {
        std::unordered_set<const Node*> way;
        for (const Node* at = &node; !good.contains(at);) {
            way.insert(at);
            if (at->parent.empty()) {
                break;
            }
            const Node* const parent = parent_of(scene, *at);
            if (parent == nullptr) {
                std::vector<std::string> known;
                for (const auto& entry : scene.nodes) {
                    known.push_back(entry.first);
                }
                throw InputError(fmt::format("nodes.{}: its parent '{}' does not exist{}", name, at->parent,
                                             suggestion(at->parent, known)));
            }
            if (way.contains(parent)) {
                throw InputError(
                    fmt::format("nodes.{}: its parents form a circle through '{}'; let one of them have no parent",
                                name, at->parent));
            }
            at = parent;
        }
        good.insert(way.begin(), way.end());
    }
}

void check_volume(const std::string& name, const Volume& volume) {
    const ClipBox& clip = *volume.clip;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(clip.low[axis] < clip.high[axis])) {
            throw InputError(fmt::format(
                "nodes.{}.clip: along {} nothing is left between low {} and high {}; low must be below high", name,
                "xyz"[axis], clip.low[axis], clip.high[axis]));
        }
    }
    const TransferFunction& tf = *volume.transfer_function;
    if (tf.domain[0] == tf.domain[1]) {
        throw InputError(
            fmt::format("nodes.{}.transfer_function.domain: both ends are {}; give it some width", name, tf.domain[0]));
    }
    const VolumeOptics& optics = *volume.optics;
    if (optics.gradient_soft_from > optics.gradient_soft_to) {
        throw InputError(fmt::format("nodes.{}: gradient_soft_from {} is above gradient_soft_to {}; swap them", name,
                                     optics.gradient_soft_from, optics.gradient_soft_to));
    }
}

void check_mesh(const std::string& name, const Mesh& mesh) {
    const MeshSurface& surface = *mesh.surface;
    if (surface.shading != MeshShading::translucent) {
        return;
    }
    const glm::dvec3 scattering = medium_of(surface).reduced_scattering;
    if (!(std::min({scattering.r, scattering.g, scattering.b}) > 0.0)) {
        throw InputError(fmt::format(
            "nodes.{}.reduced_scattering: ({}, {}, {}) leaves a colour without scattering, which is not diffuse light; "
            "every part must be above 0",
            name, scattering.r, scattering.g, scattering.b));
    }
}

template <class Content>
std::vector<std::string> shown_nodes_with(const Scene& scene) {
    const auto shown = from_parents(
        scene, true, [](bool parent_is_shown, const Node& node) { return parent_is_shown && node.visible; });
    std::vector<std::string> names;
    for (const auto& [name, node] : scene.nodes) {
        if (std::holds_alternative<Content>(node.content) && shown.at(&node)) {
            names.push_back(name);
        }
    }
    return names;
}

}  // namespace

glm::dmat4 parent_from_model(const Transform& transform) {
    const glm::dvec3 angles = glm::radians(transform.rotation_deg);
    glm::dmat4 m = glm::translate(glm::dmat4(1.0), transform.translation);
    m = glm::rotate(m, angles.z, glm::dvec3(0.0, 0.0, 1.0));
    m = glm::rotate(m, angles.y, glm::dvec3(0.0, 1.0, 0.0));
    m = glm::rotate(m, angles.x, glm::dvec3(1.0, 0.0, 0.0));
    return glm::scale(m, transform.scale);
}

glm::dmat4 world_from_model(const Scene& scene, const std::string& node_name) {
    glm::dmat4 m(1.0);
    const Node& first = scene.nodes.at(node_name);
    if (const auto* mesh = std::get_if<Mesh>(&first.content); mesh != nullptr && *mesh->triangles) {
        m[3] = glm::dvec4(shift_of(*mesh), 1.0);
    }
    for (const Node* node = &first;; node = &scene.nodes.at(node->parent)) {
        m = parent_from_model(*node->transform) * m;
        if (node->parent.empty()) {
            return m;
        }
    }
}

glm::dmat4 world_from_texture(const Scene& scene, const std::string& node_name) {
    const auto& volume = std::get<Volume>(scene.nodes.at(node_name).content);
    const glm::dvec3 extent = (*volume.grid)->extent();
    const glm::dmat4 model_from_texture = glm::scale(glm::translate(glm::dmat4(1.0), -0.5 * extent), extent);
    return world_from_model(scene, node_name) * model_from_texture;
}

bool is_shown(const Scene& scene, const std::string& node_name) {
    for (const Node* node = &scene.nodes.at(node_name);; node = &scene.nodes.at(node->parent)) {
        if (!node->visible) {
            return false;
        }
        if (node->parent.empty()) {
            return true;
        }
    }
}

void check(const Scene& scene) {
    check_parents(scene);
    for (const auto& [name, node] : scene.nodes) {
        const Transform& transform = *node.transform;
        if (!all_finite(transform.translation) || !all_finite(transform.rotation_deg) || !all_finite(transform.scale) ||
            transform.scale.x * transform.scale.y * transform.scale.z == 0.0) {
            throw InputError(
                fmt::format("nodes.{}: scale ({}, {}, {}) cannot be undone; every part must be finite and not 0", name,
                            transform.scale.x, transform.scale.y, transform.scale.z));
        }
        if (const auto* volume = std::get_if<Volume>(&node.content)) {
            check_volume(name, *volume);
        }
        if (const auto* mesh = std::get_if<Mesh>(&node.content)) {
            check_mesh(name, *mesh);
        }
        if (const auto* clouds = std::get_if<Clouds>(&node.content)) {
            check(*clouds->layer, "nodes." + name);
        }
    }
    const auto linear = from_parents(scene, glm::dmat3(1.0), [](const glm::dmat3& parent, const Node& node) {
        return parent * glm::dmat3(parent_from_model(*node.transform));
    });
    for (const auto& [name, node] : scene.nodes) {
        const double volume = glm::determinant(linear.at(&node));
        if (!std::isfinite(volume) || volume == 0.0) {
            throw InputError(
                fmt::format("nodes.{}: with its parents it is scaled to {:g} times its volume, which cannot be undone; "
                            "bring their scales nearer to 1",
                            name, std::abs(volume)));
        }
    }
    for (const auto& [name, light] : scene.lights) {
        const bool aimed = light->kind == LightKind::directional || light->kind == LightKind::spot;
        const glm::dvec3 way = light->direction_world;
        const double length = glm::length(way);
        if (aimed && !(length > 0.0 && std::isfinite(length))) {
            throw InputError(
                fmt::format("lights.{}.direction: ({:g}, {:g}, {:g}) points nowhere; give the way to the light, of any "
                            "length around 1",
                            name, way.x, way.y, way.z));
        }
        if (const glm::dvec3 place = light->position_world; has_position(*light) && !all_finite(place)) {
            throw InputError(fmt::format("lights.{}.position: ({:g}, {:g}, {:g}) is no place; give finite numbers",
                                         name, place.x, place.y, place.z));
        }
    }
    if (scene.outdoors) {
        check(*scene.outdoors->sun, "sun.date");
    }
    if (scene.camera) {
        const Camera& camera = **scene.camera;
        if (camera.eye_world == camera.target_world) {
            throw InputError(fmt::format("camera: eye and target are both ({}, {}, {}); move one of them",
                                         camera.eye_world.x, camera.eye_world.y, camera.eye_world.z));
        }
    }
}

Bounds world_bounds(const Scene& scene) {
    bool empty = true;
    Bounds bounds;
    const auto take_box = [&](const glm::dmat4& world_from_box, const glm::dvec3& low, const glm::dvec3& high) {
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z,
                               1);
            const glm::dvec3 p_world = world_from_box * p;
            bounds.low = empty ? p_world : glm::min(bounds.low, p_world);
            bounds.high = empty ? p_world : glm::max(bounds.high, p_world);
            empty = false;
        }
    };
    for (const std::string& name : shown_volumes(scene)) {
        take_box(world_from_texture(scene, name), glm::dvec3(0.0), glm::dvec3(1.0));
    }
    for (const std::string& name : shown_meshes(scene)) {
        const TriangleMesh& mesh = **std::get<Mesh>(scene.nodes.at(name).content).triangles;
        take_box(world_from_model(scene, name), mesh.low, mesh.high);
    }
    return empty ? Bounds{glm::dvec3(-0.5), glm::dvec3(0.5)} : bounds;
}

Camera fit_camera(const Bounds& bounds, double aspect, glm::dvec3 back_world, glm::dvec3 up_world) {
    Camera camera;
    const glm::dvec3 center = 0.5 * (bounds.low + bounds.high);
    const double radius = std::max(1e-12, 0.5 * glm::length(bounds.high - bounds.low));
    const double half_angle = glm::radians(0.5 * camera.vertical_angle_deg);
    // The narrower of the two angles must still hold the bounding sphere.
    const double half_narrow = std::atan(std::tan(half_angle) * std::min(1.0, aspect));
    camera.target_world = center;
    camera.eye_world = center + glm::normalize(back_world) * (radius / std::sin(half_narrow));
    camera.up_world = up_world;
    camera.view_height = 2.0 * radius / std::min(1.0, aspect);
    camera.near_distance = 1e-3 * radius;
    return camera;
}

std::vector<std::string> shown_volumes(const Scene& scene) {
    return shown_nodes_with<Volume>(scene);
}

std::vector<std::string> shown_meshes(const Scene& scene) {
    return shown_nodes_with<Mesh>(scene);
}

std::vector<std::string> shown_clouds(const Scene& scene) {
    return shown_nodes_with<Clouds>(scene);
}

}  // namespace bruma::scene
