#include "render/light/light_passes.h"

#include <fmt/core.h>

#include "base/error.h"
#include "render/light/light_sweep.h"
#include "render/light/shadow_rays.h"

namespace bruma::render {
namespace {

int coarsening_of(scene::LightResolution resolution) {
    return 1 << int(resolution);
}

struct SweepParameters {
    SweepPlan plan;
    LightTransport transport = LightTransport::direct;
    SweepSettings settings;
    ShadowRays rays;  ///< only where transport is by them
    bool operator==(const SweepParameters&) const = default;
};

/// Copies one texture of each part into slabs along z. `node` is for the message.
void stack_textures(const PassAccess& access, const std::vector<Handle<LightTextures>>& parts,
                    gl::Texture LightTextures::*which, const std::string& node, gl::Texture& stack) {
    const gl::Texture& first = access.read(parts.front()).*which;
    if (!first) {
        stack = {};
        return;
    }
    const glm::ivec3 slab = first.size();
    GLint deepest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &deepest);
    if (slab.z * int(parts.size()) > deepest) {
        throw MachineError(
            fmt::format("nodes.{}: the light volumes of {} lights, {} cells deep each, exceed the driver's {} in one "
                        "texture; switch lights off or choose a coarser light_volume.resolution",
                        node, parts.size(), slab.z, deepest));
    }
    stack = gl::Texture::make_3d("light of all", first.format(), {slab.x, slab.y, slab.z * int(parts.size())});
    for (std::size_t n = 0; n < parts.size(); ++n) {
        const gl::Texture& part = access.read(parts[n]).*which;
        glCopyImageSubData(part.name(), GL_TEXTURE_3D, 0, 0, 0, 0, stack.name(), GL_TEXTURE_3D, 0, 0, 0,
                           slab.z * int(n), slab.x, slab.y, slab.z);
    }
}

const char* words_of(LightTransport transport) {
    switch (transport) {
        case LightTransport::diffuse:
            return "diffuse light of ";
        case LightTransport::shadow_rays:
            return "shadow rays of ";
        default:
            return "light of ";
    }
}

}  // namespace

LightPasses::LightPasses(FrameGraph& graph, gl::ShaderLibrary& shaders, std::string node_name,
                         const VolumePasses& volume)
    : graph_(graph), shaders_(shaders), node_name_(std::move(node_name)), volume_(volume) {
    shader_revision_ = graph.add_source<int>(node_name_ + ": light shaders");
}

LightPasses::~LightPasses() {
    for (const auto& [key, sweep] : sweeps_) {
        graph_.remove_pass(sweep.pass);
    }
    for (const PassId pass : {fine_.pass, coarse_.pass, direct_stack_.pass, beside_stack_.pass}) {
        if (pass.index >= 0) {
            graph_.remove_pass(pass);
        }
    }
    graph_.remove_source(shader_revision_.index);
}

void LightPasses::update_medium(Medium& medium, const char* name, const scene::Volume& volume, const LightGrid& grid,
                                int samples, bool with_albedo) {
    if (medium.pass.index < 0) {
        medium.medium = graph_.add_product<LightMedium>(fmt::format("{}: {}", node_name_, name));
        medium.pass = graph_.add_pass(
            {fmt::format("{}: {}", node_name_, name),
             "extinction of each cell of the light grid",
             {volume_.voxels.index, volume_.emptiness.index, volume_.transfer_function.index, shader_revision_.index},
             {medium.medium.index},
             {}});
    }
    const glm::dvec3 low = volume.clip->low;
    const glm::dvec3 per_texture = glm::dvec3(grid.cells) / (glm::dvec3(volume.clip->high) - low);
    glm::dmat4 cells_from_texture(1.0);
    for (int k = 0; k < 3; ++k) {
        cells_from_texture[k][k] = per_texture[k];
        cells_from_texture[3][k] = -low[k] * per_texture[k];
    }
    const LightMediumParameters parameters{
        grid,
        samples,
        with_albedo,
        with_albedo ? volume.optics->albedo : glm::dvec3(0.0),
        scene::effective_window(volume),
        volume.optics->density_scale / volume.transfer_function->reference_length * grid.length,
        cells_from_texture};
    graph_.set_parameters(medium.pass, parameters);
    graph_.set_execute(medium.pass, [this, parameters, product = medium.medium](const PassAccess& access) {
        make_light_medium(shaders_, access.read(volume_.voxels), access.read(volume_.emptiness),
                          access.read(volume_.transfer_function), parameters, access.write(product));
        access.note(fmt::format("{} x {} x {} cells", parameters.grid.cells.x, parameters.grid.cells.y,
                                parameters.grid.cells.z));
    });
}

