#include "render/clouds/cloud_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/clouds/cloud_cells.h"
#include "render/clouds/cloud_uniforms.h"

namespace bruma::render {
namespace {

constexpr double lowest_sun_sine = 0.06;

/// Longest way between two samples towards the sun, metres: finer than the texels of the shape noise.
constexpr double sun_sample_m = 50.0;

/// Repeats along the weather map and ends above and below.
void repeat_sideways(const gl::Texture& texture) {
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_T, GL_REPEAT);
}

GLuint groups_of(int size) {
    return GLuint((size + 7) / 8);
}

/// The layer without what its grids do not depend on: the wind moves all of it alike.
scene::CloudLayer still(scene::CloudLayer layer) {
    layer.wind_speed_m_s = 0.0;
    layer.box_center_m = layer.box_size_m = {0.0, 0.0};
    layer.bounds = scene::CloudBounds::shell;
    return layer;
}

}  // namespace

glm::dvec2 sun_lean(const glm::dvec3& to_sun_world) {
    const double rise = std::max(to_sun_world.y, lowest_sun_sine);
    return {to_sun_world.x / rise, to_sun_world.z / rise};
}

CloudPasses::CloudPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, const std::string& name)
    : graph_(graph), shaders_(shaders) {
    map_ = graph.add_source<Map>(name + ": weather map");
    shader_revision_ = graph.add_source<int>("shaders");
    weather = graph.add_product<CloudWeatherTextures>(name + ": weather");
    columns = graph.add_product<CloudColumns>(name + ": columns");
    sun = graph.add_product<CloudSunDepths>(name + ": sun");
    upload_ = graph.add_pass({name + ": cloud_weather",
                              "the weather map, and where it leaves the sky clear",
                              {map_.index},
                              {weather.index},
                              {}});
    columns_ = graph.add_pass({name + ": cloud_columns", "optical depth above every point", {}, {columns.index}, {}});
    sun_ = graph.add_pass({name + ": cloud_sun", "optical depth from every point to the sun", {}, {sun.index}, {}});
}

void CloudPasses::remove() {
    for (const PassId pass : {upload_, columns_, sun_}) {
        graph_.remove_pass(pass);
    }
    graph_.remove_source(map_.index);
    graph_.remove_source(shader_revision_.index);
}

void CloudPasses::update(const scene::Clouds& clouds, Handle<CloudNoise> noise, const glm::dvec3& to_sun_world) {
    graph_.set_source(map_, *clouds.map, clouds.map.revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    const scene::CloudLayer layer = still(*clouds.layer);
    graph_.set_parameters(upload_, layer);
    graph_.set_execute(upload_, [this, layer](const PassAccess& access) { upload(access, layer); });

    const Field field{layer, clouds.optics->extinction_per_m, int(clouds.march->grid_columns),
                      int(clouds.march->grid_slices)};
    graph_.set_reads(columns_, {map_.index, weather.index, noise.index, shader_revision_.index});
    graph_.set_parameters(columns_, field);
    graph_.set_execute(columns_,
                       [this, field, noise](const PassAccess& access) { make_columns(access, field, noise); });

    const SunParameters parameters{field, to_sun_world};
    graph_.set_reads(sun_, {map_.index, weather.index, columns.index, noise.index, shader_revision_.index});
    graph_.set_parameters(sun_, parameters);
    graph_.set_execute(sun_,
                       [this, parameters, noise](const PassAccess& access) { make_sun(access, parameters, noise); });
}

void CloudPasses::upload(const PassAccess& access, const scene::CloudLayer& layer) {
    const scene::WeatherMap& map = *access.read(map_);
    CloudWeatherTextures& out = access.write(weather);
    // Sixteen bits, because some drivers filter eight bits in eight bits.
    out.map = gl::Texture::make_2d("cloud weather", GL_RGBA16, {map.width, map.height});
    out.map.upload({GL_RGBA, GL_UNSIGNED_BYTE}, map.rgba.data());
    out.map.set_repeat();
    const CloudCells cells = make_cloud_cells(layer, map);
    out.emptiness =
        gl::Texture::make_3d("cloud emptiness", GL_R8UI, {CloudCells::edge, CloudCells::edge, CloudCells::slices});
    out.emptiness.set_nearest();
    out.emptiness.upload({GL_RED_INTEGER, GL_UNSIGNED_BYTE}, cells.distance.data());
    access.note(fmt::format("{} x {} texels, {:.0f} % of the cells may hold cloud", map.width, map.height,
                            100.0 * cells.occupied_share));
}

void CloudPasses::make_columns(const PassAccess& access, const Field& field, Handle<CloudNoise> noise) {
    const scene::CloudBand band = scene::cloud_band(field.layer, access.read(map_)->largest());
    const glm::ivec3 size(field.edge, field.edge, field.slices);
    CloudColumns& out = access.write(columns);
    if (!out.up || out.up.size() != size) {
        out.up = gl::Texture::make_3d("cloud columns", GL_R16F, size);
        repeat_sideways(out.up);
    }
    gl::Program& program = shaders_.get("clouds/cloud_columns.comp", cloud_field_defines(field.layer));
    GLuint unit = 0;
    set_cloud_field(program, field.layer, tile_origins(), access.read(weather).map, access.read(noise), unit);
    program.set("band", glm::vec2(band.low_m, band.high_m));
    program.set("extinction", float(field.extinction_per_m));
    program.use();
    glBindImageTexture(0, out.up.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R16F);
    glDispatchCompute(groups_of(size.x), groups_of(size.y), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    access.note(fmt::format("{} x {} columns of {} nodes", size.x, size.y, size.z));
}

void CloudPasses::make_sun(const PassAccess& access, const SunParameters& parameters, Handle<CloudNoise> noise) {
    const Field& field = parameters.field;
    const scene::CloudBand band = scene::cloud_band(field.layer, access.read(map_)->largest());
    const glm::ivec3 size(field.edge, field.edge, field.slices);
    CloudSunDepths& out = access.write(sun);
    if (!out.depths || out.depths.size() != size) {
        out.depths = gl::Texture::make_3d("cloud depths", GL_RGBA16F, size);
        repeat_sideways(out.depths);
    }
    out.band = band;
    const glm::dvec2 lean = sun_lean(parameters.to_sun_world);
    const double lengthening = std::sqrt(1.0 + glm::dot(lean, lean));
    const double slice = (band.high_m - band.low_m) / (field.slices - 1);
    const int parts = std::clamp(int(std::ceil(slice * lengthening / sun_sample_m)), 1, 16);
    gl::Program& program = shaders_.get("clouds/cloud_sun.comp", cloud_field_defines(field.layer));
    GLuint unit = 0;
    set_cloud_field(program, field.layer, tile_origins(), access.read(weather).map, access.read(noise), unit);
    access.read(columns).up.bind(unit);
    program.set("depth_up", int(unit));
    program.set("band", glm::vec2(band.low_m, band.high_m));
    program.set("extinction", float(field.extinction_per_m));
    program.set("lean", glm::vec2(lean));
    program.set("lengthening", float(lengthening));
    program.set("parts", parts);
    program.use();
    glBindImageTexture(0, out.depths.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glDispatchCompute(groups_of(size.x), groups_of(size.y), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    access.note(fmt::format("{} x {} columns of {} nodes, {} samples between two", size.x, size.y, size.z, parts));
}

}  // namespace bruma::render
