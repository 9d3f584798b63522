#include "render/passes/translucent_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/log.h"
#include "render/far_lamps.h"

namespace bruma::render {
namespace {

/// Work groups of 64 texels.
std::uint32_t groups_of(std::uint32_t texels) {
    return (texels + 63) / 64;
}

constexpr double mm_per_m = 1e3, mm2_per_m2 = 1e6;

/// Layouts of include/subsurface_entry.glsl and include/exit_maps.glsl.
struct FaceData {
    glm::vec4 right, up, toward, first;
};
struct LampData {
    glm::vec4 power, eye;
    FaceData faces[6];
};
struct ExitCameraData {
    glm::vec4 right, up, back, size;
};

/// The views in which a lamp sees the whole body: one where it stands well
/// outside, six around it where not.
std::vector<MapCamera> cameras_of(const BodyLamp& lamp, const std::vector<glm::dvec3>& points, double radius,
                                  int size) {
    if (!lamp.has_position) {
        return {parallel_camera(points, lamp.toward, size)};
    }
    // Nearer, the outer texels of one view would be too large beside those in the middle.
    if (glm::length(lamp.position) > 1.25 * radius) {
        return {perspective_camera(points, lamp.position, size)};
    }
    std::vector<MapCamera> cube;
    for (int face = 0; face < 6; ++face) {
        cube.push_back(cube_camera(lamp.position, face, radius, size));
    }
    return cube;
}

int layers_of(const std::vector<BodyLamp>& lamps, double radius) {
    int layers = 0;
    for (const BodyLamp& lamp : lamps) {
        layers += lamp.has_position && glm::length(lamp.position) <= 1.25 * radius ? 6 : 1;
    }
    return layers;
}

/// Size of a texel where the body stands, mm.
double texel_mm(const MapCamera& camera) {
    const double distance = camera.perspective ? std::max(glm::length(camera.eye), camera.near_depth) : 1.0;
    return distance * std::max(camera.texel.x, camera.texel.y);
}

void start_drawing() {
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);  // of two surfaces in one place both are lit
    glDepthMask(GL_TRUE);
}

double ms_since(std::chrono::steady_clock::time_point then) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - then).count();
}

}  // namespace

TranslucentPasses::TranslucentPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, std::string node_name,
                                     const MeshPasses& mesh)
    : graph_(graph), shaders_(shaders), node_name_(std::move(node_name)), mesh_(mesh) {
    const auto named = [&](const char* what) { return fmt::format("{}: {}", node_name_, what); };
    shader_revision_ = graph.add_source<int>(named("translucency shaders"));
    shown_.light = graph.add_product<LightMaps>(named("light maps"));
    shown_.exits = graph.add_product<ExitMaps>(named("exit maps"));
    start_ = graph.add_product<Start>(named("start of radiosity"));
    shown_.radiosity = graph.add_product<RadiosityMaps>(named("radiosity"));
    const std::vector<int> reads{mesh.triangles.index, mesh.buffers.index, shader_revision_.index};
    light_ = graph.add_pass(
        {named("light maps"), "where light enters: what each lamp sees of the body", reads, {shown_.light.index}, {}});
    exits_ = graph.add_pass(
        {named("exit maps"), "where light leaves: what cameras around the body see", reads, {shown_.exits.index}, {}});
    begin_ = graph.add_pass({named("begin radiosity"),
                             "lets the mean over passes begin anew",
                             {shown_.light.index, shown_.exits.index, shader_revision_.index},
                             {start_.index},
                             [this](const PassAccess& access) { access.write(start_).revision = next_revision(); }});
    gather_ = graph.add_pass({named("radiosity"),
                              "light that leaves at each texel of the maps, from points where it enters",
                              {shown_.light.index, shown_.exits.index, start_.index, shader_revision_.index},
                              {shown_.radiosity.index},
                              {}});
}

TranslucentPasses::~TranslucentPasses() {
    for (const PassId pass : {light_, exits_, begin_, gather_}) {
        graph_.remove_pass(pass);
    }
    graph_.remove_source(shader_revision_.index);
}

