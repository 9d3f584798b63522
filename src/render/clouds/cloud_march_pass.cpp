#include "render/clouds/cloud_march_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/integer_hash.h"
#include "render/blue_noise.h"
#include "render/clouds/cloud_cells.h"
#include "render/view_rays.h"
#include "scene/sky/sky.h"

namespace bruma::render {
namespace {

void make_targets(CloudCounts& counts, glm::ivec2 pixels) {
    if (!counts.counts || glm::ivec2(counts.counts.size()) != pixels) {
        counts.framebuffer = {};
        counts.radiance = gl::Texture::make_2d("clouds while counting", GL_RGBA32F, pixels);
        counts.distance = gl::Texture::make_2d("cloud distance while counting", GL_R32F, pixels);
        counts.counts = gl::Texture::make_2d("cloud counts", GL_RGBA32UI, pixels);
        counts.framebuffer = gl::Framebuffer("cloud counts", {&counts.radiance, &counts.distance, &counts.counts});
    }
}

/// Directions that spread the six samples of the cone: fixed numbers, the last one 0.
std::array<glm::dvec3, 6> sun_cone() {
    std::array<glm::dvec3, 6> kernel{};
    for (std::uint32_t i = 1; i <= 5; ++i) {
        const double z = 2.0 * unit_interval(pcg(2 * i - 2)) - 1.0;
        const double phi = 2.0 * std::numbers::pi * unit_interval(pcg(2 * i - 1));
        const double radius = std::sqrt(1.0 - z * z);
        kernel[i - 1] = {radius * std::cos(phi), z, radius * std::sin(phi)};
    }
    return kernel;
}

bool is_box(const scene::CloudLayer& layer) {
    return layer.bounds == scene::CloudBounds::box;
}

}  // namespace

CloudMarchPass::CloudMarchPass(FrameGraph& graph, gl::ShaderLibrary& shaders, const std::string& name)
    : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    map_ = graph.add_source<CloudPasses::Map>(name + ": weather map");
    shader_revision_ = graph.add_source<int>("shaders");
    picture = graph.add_product<CloudPicture>(name + ": clouds");
    counts = graph.add_product<CloudCounts>(name + ": cloud counts");
    march_ = graph.add_pass(
        {name + ": cloud_march", "light of a layer of clouds along every pixel's ray", {}, {picture.index}, {}});
    count_ = graph.add_pass({name + ": count clouds", "the same, counting lookups", {}, {counts.index}, {}});
}

void CloudMarchPass::remove() {
    graph_.remove_pass(march_);
    graph_.remove_pass(count_);
    for (const int source : {camera_.index, map_.index, shader_revision_.index}) {
        graph_.remove_source(source);
    }
}

void CloudMarchPass::update(const scene::Scene& scene, const scene::Clouds& clouds, const Inputs& inputs,
                            const View& view) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(map_, *clouds.map, clouds.map.revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    const scene::CloudReprojection wanted = clouds.march->reprojection;
    const bool reprojects =
        wanted == scene::CloudReprojection::always || (wanted == scene::CloudReprojection::in_window && view.in_window);
    turn_ += reprojects && history_.missing() > 0 ? 1 : 0;
    const scene::CloudLayer& layer = *clouds.layer;
    const CloudSight sight{**scene.camera,
                           scene::wind_direction_world(layer) * (layer.wind_speed_m_s * scene.time->now_s), view.pixels,
                           view.step_scale};
    const Parameters parameters{view.pixels,
                                view.step_scale,
                                *clouds.layer,
                                *clouds.optics,
                                *clouds.march,
                                cloud_origins(*clouds.layer, (*scene.camera)->eye_world, scene.time->now_s),
                                sun_lean(sun_direction_world(scene)),
                                inputs.opaque,
                                inputs.air,
                                sight,
                                reprojects,
                                reprojects ? turn_ : 0};
    const Handles handles{inputs.passes.weather, inputs.passes.columns, inputs.passes.sun, inputs.noise, inputs.light};
    std::vector<int> reads{camera_.index,         map_.index,          shader_revision_.index,
                           handles.weather.index, handles.noise.index, handles.light.index};
    reads.push_back(clouds.march->sun_path == scene::CloudSunPath::grid ? handles.sun.index : handles.columns.index);
    if (inputs.opaque.index >= 0) {
        reads.push_back(inputs.opaque.index);
    }
    if (inputs.air) {
        reads.push_back(inputs.air->transmittance.index);
        if (inputs.air->multiple_scattering.index >= 0) {
            reads.push_back(inputs.air->multiple_scattering.index);
        }
    }
    for (const PassId pass : {march_, count_}) {
        graph_.set_reads(pass, reads);
        graph_.set_parameters(pass, parameters);
        graph_.set_execute(pass, [this, parameters, handles, counting = pass.index == count_.index](
                                     const PassAccess& access) { draw(access, parameters, handles, counting); });
    }
}