Handle<LightTextures> LightPasses::update_sweep(const std::string& light_name, LightTransport transport,
                                                const SweepPlan& plan, const scene::Volume& volume,
                                                const glm::dmat4& world_from_texture, double step_world) {
    const scene::LightVolumeSettings& settings = *volume.light_volume;
    const bool rays = transport == LightTransport::shadow_rays;
    const Medium& medium = transport == LightTransport::diffuse ? coarse_ : fine_;
    auto found = sweeps_.find({light_name, transport});
    if (found == sweeps_.end()) {
        const std::string name = fmt::format("{}: {}{}", node_name_, words_of(transport), light_name);
        Sweep sweep;
        sweep.light = graph_.add_product<LightTextures>(name);
        std::vector<int> reads{shader_revision_.index};
        if (rays) {
            reads.insert(reads.end(), {volume_.voxels.index, volume_.emptiness.index, volume_.transfer_function.index});
        } else {
            reads.insert(reads.end(), {medium.medium.index, volume_.emptiness.index});
        }
        sweep.pass = graph_.add_pass(
            {name,
             rays ? "a shadow ray for each cell of the light grid" : "light swept through the slices of the light grid",
             reads,
             {sweep.light.index},
             {}});
        found = sweeps_.emplace(std::pair(light_name, transport), sweep).first;
    }
    SweepParameters parameters;
    parameters.plan = plan;
    parameters.transport = transport;
    parameters.settings.precision = settings.precision;
    if (rays) {
        parameters.rays = {*volume.clip,
                           world_from_texture,
                           step_world,
                           volume.optics->density_scale / volume.transfer_function->reference_length * step_world,
                           scene::effective_window(volume),
                           settings.precision};
    } else {
        parameters.settings.slices_per_dispatch = int(settings.slices_per_dispatch);
    }
    if (transport == LightTransport::diffuse) {
        parameters.settings.state = SweptState::diffuse;
        parameters.settings.spread = settings.spread;
    } else if (transport == LightTransport::chromaticity) {
        parameters.settings.state = SweptState::chromaticity;
        parameters.settings.cone_angle_deg = settings.cone_angle_deg;
        parameters.settings.g = volume.optics->g;
        parameters.settings.soft_shadows = settings.soft_shadows;
    }
    const Sweep& sweep = found->second;
    graph_.set_parameters(sweep.pass, parameters);
    graph_.set_execute(sweep.pass, [this, parameters, light = sweep.light,
                                    handle = medium.medium](const PassAccess& access) {
        LightTextures& out = access.write(light);
        out.grid = parameters.plan.grid;
        const glm::ivec3 cells = out.grid.cells;
        if (parameters.transport == LightTransport::shadow_rays) {
            out.direct = trace_shadow_rays(shaders_, access.read(volume_.voxels), access.read(volume_.emptiness),
                                           access.read(volume_.transfer_function), parameters.plan, parameters.rays);
            access.note(fmt::format("{} x {} x {} rays", cells.x, cells.y, cells.z));
            return;
        }
        const LightMedium& grid_medium = access.read(handle);
        SweptLight swept =
            sweep_light(shaders_, grid_medium.extinction, grid_medium.albedo, parameters.plan, parameters.settings);
        out.direct = std::move(swept.direct);
        out.beside = std::move(swept.beside);
        access.note(fmt::format("{} x {} x {} cells, {} {}, {} dispatches", cells.x, cells.y, cells.z,
                                parameters.plan.axes.size(), parameters.plan.from_point ? "half axes" : "axes",
                                swept.dispatches));
    });
    return sweep.light;
}

