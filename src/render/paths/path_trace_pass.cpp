#include "render/paths/path_trace_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "base/error.h"

namespace bruma::render {
namespace {

/// The shader repeats itself for each volume this often, and binds four textures each time.
constexpr int most_volumes = 8;

void check_volumes(int volumes) {
    GLint units = 0;
    glGetIntegerv(GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS, &units);
    if (const int most = std::min(most_volumes, units / 4); volumes > most) {
        throw InputError(fmt::format("path_traced lighting: {} volumes are shown, but it takes at most {}; hide some",
                                     volumes, most));
    }
}

constexpr int group_edge = 8;  ///< of the shader's work groups

/// Floats end at 3e38; products of two factors shall stay below.
constexpr double largest_factor = 1e30;

void make_targets(PathTracing& out, glm::ivec2 pixels) {
    if (!out.mean || glm::ivec2(out.mean.size()) != pixels) {
        out.mean = gl::Texture::make_2d("path traced mean", GL_RGBA32F, pixels);
        out.spread = gl::Texture::make_2d("path traced spread", GL_RGBA32F, pixels);
    }
}

/// Takes the means over into the picture that is shown.
void show(PathTracing& out) {
    const glm::ivec3 size = out.mean.size();
    if (!out.picture.color || out.picture.color.size() != size) {
        out.picture.framebuffer = {};
        out.picture.color = gl::Texture::make_2d("path traced picture", GL_RGBA32F, glm::ivec2(size));
        out.picture.framebuffer = gl::Framebuffer("path traced picture", {&out.picture.color});
    }
    glCopyImageSubData(out.mean.name(), GL_TEXTURE_2D, 0, 0, 0, 0, out.picture.color.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       size.x, size.y, 1);
}

}  // namespace

/// Medium space: the world's axes, origin and unit chosen so that floats hold it well.
struct PathTracePass::Medium {
    glm::dvec3 center_world{0.0};
    double unit = 1.0;  ///< metres

    explicit Medium(const std::vector<VolumeInput>& volumes) {
        glm::dvec3 low(1e300), high(-1e300);
        for (const VolumeInput& input : volumes) {
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 p =
                    input.world_from_texture * glm::dvec4(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1, 1.0);
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
        center_world = 0.5 * (low + high);
        unit = std::max(1e-150, 0.5 * glm::length(high - low));
    }
    glm::dvec3 place(glm::dvec3 world) const { return (world - center_world) / unit; }
};

bool is_path_traced(const scene::Scene& scene) {
    const std::vector<std::string> shown = scene::shown_volumes(scene);
    return std::any_of(shown.begin(), shown.end(), [&](const std::string& name) {
        return std::get<scene::Volume>(scene.nodes.at(name).content).optics->lighting ==
               scene::VolumeLighting::path_traced;
    });
}

PathTracePass::PathTracePass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    background_ = graph.add_source<scene::Background>("background");
    environment_ = graph.add_source<scene::Environment>("environment");
    shader_revision_ = graph.add_source<int>("shaders");
    start_ = graph.add_product<Start>("start of paths");
    paths = graph.add_product<PathTracing>("paths");
    begin_ =
        graph.add_pass({"begin paths", "lets all paths begin anew", {}, {start_.index}, [this](const auto& access) {
                            access.write(start_).revision = next_revision();
                        }});
    trace_ = graph.add_pass(
        {"path trace", "adds paths of light through all volumes to each pixel's mean", {}, {paths.index}, {}});
}

void PathTracePass::forget(const std::string& node_name) {
    if (const auto found = volumes_.find(node_name); found != volumes_.end()) {
        found->second->remove();
        volumes_.erase(found);
    }
}

void PathTracePass::forget_all() {
    while (!volumes_.empty()) {
        forget(std::string(volumes_.begin()->first));
    }
}

void PathTracePass::update(const scene::Scene& scene, const MarchPass::Volumes& volumes, const View& view) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(background_, *scene.background, scene.background.revision());
    graph_.set_source(environment_, *scene.environment, scene.environment.revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());

