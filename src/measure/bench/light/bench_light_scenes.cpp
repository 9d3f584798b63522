#include "measure/bench/light/bench_light.h"
#include "scene/builtin/builtin.h"

namespace bruma::measure {
namespace {

BenchScene light_scene(const std::string& name, const std::string& grid, double aspect) {
    scene::Volume volume;
    volume.source.file = "builtin:" + grid;
    volume.grid = scene::builtin_volume(grid);
    volume.transfer_function = scene::suggested_transfer_function(**volume.grid);
    BenchScene result{name, {}};
    scene::Node node;
    node.content = std::move(volume);
    result.scene.nodes[grid] = std::move(node);
    make_light_scene(result.scene);
    result.scene.camera = scene::fit_camera(scene::world_bounds(result.scene), aspect);
    return result;
}

}  // namespace

void make_light_scene(scene::Scene& scene) {
    scene.background = scene::Background{.top = glm::dvec3(0.0), .bottom = glm::dvec3(0.0)};
    scene.lights.clear();
    scene.lights["sun"] = scene::Light{};
}

std::vector<BenchScene> default_light_scenes(double aspect) {
    std::vector<BenchScene> scenes{light_scene("bucky", "bucky", aspect), light_scene("blobs", "blobs", aspect),
                                   light_scene("bucky, g = 0.7", "bucky", aspect),
                                   light_scene("bucky, point light", "bucky", aspect)};
    auto& forward = std::get<scene::Volume>(scenes[2].scene.nodes.begin()->second.content);
    forward.optics.edit([](scene::VolumeOptics& optics) { optics.g = 0.7; });
    // Half an edge beside the box, at the irradiance of the sun in its middle.
    scene::Scene& lamplit = scenes[3].scene;
    const scene::Bounds bounds = scene::world_bounds(lamplit);
    const glm::dvec3 edge = bounds.high - bounds.low;
    const glm::dvec3 way = edge * glm::dvec3(-0.3, 0.6, 1.0);
    scene::Light lamp{.kind = scene::LightKind::point, .position_world = 0.5 * (bounds.low + bounds.high) + way};
    lamp.intensity *= glm::dot(way, way);
    lamplit.lights["sun"] = lamp;
    return scenes;
}

}  // namespace bruma::measure
