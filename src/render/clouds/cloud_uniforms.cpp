#include "render/clouds/cloud_uniforms.h"

#include <cmath>

namespace bruma::render {
namespace {

double fraction(double v) {
    return v - std::floor(v);
}

}  // namespace

gl::Defines cloud_field_defines(const scene::CloudLayer& layer) {
    gl::Defines defines;
    if (layer.coverage_rule == scene::CoverageRule::overlay) {
        defines["OVERLAY"] = "";
    }
    if (layer.density_follows_top) {
        defines["FOLLOWS_TOP"] = "";
    }
    if (layer.linear_coverage) {
        defines["LINEAR_COVERAGE"] = "";
    }
    if (layer.packing == scene::NoisePacking::packed) {
        defines["PACKED"] = "";
    }
    return defines;
}

CloudOrigins cloud_origins(const scene::CloudLayer& layer, const glm::dvec3& place_world, double time_s) {
    const glm::dvec3 drifted = scene::wind_direction_world(layer) * (layer.wind_speed_m_s * time_s);
    const double x = place_world.x - drifted.x;
    const double z = place_world.z - drifted.z;
    const auto of = [&](double tile) { return glm::dvec3(fraction(x / tile), 0.0, fraction(z / tile)); };
    const glm::dvec3 weather = of(layer.weather_tile_m);
    return {{weather.x, weather.z}, of(layer.shape_tile_m), of(layer.detail_tile_m)};
}

void set_cloud_field(gl::Program& program, const scene::CloudLayer& layer, const CloudOrigins& origins,
                     const gl::Texture& weather, const CloudNoise& noise, GLuint& unit) {
    const auto bind = [&](const char* sampler, const gl::Texture& texture) {
        texture.bind(unit);
        program.set(sampler, int(unit++));
    };
    bind("weather_map", weather);
    bind("shape_texture", noise.shape);
    bind("detail_texture", noise.detail);
    if (layer.linear_coverage) {
        bind("coverage_table", noise.coverage);
    }
    const double sign = layer.erosion == scene::CloudErosion::fades ? -1.0 : 1.0;
    const glm::dvec3 lead = scene::wind_direction_world(layer) * layer.skew_m;
    program.set("layer.bottom", float(layer.bottom_m));
    program.set("layer.inverse_thickness", float(1.0 / (layer.top_m - layer.bottom_m)));
    program.set("layer.coverage", float(layer.coverage));
    program.set("layer.density", float(layer.density));
    program.set("layer.erosion", float(0.35 * std::exp(sign * 0.75 * layer.coverage)));
    program.set("layer.weather_origin", glm::vec2(origins.weather));
    program.set("layer.shape_origin", glm::vec3(origins.shape));
    program.set("layer.detail_origin", glm::vec3(origins.detail));
    program.set("layer.scales",
                glm::vec3(1.0 / layer.weather_tile_m, 1.0 / layer.shape_tile_m, 1.0 / layer.detail_tile_m));
    program.set("layer.skew", glm::vec2(lead.x, lead.z));
}

}  // namespace bruma::render