Handle<LightTextures> LightPasses::update_stack(Stack& stack, const char* name,
                                                const std::vector<Handle<LightTextures>>& parts) {
    if (parts.size() < 2) {
        return parts.empty() ? Handle<LightTextures>{} : parts.front();
    }
    if (stack.pass.index < 0) {
        stack.light = graph_.add_product<LightTextures>(fmt::format("{}: {}", node_name_, name));
        stack.pass = graph_.add_pass({fmt::format("{}: {}", node_name_, name),
                                      "the grids of all lights in one texture",
                                      {},
                                      {stack.light.index},
                                      {}});
    }
    std::vector<int> reads;
    reads.reserve(parts.size());
    for (const Handle<LightTextures> part : parts) {
        reads.push_back(part.index);
    }
    graph_.set_reads(stack.pass, reads);
    graph_.set_execute(stack.pass, [parts, node = node_name_, product = stack.light](const PassAccess& access) {
        LightTextures& out = access.write(product);
        out.grid = access.read(parts.front()).grid;
        stack_textures(access, parts, &LightTextures::direct, node, out.direct);
        stack_textures(access, parts, &LightTextures::beside, node, out.beside);
    });
    return stack.light;
}

void LightPasses::update(const scene::Volume& volume, const glm::dmat4& world_from_texture,
                         const std::vector<std::pair<std::string, scene::Light>>& lights, glm::dvec3 camera_back_world,
                         double step_world) {
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    const scene::LightVolumeSettings& settings = *volume.light_volume;
    const bool rays = volume.optics->lighting == scene::VolumeLighting::shadow_rays;
    const bool paper = !rays && settings.mode == scene::SweepMode::paper;
    const bool diffuse = !rays && !paper && settings.diffuse;
    const int coarsening = coarsening_of(settings.resolution);
    grid_ = light_grid(volume, world_from_texture, coarsening);
    if (!rays) {
        update_medium(fine_, "light medium", volume, grid_, coarsening, paper);
    }
    // Diffuse light is smooth: cells twice as large hold it for an eighth of the work.
    const LightGrid coarse_grid = light_grid(volume, world_from_texture, 2 * coarsening);
    if (diffuse) {
        update_medium(coarse_, "diffuse light medium", volume, coarse_grid, 2 * coarsening, true);
    }
    const LightTransport transport = rays    ? LightTransport::shadow_rays
                                     : paper ? LightTransport::chromaticity
                                             : LightTransport::direct;
    std::map<std::pair<std::string, LightTransport>, Sweep> kept;
    std::vector<Handle<LightTextures>> direct, beside;
    for (const auto& [name, light] : lights) {
        direct.push_back(update_sweep(name, transport, plan_sweep(grid_, light, camera_back_world, paper ? 2 : 3),
                                      volume, world_from_texture, step_world));
        kept.insert(*sweeps_.find({name, transport}));
        if (diffuse) {
            beside.push_back(update_sweep(name, LightTransport::diffuse,
                                          plan_sweep(coarse_grid, light, camera_back_world), volume, world_from_texture,
                                          step_world));
            kept.insert(*sweeps_.find({name, LightTransport::diffuse}));
        }
    }
    stacked_ = update_stack(direct_stack_, "light of all", direct);
    stacked_beside_ = paper ? stacked_ : update_stack(beside_stack_, "diffuse light of all", beside);
    for (const auto& [key, sweep] : sweeps_) {
        if (!kept.contains(key)) {
            graph_.remove_pass(sweep.pass);
        }
    }
    sweeps_ = std::move(kept);
}

}  // namespace bruma::render