void TranslucentPasses::update(const scene::Mesh& mesh, const glm::dmat4& world_from_model,
                               const std::vector<Occluder>& occluders, const std::vector<scene::Light>& lights,
                               glm::dvec3 camera_back_world, const PathGoal& goal) {
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    const scene::SubsurfaceMedium medium = scene::medium_of(*mesh.surface);
    const scene::SubsurfaceSettings& settings = *mesh.subsurface;
    shown_.settings = settings;
    shown_.constants = subsurface_constants(medium, settings.model);
    shown_.frame = body_frame(world_from_model, **mesh.triangles);
    shown_.powers.clear();
    LightParameters light{shown_.frame.body_from_model, {}, {}, medium.refraction_index, int(settings.light_map_size)};
    std::vector<int> reads{mesh_.triangles.index, mesh_.buffers.index, shader_revision_.index};
    const glm::dmat3 body_from_world = mm_per_m * glm::transpose(shown_.frame.world_from_body);
    for (const Occluder& occluder : occluders) {
        glm::dmat4 body_from_model(body_from_world * glm::dmat3(occluder.world_from_model));
        body_from_model[3] =
            glm::dvec4(body_from_world * (glm::dvec3(occluder.world_from_model[3]) - shown_.frame.middle_world), 1.0);
        light.shades.push_back({occluder.buffers, body_from_model});
        reads.insert(reads.end(), {occluder.triangles.index, occluder.buffers.index});
    }
    graph_.set_reads(light_, reads);
    const scene::TriangleMesh& triangles = **mesh.triangles;
    const double radius_m =
        0.5 * glm::length(shown_.frame.body_from_model * (triangles.high - triangles.low)) / mm_per_m;
    for (const scene::Light& given : lights) {
        const scene::Light lamp = parallel_from_afar(given, shown_.frame.middle_world, radius_m).value_or(given);
        light.lamps.push_back(body_lamp(lamp, shown_.frame, camera_back_world));
        shown_.powers.push_back(lamp.color * lamp.intensity * (scene::has_position(lamp) ? mm2_per_m2 : 1.0));
    }
    graph_.set_parameters(light_, light);
    graph_.set_execute(light_, [this, light](const PassAccess& access) { draw_light_maps(access, light); });

    const ExitParameters exits{shown_.frame.body_from_model, int(settings.maps), int(settings.map_size)};
    graph_.set_parameters(exits_, exits);
    graph_.set_execute(exits_, [this, exits](const PassAccess& access) { draw_exit_maps(access, exits); });

    graph_.set_parameters(
        begin_, StartParameters{medium, settings.model, settings.sampling, int(settings.samples), shown_.powers});
    const RadiosityMaps* const standing = graph_.product(shown_.radiosity);
    turn_ += standing != nullptr && !settled() && standing->passes < goal.samples ? 1 : 0;
    graph_.set_parameters(gather_, turn_);
    graph_.set_execute(gather_,
                       [this, shown = shown_, goal](const PassAccess& access) { gather(access, shown, goal); });
}

void TranslucentPasses::draw_body(const MeshBuffers& buffers, gl::Program& program, const glm::dmat3& body_from_model,
                                  const MapCamera& camera) const {
    const glm::dmat3 normals = glm::transpose(glm::inverse(body_from_model));
    double largest = 1e-300;
    for (int k = 0; k < 9; ++k) {
        largest = std::max(largest, std::abs(normals[k / 3][k % 3]));
    }
    program.set("body_from_model", glm::mat3(body_from_model));
    program.set("body_from_normal", glm::mat3(normals / largest));
    program.set("clip_from_body", glm::mat4(camera.clip_from_body()));
    program.use();
    draw_all(buffers);
}

void TranslucentPasses::draw_shades(const PassAccess& access, const std::vector<Shade>& shades,
                                    const MapCamera& camera) const {
    if (shades.empty()) {
        return;
    }
    // Depth alone, so that what lies behind stays empty; also of what stands
    // nearer to the lamp than the body's view.
    gl::Program& program = shaders_.get("shadow_map.frag");
    program.use();
    glEnable(GL_DEPTH_CLAMP);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const Shade& shade : shades) {
        const MeshBuffers& buffers = access.read(shade.buffers);
        glm::dmat4 from_middle(1.0);
        from_middle[3] = glm::dvec4(buffers.middle_model, 1.0);
        program.set("clip_from_model", glm::mat4(camera.clip_from_body() * shade.body_from_model * from_middle));
        draw_all(buffers);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_DEPTH_CLAMP);
}

