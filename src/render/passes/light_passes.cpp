#include "render/passes/light_passes.h"

#include <fmt/core.h>

#include <cmath>

#include "base/error.h"
#include "render/light_sweep.h"

namespace bruma::render {
namespace {

int coarsening_of(scene::LightResolution resolution) {
    return 1 << int(resolution);
}

struct MediumParameters {
    LightGrid grid;
    int samples = 1;  ///< along each edge of a cell
    bool with_albedo = false;
    glm::dvec3 albedo{1.0};  ///< of the optics; 0 when it is not wanted
    std::array<double, 2> window{0.0, 1.0};
    double depth_per_sigma = 1.0;
    glm::dmat4 cells_from_texture{1.0};
    bool operator==(const MediumParameters&) const = default;
};

struct SweepParameters {
    SweepPlan plan;
    LightTransport transport = LightTransport::direct;
    SweepSettings settings;
    scene::ClipBox clip;
    // Shadow rays only.
    glm::dmat4 world_from_texture{1.0};
    double step_world = 0.0;
    double tau_per_step = 0.0;
    std::array<double, 2> window{0.0, 1.0};
    bool operator==(const SweepParameters&) const = default;
};

/// u_from_voxel as the shaders want it, and the coordinate in a 1-D table.
glm::dvec2 optics_from_voxel(const VolumeTexture& voxels, std::array<double, 2> window) {
    const double width = window[1] - window[0];
    glm::dvec2 u(voxels.value_of_one - voxels.value_of_zero, voxels.value_of_zero - window[0]);
    u /= width;
    u *= std::min(1.0, 1e30 / std::max(1e-300, std::max(std::abs(u.x), std::abs(u.y))));
    const double scale = double(depth_entries - 1) / depth_entries;
    return {u.x * scale, u.y * scale + 0.5 / depth_entries};
}

gl::Texture optics_texture(const TransferTables& tables) {
    gl::Texture texture = gl::Texture::make_1d("optics of the light's medium", GL_RGBA32F, depth_entries);
    texture.upload({GL_RGBA, GL_FLOAT}, tables.optics.data());
    return texture;
}

/// Texture space of cell (0, 0, 0)'s corner, and per cell.
std::array<glm::dvec3, 2> texture_of_cells(const glm::dmat4& cells_from_texture) {
    const glm::dmat4 texture_from_cells = glm::inverse(cells_from_texture);
    return {glm::dvec3(texture_from_cells[3]),
            {texture_from_cells[0][0], texture_from_cells[1][1], texture_from_cells[2][2]}};
}

void make_medium(gl::ShaderLibrary& shaders, const VolumeTexture& voxels, const EmptinessTexture& emptiness,
                 const scene::TransferFunction& tf, const MediumParameters& p, LightMedium& medium) {
    const TransferTables tables =
        make_transfer_tables(tf, {.preintegrated = false, .lit = true, .scatters = true, .albedo = p.albedo});
    const gl::Texture optics = optics_texture(tables);
    medium.extinction = gl::Texture::make_3d("extinction for light", GL_R32F, p.grid.cells);
    medium.albedo = p.with_albedo ? gl::Texture::make_3d("albedo for light", GL_RGBA16F, p.grid.cells) : gl::Texture();
    gl::Program& program =
        shaders.get("light_medium.comp", p.with_albedo ? gl::Defines{{"ALBEDO", ""}} : gl::Defines{});
    const auto [low, per_cell] = texture_of_cells(p.cells_from_texture);
    voxels.texture.bind(0);
    optics.bind(1);
    emptiness.distance.bind(2);
    program.set("voxels", 0);
    program.set("optics_table", 1);
    program.set("emptiness", 2);
    program.set("optics_from_voxel", glm::vec2(optics_from_voxel(voxels, p.window)));
    program.set("depth_per_sigma", float(p.depth_per_sigma));
    program.set("cells", p.grid.cells);
    program.set("texture_low", glm::vec3(low));
    program.set("texture_per_cell", glm::vec3(per_cell));
    program.set("macrocells_from_texture", glm::vec3(emptiness.voxels) / float(emptiness.edge));
    program.set("samples", p.samples);
    program.use();
    glBindImageTexture(0, medium.extinction.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    if (p.with_albedo) {
        glBindImageTexture(1, medium.albedo.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_RGBA16F);
    }
    glDispatchCompute(GLuint(p.grid.cells.x + 7) / 8, GLuint(p.grid.cells.y + 3) / 4, GLuint(p.grid.cells.z + 3) / 4);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

gl::Texture trace_shadow_rays(gl::ShaderLibrary& shaders, const VolumeTexture& voxels,
                              const EmptinessTexture& emptiness, const scene::TransferFunction& tf,
                              const SweepParameters& p) {
    const TransferTables tables = make_transfer_tables(tf, {.preintegrated = false});
    const gl::Texture optics = optics_texture(tables);
    const bool single = p.settings.precision == scene::LightPrecision::single;
    gl::Texture direct = gl::Texture::make_3d("direct light", single ? GL_R32F : GL_R16F, p.plan.grid.cells);
    gl::Defines defines{{"VOLUMES", "1"},
                        {"SAMPLE_AT_MIDPOINTS", ""},
                        {"LEAP", ""},
                        {"STOP_EARLY", ""},
                        {"FORMAT", single ? "r32f" : "r16f"}};
    if (p.plan.from_point) {
        defines["FROM_POINT"] = "";
    }
    gl::Program& program = shaders.get("light_rays.comp", defines);
    const glm::dmat4 texture_from_world = glm::inverse(p.world_from_texture);
    const glm::dmat4 texture_from_cells = texture_from_world * p.plan.grid.world_from_cells;
    const glm::dvec3 to_light = p.plan.from_point ? glm::dvec3(texture_from_cells * glm::dvec4(p.plan.light_cells, 1.0))
                                                  : glm::dmat3(texture_from_cells) * p.plan.light_cells * p.step_world;
    voxels.texture.bind(0);
    program.set_at("voxels", 0, "", 0);
    optics.bind(1);
    program.set_at("optics_table", 0, "", 1);
    emptiness.distance.bind(2);
    program.set_at("emptiness", 0, "", 2);
    program.set_at("optics_from_voxel", 0, "", glm::vec2(optics_from_voxel(voxels, p.window)));
    const double scale = double(depth_entries - 1) / depth_entries;
    const double shift = 0.5 / depth_entries;
    program.set_at("optics_visible", 0, "",
                   glm::vec2(tables.lowest_visible * scale + shift, tables.highest_visible * scale + shift));
    program.set_at("tau_scale", 0, "", float(p.tau_per_step));
    program.set_at("cells_from_texture", 0, "", glm::vec3(emptiness.voxels) / float(emptiness.edge));
    program.set_at("last_cell", 0, "", glm::vec3(emptiness.distance.size() - 1));
    program.set("cells", p.plan.grid.cells);
    program.set("texture_low", glm::vec3(texture_from_cells[3]));
    program.set("texture_per_cell",
                glm::vec3(texture_from_cells[0][0], texture_from_cells[1][1], texture_from_cells[2][2]));
    program.set("clip_low", glm::vec3(p.clip.low));
    program.set("clip_high", glm::vec3(p.clip.high));
    program.set("light", glm::vec3(to_light));
    program.set("steps_from_texture", glm::mat3(glm::dmat3(p.world_from_texture) / p.step_world));
    program.use();
    glBindImageTexture(0, direct.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, direct.format());
    const glm::ivec3 cells = p.plan.grid.cells;
    glDispatchCompute(GLuint(cells.x + 7) / 8, GLuint(cells.y + 3) / 4, GLuint(cells.z + 3) / 4);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
    return direct;
}

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
        throw InputError(
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
    const MediumParameters parameters{
        grid,
        samples,
        with_albedo,
        with_albedo ? volume.optics->albedo : glm::dvec3(0.0),
        scene::effective_window(volume),
        volume.optics->density_scale / volume.transfer_function->reference_length * grid.length,
        cells_from_texture};
    graph_.set_parameters(medium.pass, parameters);
    graph_.set_execute(medium.pass, [this, parameters, product = medium.medium](const PassAccess& access) {
        make_medium(shaders_, access.read(volume_.voxels), access.read(volume_.emptiness),
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
    parameters.clip = *volume.clip;
    if (rays) {
        parameters.world_from_texture = world_from_texture;
        parameters.step_world = step_world;
        parameters.tau_per_step =
            volume.optics->density_scale / volume.transfer_function->reference_length * step_world;
        parameters.window = scene::effective_window(volume);
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
    graph_.set_execute(
        sweep.pass, [this, parameters, light = sweep.light, handle = medium.medium](const PassAccess& access) {
            LightTextures& out = access.write(light);
            out.grid = parameters.plan.grid;
            const glm::ivec3 cells = out.grid.cells;
            if (parameters.transport == LightTransport::shadow_rays) {
                out.direct = trace_shadow_rays(shaders_, access.read(volume_.voxels), access.read(volume_.emptiness),
                                               access.read(volume_.transfer_function), parameters);
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