gl::Defines CloudMarchPass::defines_of(const Parameters& parameters, bool counting) {
    gl::Defines defines = cloud_field_defines(parameters.layer);
    const auto add = [&](bool wanted, const char* name) {
        if (wanted) {
            defines[name] = "";
        }
    };
    add(is_box(parameters.layer), "BOX");
    add(parameters.opaque.index >= 0, "OPAQUE");
    add(parameters.air.has_value(), "AIR");
    add(parameters.march.sun_path == scene::CloudSunPath::cone, "CONE");
    add(parameters.march.empty_space_skipping, "LEAP");
    add(parameters.march.big_steps, "BIG_STEPS");
    add(parameters.march.early_termination, "STOP_EARLY");
    add(parameters.march.detail_where_it_shows, "SPARE_DETAIL");
    add(parameters.march.optical_step > 0.0, "ADAPT");
    add(counting, "COUNT");
    if (parameters.optics.lighting == scene::CloudLighting::artistic) {
        defines["ARTISTIC"] = "";
    } else if (parameters.optics.multiple_scattering == scene::MultipleScattering::octaves) {
        defines["OCTAVES"] = std::to_string(parameters.optics.octaves);
        add(parameters.optics.octave_extinction == 0.5, "HALVING");
    }
    return defines;
}

void CloudMarchPass::set_optics(gl::Program& program, const Parameters& parameters) {
    const scene::CloudOptics& optics = parameters.optics;
    program.set("optics.extinction", float(optics.extinction_per_m));
    program.set("optics.albedo", float(optics.albedo));
    program.set("optics.lobes", glm::vec3(optics.forward_g, optics.backward_g, optics.forward_share));
    program.set("optics.reduced", float(1.0 - scene::mean_asymmetry(optics)));
    program.set("optics.octave", glm::vec3(optics.octave_strength, optics.octave_extinction, optics.octave_anisotropy));
    program.set("optics.ambient", float(optics.ambient));
    // Absorption counts density over the reference length; what is looked up is an optical depth.
    const double per_depth =
        optics.absorption / (optics.reference_length_m * std::max(optics.extinction_per_m, 1e-300));
    program.set("optics.look",
                glm::vec4(optics.in_scatter, optics.out_scatter, optics.in_out_mix, std::min(per_depth, 1e30)));
    program.set("optics.silver", glm::vec2(optics.silver_intensity, optics.silver_exponent));
    program.set("optics.powder_all", optics.powder == scene::CloudPowder::everywhere ? 1.0F : 0.0F);
}

void CloudMarchPass::set_sun_path(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                                  const Handles& handles, GLuint& unit) {
    if (parameters.march.sun_path == scene::CloudSunPath::grid) {
        access.read(handles.sun).depths.bind(unit);
        program.set("depths", int(unit++));
        program.set("lean", glm::vec2(parameters.lean));
        return;
    }
    access.read(handles.columns).up.bind(unit);
    program.set("depth_up", int(unit++));
    const std::array<glm::dvec3, 6> kernel = sun_cone();
    for (int n = 0; n < 6; ++n) {
        program.set_at("cone_kernel", n, "", glm::vec3(kernel[std::size_t(n)]));
    }
    const scene::CloudLayer& layer = parameters.layer;
    const double reach = parameters.optics.cone_length * (layer.top_m - layer.bottom_m);
    program.set("cone", glm::vec3(parameters.optics.cone_spread, reach, reach * parameters.optics.cone_far));
    program.set("layer_altitudes", glm::vec2(layer.bottom_m, layer.top_m));
}

void CloudMarchPass::set_march(const PassAccess& access, gl::Program& program, const Parameters& parameters,
                               const scene::Camera& camera, GLuint& unit) {
    const scene::CloudMarch& march = parameters.march;
    const scene::CloudLayer& layer = parameters.layer;
    const scene::CameraFrame frame = scene::camera_frame(camera);
    const scene::CloudBand band = scene::cloud_band(layer, access.read(map_)->largest());
    program.set("pixels", glm::vec2(parameters.pixels));
    program.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(camera, parameters.pixels, 1.0)));
    program.set("world_from_camera", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
    program.set("eye_altitude", float(camera.eye_world.y));
    program.set("near_distance", float(camera.near_distance));
    program.set("planet_radius",
                float((parameters.air ? parameters.air->atmosphere : scene::Atmosphere{}).planet_radius_m));
    program.set("band", glm::vec2(band.low_m, band.high_m));
    program.set("reach", float(march.reach_m));
    const double coarser = parameters.step_scale;
    program.set("steps", glm::vec4(march.step_m * coarser, march.step_growth * coarser, march.optical_step * coarser,
                                   march.stop_transmittance));
    program.set("most_turns", int(march.most_turns));
    program.set("jitter", int(march.jitter));
    program.set("frame", 0U);
    if (march.jitter == scene::Jitter::blue_noise && !blue_noise_) {
        constexpr int edge = 64;
        std::vector<float> tile;
        for (const std::uint16_t rank : make_blue_noise(edge)) {
            tile.push_back((float(rank) + 0.5F) / (edge * edge));
        }
        blue_noise_ = gl::Texture::make_2d("blue noise", GL_R32F, {edge, edge});
        blue_noise_.upload({GL_RED, GL_FLOAT}, tile.data());
    }
    blue_noise_.bind(unit);
    program.set("blue_noise", int(unit++));
    if (is_box(layer)) {
        const glm::dvec2 from_eye(layer.box_center_m[0] - camera.eye_world.x,
                                  layer.box_center_m[1] - camera.eye_world.z);
        const glm::dvec2 half = 0.5 * glm::dvec2(layer.box_size_m[0], layer.box_size_m[1]);
        program.set("box", glm::vec4(from_eye - half, from_eye + half));
    }
}

