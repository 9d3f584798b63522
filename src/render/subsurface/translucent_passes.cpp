#include "render/subsurface/translucent_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/log.h"
#include "render/light/far_lamps.h"

namespace bruma::render {
namespace {

constexpr double mm2_per_m2 = mm_per_m * mm_per_m;

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
                               glm::dvec3 camera_back_world, const PathGoal& goal, Handle<MapReads> map_reads) {
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
    std::vector<int> gathered{shown_.light.index, shown_.exits.index, start_.index, shader_revision_.index};
    const Handle<MapReads> read = needs_reads(settings) ? map_reads : Handle<MapReads>{};
    if (read.index >= 0) {
        gathered.push_back(read.index);
    }
    graph_.set_reads(gather_, gathered);
    graph_.set_execute(
        gather_, [this, shown = shown_, read, goal](const PassAccess& access) { gather(access, shown, read, goal); });
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

void TranslucentPasses::gather(const PassAccess& access, const Shown& shown, Handle<MapReads> reads,
                               const PathGoal& goal) {
    const LightMaps& light = access.read(shown.light);
    const ExitMaps& exits = access.read(shown.exits);
    RadiosityMaps& out = access.write(shown.radiosity);
    const Revision start = access.read(start_).revision;
    if (out.start != start) {
        begin_radiosity(out, exits, start);
    }
    if (exits.maps == 0) {
        // Pixels draw their points themselves. One point's scatter is about as large as their mean.
        const int samples = int(shown.settings.samples);
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
    const gl::Buffer* const read = reads.index >= 0 ? &access.read(reads).of.at(node_name_) : nullptr;
    access.note(
        gather_radiosity(out, shaders_, {light, exits, read, shown.constants, shown.settings, shown.powers}, goal));
}

}  // namespace bruma::render