    Parameters parameters{view.pixels, view.paths.scatterings, {}, {}};
    std::vector<int> reads{camera_.index, background_.index, environment_.index, shader_revision_.index};
    for (const auto& [name, passes] : volumes) {
        const auto& volume = std::get<scene::Volume>(scene.nodes.at(name).content);
        std::unique_ptr<PathVolumePasses>& own = volumes_[name];
        if (!own) {
            own = std::make_unique<PathVolumePasses>(graph_, name, *passes);
        }
        own->update(volume);
        parameters.volumes.push_back({passes->voxels, own->tables, own->bounds, scene::world_from_texture(scene, name),
                                      *volume.clip, volume.optics->g, scene::effective_window(volume),
                                      volume.optics->density_scale / volume.transfer_function->reference_length});
        reads.insert(reads.end(), {passes->voxels.index, own->tables.index, own->bounds.index});
    }
    for (const auto& [name, light] : scene.lights) {
        if (scene::shines(*light)) {
            parameters.lights.push_back(*light);
        }
    }
    graph_.set_reads(begin_, reads);
    graph_.set_parameters(begin_, parameters);
    reads.push_back(start_.index);
    graph_.set_reads(trace_, reads);
    const PathTracing* const standing = graph_.product(paths);
    const PathGoal goal = view.paths;
    turn_ += standing != nullptr && standing->samples < goal.samples ? 1 : 0;
    graph_.set_parameters(trace_, Turn{goal.samples, turn_});
    graph_.set_execute(trace_, [this, parameters, goal](const PassAccess& access) { trace(access, parameters, goal); });
}

void PathTracePass::set_camera(gl::Program& program, const Medium& medium, const scene::Camera& camera,
                               glm::ivec2 pixels) {
    const scene::CameraFrame frame = scene::camera_frame(camera);
    const bool orthographic = camera.projection == scene::Projection::orthographic;
    glm::dvec3 eye = medium.place(camera.eye_world);
    double near = camera.near_distance / medium.unit;
    double half_height = std::tan(glm::radians(0.5 * camera.vertical_angle_deg));
    if (orthographic) {
        // Parallel rays may start anywhere along the view: in the volumes' midst floats hold them best.
        const double distance = glm::dot(eye, frame.back_world);
        eye -= distance * frame.back_world;
        near -= distance;
        half_height = 0.5 * camera.view_height / medium.unit;
    }
    program.set("orthographic", orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_height * pixels.x / pixels.y, half_height));
    program.set("near_distance", float(near));
    program.set("eye", glm::vec3(eye));
    program.set("medium_from_camera", glm::mat3(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)));
}

void PathTracePass::set_lights(gl::Program& program, const Medium& medium, const std::vector<scene::Light>& lights,
                               const scene::Camera& camera) {
    for (std::size_t n = 0; n < lights.size(); ++n) {
        const scene::Light& light = lights[n];
        const bool has_position = scene::has_position(light);
        glm::dvec3 power = light.color * light.intensity;
        glm::dvec3 place = light.kind == scene::LightKind::headlight ? scene::camera_frame(camera).back_world
                                                                     : glm::normalize(light.direction_world);
        glm::vec3 axis(0.0F);
        glm::vec2 cone(-1.0F, 1.0F);  // a point light: full everywhere
        if (has_position) {
            power = glm::min(power / (medium.unit * medium.unit), largest_factor);
            // Squares of distances stay finite; what is further off than this has no light left.
            place = glm::clamp(medium.place(light.position_world), -1e18, 1e18);
        }
        if (light.kind == scene::LightKind::spot) {
            const double outer = std::cos(glm::radians(light.spot_angle_deg));
            const double inner = std::cos(glm::radians(light.spot_angle_deg * (1.0 - light.spot_softness)));
            axis = glm::normalize(light.direction_world);
            cone = {outer, 1.0 / std::max(inner - outer, 1e-6)};
        }
        program.set_at("lights", int(n), ".power", glm::vec3(power));
        program.set_at("lights", int(n), ".place", glm::vec3(place));
        program.set_at("lights", int(n), ".axis", axis);
        program.set_at("lights", int(n), ".cone", cone);
        program.set_at("lights", int(n), ".has_position", has_position ? 1 : 0);
    }
}

void PathTracePass::bind_volume(const PassAccess& access, gl::Program& program, const Medium& medium,
                                const VolumeInput& input, int index) {
    const VolumeTexture& voxels = access.read(input.voxels);
    const ScatteringTextures& tables = access.read(input.tables);
    const BoundsTexture& bounds = access.read(input.bounds);
    GLuint unit = GLuint(4 * index);
    const auto bind = [&](const char* sampler, const gl::Texture& texture) {
        texture.bind(unit);
        program.set_at(sampler, index, "", int(unit));
        ++unit;
    };
    bind("voxels", voxels.texture);
    bind("optics_table", tables.optics);
    bind("glow_table", tables.glow);
    bind("extinction_bounds", bounds.bounds);

    program.set_at("table_from_voxel", index, "",
                   glm::vec2(table_from_voxel(u_from_voxel(voxels, input.window), scattering_entries)));
    program.set_at("sigma_scale", index, "", float(std::min(input.sigma_per_metre * medium.unit, largest_factor)));
    program.set_at("cells_from_texture", index, "", bounds.cells_from_texture);
    program.set_at("clip_low", index, "", glm::vec3(input.clip.low));
    program.set_at("clip_high", index, "", glm::vec3(input.clip.high));
    program.set_at("mean_cosine", index, "", float(std::clamp(input.g, -0.99, 0.99)));
    glm::dmat4 world_from_medium = glm::translate(glm::dmat4(1.0), medium.center_world);
    world_from_medium = glm::scale(world_from_medium, glm::dvec3(medium.unit));
    program.set_at("texture_from_medium", index, "",
                   glm::mat4(glm::inverse(input.world_from_texture) * world_from_medium));
}