void TranslucentPasses::draw_light_maps(const PassAccess& access, const LightParameters& parameters) {
    const std::vector<glm::dvec3> points = body_points(*access.read(mesh_.triangles), parameters.body_from_model);
    LightMaps& out = access.write(shown_.light);
    out.bounding_radius = bounding_radius(points);
    const glm::ivec3 size(parameters.size, parameters.size,
                          std::max(1, layers_of(parameters.lamps, out.bounding_radius)));
    if (!out.points || out.points.size() != size) {
        out.points = gl::Texture::make_2d_array("light points", GL_RGBA32F, size);
        out.normals = gl::Texture::make_2d_array("light normals", GL_RG16, size);
    }
    const gl::Texture depth = gl::Texture::make_2d("light depth", GL_DEPTH_COMPONENT32F, glm::ivec2(size));
    start_drawing();
    gl::Program& program = shaders_.get("light_map.frag");
    program.set("eta", float(parameters.eta));
    out.lamps.clear();
    out.coarsest_texel_mm = 0.0;
    int layer = 0;
    for (const BodyLamp& lamp : parameters.lamps) {
        LightMaps::Drawn drawn{lamp, layer, cameras_of(lamp, points, out.bounding_radius, parameters.size)};
        program.set("has_position", lamp.has_position ? 1 : 0);
        program.set("lamp", glm::vec3(lamp.has_position ? lamp.position : lamp.toward));
        program.set("axis", glm::vec3(lamp.axis));
        program.set("cone", glm::vec2(lamp.cone));
        for (const MapCamera& camera : drawn.cameras) {
            const gl::Framebuffer target("light map", {{&out.points, layer}, {&out.normals, layer}}, {&depth});
            const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
            const float farthest = 1.0F;
            glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, nothing);
            glClearNamedFramebufferfv(target.name(), GL_COLOR, 1, nothing);
            glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
            target.bind();
            draw_shades(access, parameters.shades, camera);
            draw_body(access.read(mesh_.buffers), program, parameters.body_from_model, camera);
            out.coarsest_texel_mm = std::max(out.coarsest_texel_mm, texel_mm(camera));
            ++layer;
        }
        out.lamps.push_back(std::move(drawn));
    }
    glDisable(GL_DEPTH_TEST);
    access.note(fmt::format("{} lamp{}, {} view{} of {} x {} texels, {:.3g} mm each", parameters.lamps.size(),
                            parameters.lamps.size() == 1 ? "" : "s", layer, layer == 1 ? "" : "s", size.x, size.y,
                            out.coarsest_texel_mm));
}

void TranslucentPasses::draw_exit_maps(const PassAccess& access, const ExitParameters& parameters) {
    const std::vector<glm::dvec3> points = body_points(*access.read(mesh_.triangles), parameters.body_from_model);
    ExitMaps& out = access.write(shown_.exits);
    const glm::ivec3 size(parameters.size, parameters.size, parameters.maps);
    if (!out.depth || out.depth.size() != size) {
        out.depth = gl::Texture::make_2d_array("exit depth", GL_DEPTH_COMPONENT32F, size);
        out.depth.set_nearest();
        out.normals = gl::Texture::make_2d_array("exit normals", GL_RG16, size);
    }
    start_drawing();
    gl::Program& program = shaders_.get("exit_map.frag");
    std::vector<ExitCameraData> cameras;
    std::vector<std::uint32_t> texels;
    std::vector<float> depths(std::size_t(size.x) * std::size_t(size.y));
    out.first = {0};
    out.texel_mm = 0.0;
    for (int map = 0; map < parameters.maps; ++map) {
        const MapCamera camera = parallel_camera(points, halton_direction(unsigned(map) + 1), parameters.size);
        const gl::Framebuffer target("exit map", {{&out.normals, map}}, {&out.depth, map});
        const float farthest = 1.0F;
        glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
        target.bind();
        program.set("toward_camera", glm::vec3(camera.back));
        draw_body(access.read(mesh_.buffers), program, parameters.body_from_model, camera);
        cameras.push_back({glm::vec4(camera.right, camera.low.x), glm::vec4(camera.up, camera.low.y),
                           glm::vec4(camera.back, camera.near_depth), glm::vec4(camera.texel, camera.depth, 0.0)});
        out.texel_mm = std::max(out.texel_mm, std::max(camera.texel.x, camera.texel.y));
        // Read back once per shape, so that no shader starts for texels beside the body.
        glGetTextureSubImage(out.depth.name(), 0, 0, 0, map, size.x, size.y, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                             GLsizei(depths.size() * sizeof(float)), depths.data());
        for (std::uint32_t n = 0; n < depths.size(); ++n) {
            if (depths[n] < 1.0F) {
                texels.push_back(n);
            }
        }
        out.first.push_back(std::uint32_t(texels.size()));
    }
    glDisable(GL_DEPTH_TEST);
    texels.push_back(0);  // a buffer is never empty
    out.cameras = gl::Buffer("exit cameras", std::span<const ExitCameraData>(cameras));
    out.texels = gl::Buffer("exit texels", std::span<const std::uint32_t>(texels));
    access.note(
        fmt::format("{} maps of {} x {} texels, {:.3g} mm at most", parameters.maps, size.x, size.y, out.texel_mm));
}

