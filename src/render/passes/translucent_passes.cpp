#include "render/passes/translucent_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/log.h"
#include "render/far_lamps.h"
#include "render/passes/subsurface_entry.h"

namespace bruma::render {
namespace {

constexpr double mm_per_m = 1e3, mm2_per_m2 = 1e6;

/// Work groups of 64 texels.
std::uint32_t groups_of(std::uint32_t texels) {
    return (texels + 63) / 64;
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
    const glm::dvec3 diagonal_mm = shown_.frame.body_from_model * ((*mesh.triangles)->high - (*mesh.triangles)->low);
    const double radius_m = 0.5 * glm::length(diagonal_mm) / mm_per_m;
    for (const scene::Light& given : lights) {
        const scene::Light lamp = parallel_from_afar(given, shown_.frame.middle_world, radius_m).value_or(given);
        light.lamps.push_back(body_lamp(lamp, shown_.frame, camera_back_world));
        shown_.powers.push_back(lamp.color * lamp.intensity * (scene::has_position(lamp) ? mm2_per_m2 : 1.0));
    }
    graph_.set_parameters(light_, light);
    graph_.set_execute(light_, [this, light](const PassAccess& access) { look_from_lamps(access, light); });

    const ExitParameters exits{shown_.frame.body_from_model, int(settings.maps), int(settings.map_size)};
    graph_.set_parameters(exits_, exits);
    graph_.set_execute(exits_, [this, exits](const PassAccess& access) { look_from_around(access, exits); });

    graph_.set_parameters(
        begin_, StartParameters{medium, settings.model, settings.sampling, int(settings.samples), shown_.powers});
    const RadiosityMaps* const standing = graph_.product(shown_.radiosity);
    turn_ += standing != nullptr && !settled() && standing->passes < goal.samples ? 1 : 0;
    graph_.set_parameters(gather_, turn_);
    graph_.set_execute(gather_,
                       [this, shown = shown_, goal](const PassAccess& access) { gather(access, shown, goal); });
}

SeenBody TranslucentPasses::body(const PassAccess& access, const glm::dmat3& body_from_model) const {
    return {access.read(mesh_.buffers), *access.read(mesh_.triangles), body_from_model};
}

void TranslucentPasses::look_from_lamps(const PassAccess& access, const LightParameters& parameters) {
    std::vector<SeenShade> shades;
    for (const Shade& shade : parameters.shades) {
        shades.push_back({access.read(shade.buffers), shade.body_from_model});
    }
    access.note(draw_light_maps(access.write(shown_.light), shaders_, body(access, parameters.body_from_model), shades,
                                parameters.lamps, parameters.eta, parameters.size));
}

void TranslucentPasses::look_from_around(const PassAccess& access, const ExitParameters& parameters) {
    access.note(draw_exit_maps(access.write(shown_.exits), shaders_, body(access, parameters.body_from_model),
                               parameters.maps, parameters.size));
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
    const int samples = int(shown.settings.samples);
    if (exits.maps() == 0) {
        // Pixels draw their points themselves. One point's scatter is about as large as their mean.
        const double enough = std::ceil(1.0 / (std::max(1e-12, std::pow(shown.settings.noise, 2.0)) * samples));
        out.passes = std::max(out.passes, int(std::min(enough, double(goal.samples))));
        out.noise = 1.0 / std::sqrt(double(out.passes) * samples);
        access.note("no maps: each pixel by itself");
        return;
    }
    const double shortest_mm = 1.0 / std::max({shown.constants.sigma_t_reduced.x, shown.constants.sigma_t_reduced.y,
                                               shown.constants.sigma_t_reduced.z});
    // Just beyond the border of the light half of that makes a sphere 7 % too bright, a quarter of it 1.5 %.
    if (!said_coarse_ && light.coarsest_texel_mm > 0.5 * shortest_mm) {
        said_coarse_ = true;
        log_note(
            "nodes.{}: texels of {:.3g} mm where light enters, but light is scattered every {:.3g} mm; a larger "
            "subsurface.light_map_size is truer beside shadow borders",
            node_name_, light.coarsest_texel_mm, shortest_mm);
    }
    gl::Program& program = shaders_.get("radiosity.comp", entry_defines(light, shown.settings));
    gl::Buffer lamps;
    set_entry(program, light, shown.constants, shown.powers, 2, lamps);
    exits.cameras.bind_storage(1);
    exits.depth.bind(0);
    program.set("exit_depth", 0);
    exits.normals.bind(1);
    program.set("exit_normals", 1);
    glBindImageTexture(0, out.mean.name(), 0, GL_TRUE, 0, GL_READ_WRITE, GL_RGBA32F);
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