gl::Program& PathTracePass::prepare(const PassAccess& access, const Parameters& parameters) {
    check_volumes(int(parameters.volumes.size()));
    gl::Defines defines{{"VOLUMES", std::to_string(parameters.volumes.size())},
                        {"LIGHTS", std::to_string(parameters.lights.size())}};
    for (const VolumeInput& input : parameters.volumes) {
        if (access.read(input.tables).glow) {
            defines["GLOW"] = "";
        }
        if (access.read(input.voxels).holes) {
            defines["HOLES"] = "";
        }
    }
    gl::Program& program = shaders_.get("paths/path_trace.comp", defines);
    const scene::Camera& camera = access.read(camera_);
    const scene::Background& background = access.read(background_);
    const Medium medium(parameters.volumes);
    program.set("pixels", parameters.pixels);
    program.set("scattering_limit", parameters.scatterings);
    program.set("background_top", glm::vec3(background.top));
    program.set("background_bottom", glm::vec3(background.bottom));
    program.set("environment", glm::vec3(access.read(environment_).radiance));
    set_camera(program, medium, camera, parameters.pixels);
    set_lights(program, medium, parameters.lights, camera);
    for (std::size_t n = 0; n < parameters.volumes.size(); ++n) {
        bind_volume(access, program, medium, parameters.volumes[n], int(n));
    }
    return program;
}

void PathTracePass::trace(const PassAccess& access, const Parameters& parameters, const PathGoal& goal) {
    PathTracing& out = access.write(paths);
    const Revision start = access.read(start_).revision;
    const bool fewer_wanted = goal.samples < out.samples || (goal.samples == out.samples && out.next_row > 0);
    if (out.start != start || fewer_wanted) {
        make_targets(out, parameters.pixels);
        out.samples = 0;
        out.next_row = 0;
        out.start = start;
        out.row_ms = 0.0;
    }
    gl::Program& program = prepare(access, parameters);
    glBindImageTexture(0, out.mean.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    glBindImageTexture(1, out.spread.name(), 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA32F);
    program.use();
    const auto ms_since = [](std::chrono::steady_clock::time_point then) {
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - then).count();
    };
    const auto began = std::chrono::steady_clock::now();
    const int height = parameters.pixels.y;
    while (out.samples < goal.samples) {
        int rows = height;
        if (goal.budget_ms > 0.0) {
            const double left_ms = goal.budget_ms - ms_since(began);
            // Rows through nothing tell little of those through matter: at first only a few at a time.
            const double most_rows = out.samples == 0 ? height / 32.0 : height;
            rows = out.row_ms > 0.0 ? int(std::clamp(left_ms / out.row_ms, 1.0, std::max(1.0, most_rows))) : group_edge;
        }
        rows = std::min((rows + group_edge - 1) / group_edge * group_edge, height - out.next_row);
        program.set("first_row", out.next_row);
        program.set("path_number", out.samples);
        const auto dispatched = std::chrono::steady_clock::now();
        glDispatchCompute(GLuint((parameters.pixels.x + group_edge - 1) / group_edge),
                          GLuint((rows + group_edge - 1) / group_edge), 1);
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        out.next_row += rows;
        if (out.next_row >= height) {
            out.next_row = 0;
            ++out.samples;
        }
        if (goal.budget_ms > 0.0) {
            glFinish();
            out.row_ms = std::max(ms_since(dispatched) / rows, 0.98 * out.row_ms);
            // The first picture of all is worth any wait.
            if (ms_since(began) >= goal.budget_ms && (out.picture.color || out.samples > 0)) {
                break;
            }
        } else {
            glFlush();  // each path a job of its own, that no driver's watchdog takes for a hang
        }
    }
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
    if (out.samples > 0) {
        show(out);
    }
    access.note(fmt::format("{} x {} pixels, {} paths each", parameters.pixels.x, parameters.pixels.y, out.samples));
}

}  // namespace bruma::render
