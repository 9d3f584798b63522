#include "render/clouds/cloud_shadows.h"

#include <fmt/core.h>

#include <algorithm>

#include "render/clouds/cloud_sky_pass.h"
#include "render/clouds/cloud_uniforms.h"
#include "render/view_rays.h"
#include "scene/sky/sun_lamp.h"

namespace bruma::render {
namespace {

/// Around the box of a layer from above, from the eye; a shell ends nowhere.
glm::vec4 sides(const scene::CloudLayer& layer, const glm::dvec3& eye_world) {
    if (layer.bounds == scene::CloudBounds::shell) {
        return {-1e30F, -1e30F, 1e30F, 1e30F};
    }
    const glm::dvec2 middle(layer.box_center_m[0] - eye_world.x, layer.box_center_m[1] - eye_world.z);
    const glm::dvec2 half = 0.5 * glm::dvec2(layer.box_size_m[0], layer.box_size_m[1]);
    return {middle - half, middle + half};
}

}  // namespace

std::string shadows_left_out(const std::vector<std::string>& shown) {
    if (shown.size() <= most_shadow_layers) {
        return {};
    }
    return fmt::format(
        "nodes.{}: of {} layers of clouds the first {} by name throw shadows; hide others, or give one "
        "that should a name before them",
        shown[most_shadow_layers], shown.size(), most_shadow_layers);
}

int cloud_lamp(const scene::Scene& scene) {
    const std::vector<std::string> names = order_lights(scene);
    const auto sun = std::find_if(names.begin(), names.end(), [&](const std::string& name) {
        return scene.outdoors ? name == scene::sun_lamp_name
                              : scene.lights.at(name)->kind == scene::LightKind::directional;
    });
    return sun == names.end() ? -1 : int(sun - names.begin());
}

void CloudShadows::add_reads(std::vector<int>& reads) const {
    for (const Layer& layer : layers) {
        reads.push_back(layer.depths.index);
    }
}

void CloudShadows::add_defines(gl::Defines& defines) const {
    if (!layers.empty()) {
        defines["CLOUD_SHADOWS"] = std::to_string(layers.size());
    }
}

void CloudShadows::set(const PassAccess& access, gl::Program& program, const glm::dvec3& eye_world, double unit_world,
                       GLuint unit) const {
    program.set("cloud_lean", glm::vec2(lean));
    program.set("cloud_lamp", lamp);
    program.set("cloud_metres", glm::vec2(unit_world, eye_world.y));
    for (int n = 0; n < int(layers.size()); ++n) {
        const auto& [layer, time_s, turned, depths] = layers[std::size_t(n)];
        const CloudSunDepths& grid = access.read(depths);
        grid.depths.bind(unit);
        program.set_at("cloud_depths", n, "", int(unit++));
        program.set_at("cloud_shades", n, ".origin", glm::vec2(cloud_origins(layer, eye_world, time_s).weather));
        program.set_at("cloud_shades", n, ".scale", float(1.0 / layer.weather_tile_m));
        program.set_at("cloud_shades", n, ".band", glm::vec2(grid.band.low_m, grid.band.high_m));
        program.set_at("cloud_shades", n, ".box", sides(layer, eye_world));
        program.set_at("cloud_shades", n, ".turned", float(turned));
    }
}

CloudShadows cloud_shadows(const scene::Scene& scene, const std::vector<std::string>& shown,
                           const std::vector<Handle<CloudSunDepths>>& depths) {
    CloudShadows shadows;
    shadows.lamp = cloud_lamp(scene);
    shadows.lean = sun_lean(sun_direction_world(scene));
    for (std::size_t n = 0; shadows.lamp >= 0 && n < std::min(shown.size(), most_shadow_layers); ++n) {
        const auto& clouds = std::get<scene::Clouds>(scene.nodes.at(shown[n]).content);
        shadows.layers.push_back({*clouds.layer, clouds.layer->wind_speed_m_s > 0.0 ? scene.time->now_s : 0.0,
                                  1.0 - scene::mean_asymmetry(*clouds.optics), depths[n]});
    }
    return shadows;
}

}  // namespace bruma::render
