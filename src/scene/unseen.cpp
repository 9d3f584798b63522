#include "scene/unseen.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bruma::scene {
namespace {

/// Where a box lies for a camera.
enum class Standing { in_view, too_small, behind, beside };

struct Seen {
    std::string name;
    Standing standing = Standing::beside;
    double pixels = 0.0;  ///< along the longer edge of what it covers
};

/// Judged by its eight corners alone, in favour of being seen.
Seen look_at_box(const std::string& name, const Camera& camera, glm::ivec2 pixels, const glm::dmat4& world_from_box,
                 const glm::dvec3& low, const glm::dvec3& high) {
    const CameraFrame frame = camera_frame(camera);
    const double tangent = std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    const bool parallel = camera.projection == Projection::orthographic;
    glm::dvec2 smallest(1e300), largest(-1e300);  // 1 at the upper and the right edge of the picture
    double farthest = -1e300, nearest = 1e300;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z, 1.0);
        const glm::dvec3 to = glm::dvec3(world_from_box * p) - camera.eye_world;
        const double depth = -glm::dot(to, frame.back_world);
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
        const double half_height = parallel ? 0.5 * camera.view_height : depth * tangent;
        const glm::dvec2 place(glm::dot(to, frame.right_world) * pixels.y / pixels.x, glm::dot(to, frame.up_world));
        smallest = glm::min(smallest, place / half_height);
        largest = glm::max(largest, place / half_height);
    }
    if (farthest <= camera.near_distance) {
        return {name, Standing::behind, 0.0};
    }
    if (nearest <= camera.near_distance && !parallel) {
        return {name, Standing::in_view, 1e300};  // around the eye: its corners tell nothing of where it is seen
    }
    const glm::dvec2 size = 0.5 * (largest - smallest) * glm::dvec2(pixels);
    const double longest = std::max(size.x, size.y);
    if (std::max(smallest.x, smallest.y) > 1.0 || std::min(largest.x, largest.y) < -1.0) {
        return {name, Standing::beside, longest};
    }
    return {name, longest < 1.0 ? Standing::too_small : Standing::in_view, longest};
}

std::string hidden_words(const Scene& scene, const std::vector<std::string>& names) {
    const Node* node = &scene.nodes.at(names.front());
    std::string name = names.front();
    while (node->visible) {
        name = node->parent;
        node = &scene.nodes.at(name);
    }
    return fmt::format("{}; set nodes.{}.visible=true to see it",
                       names.size() == 1 ? fmt::format("'{}' is hidden", names.front())
                                         : fmt::format("all {} of them are hidden", names.size()),
                       name);
}

}  // namespace

std::string why_nothing_is_seen(const Scene& scene, glm::ivec2 pixels) {
    std::vector<std::string> names;
    for (const auto& [name, node] : scene.nodes) {
        if (!std::holds_alternative<Group>(node.content)) {
            names.push_back(name);
        }
    }
    if (names.empty() || !scene.camera) {
        return {};
    }
    const std::string_view what = "no shown node covers a pixel of the picture";
    const std::vector<std::string> volumes = shown_volumes(scene);
    const std::vector<std::string> meshes = shown_meshes(scene);
    const std::vector<std::string> clouds = shown_clouds(scene);
    if (volumes.empty() && meshes.empty() && clouds.empty()) {
        return fmt::format("{}: {}", what, hidden_words(scene, names));
    }
    const Camera& camera = **scene.camera;
    std::vector<Seen> seen;
    for (const std::string& name : volumes) {
        const ClipBox& clip = *std::get<Volume>(scene.nodes.at(name).content).clip;
        seen.push_back(look_at_box(name, camera, pixels, world_from_texture(scene, name), clip.low, clip.high));
    }
    for (const std::string& name : meshes) {
        const TriangleMesh& mesh = **std::get<Mesh>(scene.nodes.at(name).content).triangles;
        seen.push_back(look_at_box(name, camera, pixels, world_from_model(scene, name), mesh.low, mesh.high));
    }
    const auto first = [&](Standing standing) {
        return std::find_if(seen.begin(), seen.end(), [&](const Seen& one) { return one.standing == standing; });
    };
    if (const auto one = first(Standing::in_view); one != seen.end()) {
        return std::holds_alternative<Volume>(scene.nodes.at(one->name).content)
                   ? fmt::format(
                         "{}: the volume '{}' lies in the view and lets all light through; raise the opacity of its "
                         "transfer function where its data lie, or its density_scale, or widen its clip box",
                         what, one->name)
                   : fmt::format(
                         "{}: the box of '{}' lies in the view, but none of its triangles; press F in the "
                         "window, or let --camera show everything",
                         what, one->name);
    }
    if (const auto one = first(Standing::too_small); one != seen.end()) {
        return fmt::format(
            "{}: '{}' is {:.2g} pixels wide in it{}; show it alone, or bring camera, nodes.NAME.transform or "
            "millimetres_per_unit nearer to it",
            what, one->name, one->pixels,
            seen.size() > 1 ? fmt::format(", so far apart stand the {} nodes", seen.size()) : std::string());
    }
    if (seen.empty()) {
        return fmt::format("{}: the clouds stand elsewhere or are too thin; look up, or raise clouds.coverage", what);
    }
    const bool behind =
        std::all_of(seen.begin(), seen.end(), [](const Seen& one) { return one.standing == Standing::behind; });
    return fmt::format(
        "{}: {} {}; press F in the window, or let --camera show everything", what,
        seen.size() == 1 ? fmt::format("'{}' lies", seen.front().name) : fmt::format("all {} lie", seen.size()),
        behind ? "behind the camera" : "beside the view");
}

}  // namespace bruma::scene