CloudMarchPass::Made CloudMarchPass::made_with(Parameters parameters, const Handles& handles) const {
    const bool grid = parameters.march.sun_path == scene::CloudSunPath::grid;
    parameters.origins = {};
    parameters.sight = {};
    parameters.pixels = {};
    parameters.step_scale = 1.0;
    parameters.reprojects = false;
    parameters.turn = 0;
    return {parameters,
            {graph_.revision(map_.index), graph_.revision(handles.weather.index), graph_.revision(handles.light.index),
             graph_.revision(grid ? handles.sun.index : handles.columns.index)}};
}

void CloudMarchPass::draw(const PassAccess& access, const Parameters& parameters, const Handles& handles,
                          bool counting) {
    gl::Defines defines = defines_of(parameters, counting);
    if (counting) {
        make_targets(access.write(counts), parameters.pixels);
        access.write(counts).framebuffer.bind();
        full_screen_.draw(prepared_program(access, parameters, handles, defines));
        return;
    }
    CloudPicture& out = access.write(picture);
    const Made made = made_with(parameters, handles);
    from_last_ = parameters.reprojects && made_ == made && out.radiance && history_.is_near(parameters.sight);
    made_ = made;
    if (!from_last_) {
        make_targets(out, parameters.pixels);
        out.framebuffer.bind();
        full_screen_.draw(prepared_program(access, parameters, handles, defines));
        history_.begin(parameters.sight);
        access.note(fmt::format("{} x {} pixels", parameters.pixels.x, parameters.pixels.y));
        return;
    }
    history_.look(parameters.sight);
    gl::Defines sparse = defines;
    sparse["SPARSE"] = "";
    history_.sparse(parameters.pixels).framebuffer.bind();
    full_screen_.draw(prepared_program(access, parameters, handles, sparse));
    if (history_.resolve(shaders_, out)) {
        out.resolved.bind();
        full_screen_.draw_where_deep(prepared_program(access, parameters, handles, defines));
    }
    access.note(fmt::format("a sixteenth of {} x {} pixels", parameters.pixels.x, parameters.pixels.y));
}

gl::Program& CloudMarchPass::prepared_program(const PassAccess& access, const Parameters& parameters,
                                              const Handles& handles, const gl::Defines& defines) {
    gl::Program& program = shaders_.get("clouds/cloud_march.frag", defines);
    program.set("pixel_offset", history_.offset());
    const scene::Camera camera = access.read(camera_);
    GLuint unit = 0;
    const CloudWeatherTextures& weather = access.read(handles.weather);
    set_cloud_field(program, parameters.layer, parameters.origins, weather.map, access.read(handles.noise), unit);
    set_optics(program, parameters);
    set_march(access, program, parameters, camera, unit);
    set_sun_path(access, program, parameters, handles, unit);
    access.read(handles.light).buffer.bind_storage(sky_light_binding);
    if (parameters.march.empty_space_skipping) {
        weather.emptiness.bind(unit);
        program.set("emptiness", int(unit++));
        const scene::CloudBand band = scene::cloud_band(parameters.layer, access.read(map_)->largest());
        const double sideways = CloudCells::edge / parameters.layer.weather_tile_m;
        program.set("cells_per_metre",
                    glm::vec3(sideways, CloudCells::slices / std::max(1e-3, band.high_m - band.low_m), sideways));
        program.set("cells_origin", glm::vec2(parameters.origins.weather * double(CloudCells::edge)));
    }
    if (parameters.opaque.index >= 0) {
        const OpaquePicture& opaque = access.read(parameters.opaque);
        opaque.layers.farthest_distances().bind(unit);
        program.set("opaque_distance", int(unit++));
        program.set("metres_per_unit", float(opaque.layers.unit_world));
    }
    if (parameters.air) {
        set_air(access, program, *parameters.air, unit);
        program.set("sun_above_air", glm::vec3(parameters.air->sun_irradiance));
    }
    return program;
}

}  // namespace bruma::render