gl::Defines TranslucentPasses::defines_of(const LightMaps& light, const Shown& shown) {
    gl::Defines defines;
    if (shown.settings.model == scene::SubsurfaceModel::standard_dipole) {
        defines["STANDARD_DIPOLE"] = "";
    }
    if (shown.settings.sampling == scene::SubsurfaceSampling::exponential_disk) {
        defines["EXPONENTIAL_DISK"] = "";
    }
    if (std::any_of(light.lamps.begin(), light.lamps.end(),
                    [](const LightMaps::Drawn& lamp) { return lamp.cameras.size() > 1; })) {
        defines["CUBE_LAMPS"] = "";
    }
    return defines;
}

void TranslucentPasses::set_entry_points(gl::Program& program, std::uint64_t first, int count) {
    program.set("entry_samples", count);
    for (int n = 0; n < count; ++n) {
        const std::uint64_t index = first + std::uint64_t(n) + 1;  // point 0 is a corner
        program.set_at("entry_points", n, "", glm::vec2(radical_inverse(index, 2), radical_inverse(index, 3)));
    }
}

void TranslucentPasses::set_entry(gl::Program& program, const LightMaps& light, const Shown& shown, GLuint unit,
                                  gl::Buffer& lamps) {
    std::vector<LampData> data(std::max<std::size_t>(1, light.lamps.size()));
    for (std::size_t n = 0; n < light.lamps.size(); ++n) {
        const LightMaps::Drawn& lamp = light.lamps[n];
        const bool cube = lamp.cameras.size() > 1;
        const double distance = glm::length(lamp.lamp.position);
        const double radius = light.bounding_radius;
        data[n].power = glm::vec4(shown.powers[n], !lamp.lamp.has_position ? 0.0 : cube ? 2.0 : 1.0);
        data[n].eye = glm::vec4(lamp.lamp.position, !lamp.lamp.has_position || cube
                                                        ? radius
                                                        : radius / std::sqrt(distance * distance - radius * radius));
        for (std::size_t f = 0; f < lamp.cameras.size(); ++f) {
            const MapCamera& camera = lamp.cameras[f];
            data[n].faces[f] = {glm::vec4(camera.right, 1.0 / camera.texel.x),
                                glm::vec4(camera.up, 1.0 / camera.texel.y),
                                glm::vec4(camera.back, double(lamp.first_layer) + double(f)),
                                glm::vec4(-camera.low / camera.texel, 0.0, 0.0)};
        }
    }
    lamps = gl::Buffer("lamps", std::span<const LampData>(data));
    lamps.bind_storage(2);
    const EntryRates rates = entry_rates(shown.constants, light.bounding_radius);
    set_medium(program, shown.constants);
    program.set("lamp_count", int(light.lamps.size()));
    program.set("tail_rates", glm::vec3(rates.tails));
    program.set("core_rates", glm::vec3(rates.cores));
    program.set("back_lit_depth", float(rates.back_lit_depth));
    light.points.bind(unit);
    program.set("light_points", int(unit));
    light.normals.bind(unit + 1);
    program.set("light_normals", int(unit + 1));
}

double TranslucentPasses::measure_noise(const RadiosityMaps& radiosity, const ExitMaps& exits) const {
    const std::uint32_t groups = groups_of(exits.first.back());
    std::vector<glm::vec4> sums(std::max(1U, groups));
    const gl::Buffer buffer("noise of radiosity", std::span<const glm::vec4>(sums));
    gl::Program& program = shaders_.get("radiosity_noise.comp");
    glBindImageTexture(0, radiosity.mean.name(), 0, GL_TRUE, 0, GL_READ_ONLY, GL_RGBA32F);
    exits.depth.bind(0);
    program.set("exit_depth", 0);
    program.set("passes", float(radiosity.passes));
    program.set("texel_count", exits.first.back());
    program.set("edge", unsigned(radiosity.mean.size().x));
    program.set("rows", unsigned(radiosity.mean.size().y));
    buffer.bind_storage(4);
    exits.texels.bind_storage(5);
    for (int map = 1; map <= 32; ++map) {
        program.set_at("first", map, "", exits.first[std::size_t(std::min(map, exits.maps()))]);
    }
    // The first turn tells how bright the body is on the whole, the second what is noise.
    double texels = 0.0, mean = 0.0, squares = 0.0;
    for (int turn = 0; turn < 2; ++turn) {
        program.set("least", float(0.05 * mean));
        program.use();
        glDispatchCompute(groups, 1, 1);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        buffer.read(std::span<glm::vec4>(sums));
        texels = mean = squares = 0.0;
        for (const glm::vec4& sum : sums) {
            squares += double(sum.x);
            mean += double(sum.y);
            texels += double(sum.z);
        }
        mean /= std::max(1.0, texels);
    }
    return std::sqrt(squares / std::max(1.0, texels));
}

