#include "render/clouds/cloud_shafts_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/clouds/cloud_sky_pass.h"
#include "render/view_rays.h"

namespace bruma::render {
namespace {

// Rays along the picture's longer edge: at 42 degrees over 288 pixels of 512 they are as far apart as the grid of
// light's columns 5 km away, and a pixel looks up its own distance, so that edges stay sharp. Fewer in small pictures
// would be seen along a horizon under low clouds. Steps begin at 86 m and are as long as most clouds, 1 km, at 11 km.
constexpr int rays_along = 80, shaft_slices = 64;
constexpr double near_m = 1000.0, sample_m = 1000.0;

int cell_of(glm::ivec2 pixels) {
    return (std::max(pixels.x, pixels.y) + rays_along - 1) / rays_along;
}

}  // namespace

void CloudShafts::set(gl::Program& program, const scene::Camera& camera, glm::ivec2 pixels, GLuint& unit) const {
    const scene::CameraFrame frame = scene::camera_frame(camera);
    missing.bind(unit);
    program.set("shafts_missing", int(unit++));
    missing_share.bind(unit);
    program.set("shafts_share", int(unit++));
    ground.bind(unit);
    program.set("shafts_ground", int(unit++));
    program.set("shafts.first", float(first_m));
    program.set("shafts.near", float(near_m));
    program.set("shafts.growth", float(growth));
    program.set("shafts_sun", glm::vec3(sun_irradiance));
    program.set("shafts_from_pixels", glm::vec2(1.0 / (glm::dvec2(missing.size()) * double(cell))));
    program.set("shafts_axes", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
    program.set("shafts_altitude", float(std::max(1.0, camera.eye_world.y)));
    program.set("shafts_planet_radius", float(planet_radius_m));
    program.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("pixels", glm::vec2(pixels));
}

CloudShaftsPass::CloudShaftsPass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    shader_revision_ = graph.add_source<int>("shaders");
    shafts = graph.add_product<CloudShafts>("light missing in air");
    pass_ = graph.add_pass(
        {"cloud_shafts", "light that air and ground miss in the shadows of clouds", {}, {shafts.index}, {}});
}

void CloudShaftsPass::remove() {
    graph_.remove_pass(pass_);
    graph_.remove_source(camera_.index);
    graph_.remove_source(shader_revision_.index);
}

void CloudShaftsPass::update(const scene::Scene& scene, const CloudShadows& shadows, const AirTables& air,
                             double reach_m, glm::ivec2 pixels) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    std::vector<int> reads{camera_.index, shader_revision_.index, air.transmittance.index};
    if (air.multiple_scattering.index >= 0) {
        reads.push_back(air.multiple_scattering.index);
    }
    shadows.add_reads(reads);
    const Parameters parameters{pixels, shadows, air, sun_direction_world(scene), reach_m};
    graph_.set_reads(pass_, reads);
    graph_.set_parameters(pass_, parameters);
    graph_.set_execute(pass_, [this, parameters](const PassAccess& access) { draw(access, parameters); });
}

void CloudShaftsPass::draw(const PassAccess& access, const Parameters& parameters) {
    const scene::Camera& camera = access.read(camera_);
    const scene::CameraFrame frame = scene::camera_frame(camera);
    double top = 0.0;
    for (const CloudShadows::Layer& layer : parameters.shadows.layers) {
        top = std::max(top, access.read(layer.depths).band.high_m);
    }
    CloudShafts& out = access.write(shafts);
    out.first_m = camera.projection == scene::Projection::orthographic ? 0.0 : std::max(0.0, camera.eye_world.y - top);
    out.near_m = near_m;
    out.growth = std::log1p(std::max(parameters.reach_m - out.first_m, near_m) / near_m);
    out.cell = cell_of(parameters.pixels);
    out.sun_irradiance = parameters.air.sun_irradiance;
    out.planet_radius_m = parameters.air.atmosphere.planet_radius_m;
    const glm::ivec3 size((parameters.pixels + out.cell - 1) / out.cell, shaft_slices);
    if (!out.missing || out.missing.size() != size) {
        out.missing = gl::Texture::make_3d("light missing in air", GL_RGBA16F, size);
        out.missing_share = gl::Texture::make_3d("share of light missing in air", GL_RGBA16F, size);
        out.ground = gl::Texture::make_3d("lit ground behind air", GL_RGBA16F, size);
    }
    gl::Defines defines;
    parameters.shadows.add_defines(defines);
    gl::Program& program = shaders_.get("clouds/cloud_shafts.comp", defines);
    program.set("pixels", glm::vec2(parameters.pixels));
    program.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(camera, parameters.pixels, 1.0)));
    program.set("world_from_camera", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
    program.set("eye_altitude", float(std::max(1.0, camera.eye_world.y)));
    program.set("to_sun", glm::vec3(parameters.to_sun_world));
    program.set("cell", float(out.cell));
    program.set("top", float(top));
    program.set("sample_m", float(sample_m));
    program.set("shafts.first", float(out.first_m));
    program.set("shafts.near", float(out.near_m));
    program.set("shafts.growth", float(out.growth));
    GLuint unit = 0;
    set_air(access, program, parameters.air, unit);
    parameters.shadows.set(access, program, camera.eye_world, 1.0, unit);
    program.use();
    glBindImageTexture(0, out.missing.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glBindImageTexture(1, out.missing_share.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glBindImageTexture(2, out.ground.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    glDispatchCompute(GLuint((size.x + 7) / 8), GLuint((size.y + 7) / 8), 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    access.note(fmt::format("{} x {} rays of {} steps", size.x, size.y, size.z - 1));
}

}  // namespace bruma::render