void TranslucentPasses::gather(const PassAccess& access, const Shown& shown, const PathGoal& goal) {
    const LightMaps& light = access.read(shown.light);
    const ExitMaps& exits = access.read(shown.exits);
    RadiosityMaps& out = access.write(shown.radiosity);
    const Revision start = access.read(start_).revision;
    if (out.start != start) {
        if (!out.mean || out.mean.size() != exits.depth.size()) {
            out.mean = gl::Texture::make_2d_array("radiosity", GL_RGBA32F, exits.depth.size());
        }
        out.passes = 0;
        out.next_map = 0;
        out.evaluations = 0;
        out.noise = 1e30;
        out.start = start;
    }
    const double shortest_mm = 1.0 / std::max({shown.constants.sigma_t_reduced.x, shown.constants.sigma_t_reduced.y,
                                               shown.constants.sigma_t_reduced.z});
    if (!said_coarse_ && light.coarsest_texel_mm > shortest_mm) {
        said_coarse_ = true;
        log_note(
            "nodes.{}: texels of {:.3g} mm where light enters, but light is scattered every {:.3g} mm; a larger "
            "subsurface.light_map_size shows sharper shadow borders",
            node_name_, light.coarsest_texel_mm, shortest_mm);
    }
    gl::Program& program = shaders_.get("radiosity.comp", defines_of(light, shown));
    gl::Buffer lamps;
    set_entry(program, light, shown, 2, lamps);
    exits.cameras.bind_storage(1);
    exits.depth.bind(0);
    program.set("exit_depth", 0);
    exits.normals.bind(1);
    program.set("exit_normals", 1);
    glBindImageTexture(0, out.mean.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
    const int samples = int(shown.settings.samples);
    program.set("edge", unsigned(exits.depth.size().x));
    exits.texels.bind_storage(5);
    const auto began = std::chrono::steady_clock::now();
    while (out.passes < goal.samples && out.noise > shown.settings.noise) {
        set_entry_points(program, std::uint64_t(out.passes) * std::uint64_t(samples), samples);
        program.set("passes_before", out.passes);
        program.use();
        bool out_of_time = false;
        while (out.next_map < exits.maps() && !out_of_time) {
            const std::uint32_t first = exits.first[std::size_t(out.next_map)];
            const std::uint32_t past = exits.first[std::size_t(out.next_map) + 1];
            program.set("map_number", out.next_map);
            program.set("first_texel", first);
            program.set("past_texel", past);
            glDispatchCompute(groups_of(past - first), 1, 1);
            out.evaluations += std::uint64_t(past - first) * std::uint64_t(samples) * light.lamps.size();
            ++out.next_map;
            if (goal.budget_ms > 0.0) {
                glFinish();
                // The first picture of all is worth any wait.
                out_of_time = out.passes > 0 && ms_since(began) >= goal.budget_ms;
            } else {
                glFlush();  // each map a job of its own, that no driver's watchdog takes for a hang
            }
        }
        if (out.next_map < exits.maps()) {
            break;
        }
        out.next_map = 0;
        ++out.passes;
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        // Looked at when there are a quarter more.
        if (out.passes >= 2 && (out.passes < 4 || out.passes % std::max(1, out.passes / 4) == 0)) {
            out.noise = measure_noise(out, exits);
            glBindImageTexture(0, out.mean.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
        }
        if (goal.budget_ms > 0.0 && ms_since(began) >= goal.budget_ms) {
            break;
        }
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    const std::string noise = out.noise < 1e29 ? fmt::format("{:.2g} %", 100.0 * out.noise) : "unknown";
    access.note(fmt::format("{} passes of {} points from {} lamp{}, noise {}", out.passes, samples, light.lamps.size(),
                            light.lamps.size() == 1 ? "" : "s", noise));
}

}  // namespace bruma::render
