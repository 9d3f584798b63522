#include "render/passes/opaque_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "gl/query.h"
#include "render/passes/subsurface_entry.h"
#include "render/view_rays.h"

namespace bruma::render {
namespace {

void make_targets(OpaquePicture& picture, glm::ivec2 pixels) {
    if (!picture.radiance || glm::ivec2(picture.radiance.size()) != pixels) {
        picture.framebuffer = {};
        picture.radiance = gl::Texture::make_2d("opaque radiance", GL_RGBA32F, pixels);
        picture.distance = gl::Texture::make_2d("opaque distance", GL_R32F, pixels);
        picture.depth = gl::Texture::make_2d("opaque depth", GL_DEPTH32F_STENCIL8, pixels);
        picture.framebuffer = gl::Framebuffer("opaque", {&picture.radiance, &picture.distance}, &picture.depth);
    }
}

void clear(const OpaquePicture& picture) {
    const GLuint name = picture.framebuffer.name();
    const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    const float far_away[4] = {1e30F, 0.0F, 0.0F, 0.0F};
    glClearNamedFramebufferfv(name, GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(name, GL_COLOR, 1, far_away);
    glClearNamedFramebufferfi(name, GL_DEPTH_STENCIL, 0, 0.0F, 0);  // reversed: 0 is farthest
}

std::array<glm::dvec3, 8> corners_world(const glm::dmat4& world_from_model, const scene::TriangleMesh& mesh) {
    std::array<glm::dvec3, 8> corners;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec4 p(n & 1 ? mesh.high.x : mesh.low.x, n & 2 ? mesh.high.y : mesh.low.y,
                           n & 4 ? mesh.high.z : mesh.low.z, 1.0);
        corners[std::size_t(n)] = world_from_model * p;
    }
    return corners;
}

bool shows_texture(const scene::TriangleMesh& mesh, const scene::MeshSurface& surface) {
    return surface.textured && !mesh.texture_coordinates.empty() &&
           std::any_of(mesh.materials.begin(), mesh.materials.end(),
                       [](const scene::MeshMaterial& material) { return material.diffuse_texture != nullptr; });
}

/// As mesh.frag counts highlights.
int highlight_of(scene::MeshShading shading, bool on_translucent) {
    switch (shading) {
        case scene::MeshShading::phong:
            return 1;
        case scene::MeshShading::blinn_phong:
            return 2;
        case scene::MeshShading::translucent:
            return on_translucent ? 2 : 0;
        default:
            return 0;
    }
}

/// Points per lamp for a pixel that no map sees well: turns of 64. Beside the maps' means their noise, a tenth of the
/// value with one turn, would be seen.
constexpr int points_in_turn = 64;
constexpr int turns_beside_maps = 4;
constexpr std::int64_t most_turns = 64;

constexpr GLuint first_cloud_unit = 8;  ///< behind the textures of surfaces and of what is inside

}  // namespace

/// Lengths are counted in a power of two of metres about as long as the meshes, so that scenes of any size give numbers
/// that floats and their squares can hold.
struct OpaquePass::Stand {
    Stand(const scene::Camera& seen_from, const PassAccess& access, const std::vector<MeshInput>& meshes)
        : camera(seen_from), frame(scene::camera_frame(camera)) {
        glm::dvec3 low(1e300), high(-1e300);
        double nearest = 1e300, farthest = -1e300;
        for (const MeshInput& input : meshes) {
            for (const glm::dvec3& p : corners_world(input.world_from_model, *access.read(input.triangles))) {
                low = glm::min(low, p);
                high = glm::max(high, p);
                const double depth = -glm::dot(p - camera.eye_world, frame.back_world);
                nearest = std::min(nearest, depth);
                farthest = std::max(farthest, depth);
            }
        }
        unit_world = std::exp2(std::floor(std::log2(std::max(glm::length(high - low), 1e-30))));
        // Planes as close around the meshes as may be, with room for rounding.
        const double room = 1e-3 * (farthest - nearest) + 1e-6 * std::abs(farthest);
        near_plane = std::max(camera.near_distance, nearest - room) / unit_world;
        far_plane = (farthest + room) / unit_world;
        if (camera.projection == scene::Projection::perspective) {
            near_plane = std::max(near_plane, std::max(1e-9 * far_plane, 1e-30));
        }
        far_plane = std::max(far_plane, near_plane + 1e-6 * std::abs(near_plane) + 1e-30);
    }
    glm::vec2 depth_of_z() const {
        if (camera.projection == scene::Projection::perspective) {
            return {0.0, near_plane};  // near / -z: 0 only at infinity
        }
        const double length = far_plane - near_plane;
        return {1.0 / length, far_plane / length};
    }

    scene::Camera camera;
    scene::CameraFrame frame;
    double unit_world = 1.0;
    double near_plane = 0.0, far_plane = 1.0;  ///< along the view axis, units
};

OpaquePass::OpaquePass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    shader_revision_ = graph.add_source<int>("shaders");
    picture = graph.add_product<OpaquePicture>("opaque picture");
    pass_ = graph.add_pass({"opaque", "the nearest surface of all meshes under the lights", {}, {picture.index}, {}});
}

void OpaquePass::remove() {
    graph_.remove_pass(pass_);
    graph_.remove_source(camera_.index);
    graph_.remove_source(shader_revision_.index);
}

void OpaquePass::update(const scene::Scene& scene, const Meshes& meshes, const Translucents& translucents,
                        Handle<ShadowMaps> shadows, glm::ivec2 pixels, Handle<SkyLight> sky,
                        const CloudShadows& clouds) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    Parameters parameters{
        pixels, skipped_distance(**scene.camera, scene::world_bounds(scene)), {}, {}, *scene.environment, shadows, sky,
        clouds};
    std::vector<int> reads{camera_.index, shader_revision_.index};
    if (shadows.index >= 0) {
        reads.push_back(shadows.index);
    }
    if (sky.index >= 0) {
        reads.push_back(sky.index);
    }
    clouds.add_reads(reads);
    for (const auto& [name, passes] : meshes) {
        const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(name).content);
        MeshInput input;
        input.name = name;
        input.triangles = passes->triangles;
        input.buffers = passes->buffers;
        input.world_from_model = scene::world_from_model(scene, name);
        input.surface = *mesh.surface;
        reads.insert(reads.end(), {input.triangles.index, input.buffers.index});
        if (shows_texture(**mesh.triangles, *mesh.surface)) {
            input.textures = passes->textures;
            reads.push_back(input.textures.index);
        }
        if (const auto found = translucents.find(name); found != translucents.end()) {
            input.inside.shown = std::make_shared<TranslucentPasses::Shown>(found->second->shown());
            reads.insert(reads.end(), {input.inside.shown->light.index, input.inside.shown->exits.index,
                                       input.inside.shown->radiosity.index});
        }
        input.highlight = highlight_of(input.surface.shading, mesh.subsurface->highlight);
        input.surface.material = {};
        input.surface.custom_medium = {};
        parameters.meshes.push_back(std::move(input));
    }
    for (const std::string& light : order_lights(scene)) {
        parameters.lights.push_back(*scene.lights.at(light));
    }
    graph_.set_reads(pass_, reads);
    graph_.set_parameters(pass_, parameters);
    graph_.set_execute(pass_, [this, parameters](const PassAccess& access) { draw(access, parameters); });
}

void OpaquePass::draw(const PassAccess& access, const Parameters& parameters) {
    const Stand stand(started_nearer(access.read(camera_), parameters.skipped_distance), access, parameters.meshes);
    OpaquePicture& out = access.write(picture);
    make_targets(out, parameters.pixels);
    out.unit_world = stand.unit_world;
    clear(out);
    out.framebuffer.bind();

    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    if (parameters.sky.index >= 0) {
        access.read(parameters.sky).buffer.bind_storage(sky_light_binding);
    }
    out.unseen = 0;
    std::size_t triangles = 0;
    const bool any_translucent = std::any_of(parameters.meshes.begin(), parameters.meshes.end(),
                                             [](const MeshInput& input) { return input.inside.shown != nullptr; });
    if (any_translucent) {
        // Depth first: light from inside is dear, and what is hidden shall not count as seen.
        glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
        for (const MeshInput& input : parameters.meshes) {
            draw_mesh(access, prepared_program(access, parameters, stand, {{"DEPTH_ONLY", ""}}), input, stand, {});
        }
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glDepthFunc(GL_GEQUAL);
    }
    const gl::Defines opaque = defines_of(parameters);
    for (const MeshInput& input : parameters.meshes) {
        triangles += access.read(input.triangles)->triangles.size();
        if (input.inside.shown) {
            out.unseen += draw_translucent(access, parameters, stand, input);
            continue;
        }
        draw_mesh(access, prepared_program(access, parameters, stand, opaque), input, stand, parameters.shadows);
    }
    glDisable(GL_DEPTH_TEST);
    std::string note =
        fmt::format("{} x {} pixels, {} triangles of {} mesh{}", parameters.pixels.x, parameters.pixels.y, triangles,
                    parameters.meshes.size(), parameters.meshes.size() == 1 ? "" : "es");
    if (any_translucent) {
        note += fmt::format(", {} pixels that no map sees well", out.unseen);
    }
    access.note(note);
}

std::uint32_t OpaquePass::draw_translucent(const PassAccess& access, const Parameters& parameters, const Stand& stand,
                                           const MeshInput& input) {
    // From the maps first, which leaves pixels open that none of them sees; light from points, which is dear, for
    // these.
    const bool see_through = draw_thickness(access, parameters, stand, input);
    glEnable(GL_STENCIL_TEST);
    glStencilFunc(GL_EQUAL, 0, 1);
    glStencilOp(GL_KEEP, GL_KEEP, GL_INCR);
    gl::Defines defines = defines_of(parameters);
    defines["TRANSLUCENT"] = "";
    const gl::Query unseen("unseen pixels", GL_SAMPLES_PASSED);
    for (const bool from_points : {false, true}) {
        if (from_points) {
            defines["FROM_POINTS"] = "";
            defines.merge(entry_defines(access.read(input.inside.shown->light), input.inside.shown->settings));
            unseen.begin();
        }
        gl::Program& program = prepared_program(access, parameters, stand, defines);
        gl::Buffer lamps;
        set_inside(access, program, input, lamps);
        program.set("see_through", see_through ? 1 : 0);
        program.set("sigma_unscattered", glm::vec3(input.inside.shown->constants.sigma_unscattered));
        program.set("thickness", 6);
        if (see_through) {
            access.write(picture).thickness.bind(6);
        }
        draw_mesh(access, program, input, stand, parameters.shadows);
    }
    const std::uint32_t count = unseen.end();
    glDisable(GL_STENCIL_TEST);
    const GLint none = 0;
    glClearNamedFramebufferiv(access.write(picture).framebuffer.name(), GL_STENCIL, 0, &none);  // for the next mesh
    return count;
}

bool OpaquePass::draw_thickness(const PassAccess& access, const Parameters& parameters, const Stand& stand,
                                const MeshInput& input) {
    const TranslucentPasses::Shown& shown = *input.inside.shown;
    const glm::dvec3 sigma = shown.constants.sigma_unscattered;
    const double radius = access.read(shown.light).bounding_radius;
    // Where less than e^-4 is left after half the body, what is scattered outshines the rest.
    const bool any_comes_through = std::min({sigma.x, sigma.y, sigma.z}) * radius < 4.0;
    if (!shown.settings.unscattered || parameters.environment.radiance == glm::dvec3(0.0) || !any_comes_through ||
        !access.read(input.triangles)->closed) {
        return false;
    }
    OpaquePicture& out = access.write(picture);
    if (!out.thickness || out.thickness.size() != out.radiance.size()) {
        out.thickness_framebuffer = {};
        out.thickness = gl::Texture::make_2d("thickness", GL_R32F, glm::ivec2(out.radiance.size()));
        out.thickness_framebuffer = gl::Framebuffer("thickness", {&out.thickness});
    }
    const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    glClearNamedFramebufferfv(out.thickness_framebuffer.name(), GL_COLOR, 0, nothing);
    out.thickness_framebuffer.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    gl::Program& program = prepared_program(access, parameters, stand, {{"THICKNESS", ""}});
    program.set("mm_per_unit", float(1e3 * stand.unit_world));
    draw_mesh(access, program, input, stand, {});
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    out.framebuffer.bind();
    return true;
}

gl::Defines OpaquePass::defines_of(const Parameters& parameters) {
    gl::Defines defines;
    count_lights(defines, parameters.lights);
    if (parameters.shadows.index >= 0) {
        defines["SHADOWS"] = "";
    }
    if (parameters.sky.index >= 0) {
        defines["SKY_LIGHT"] = "";
    }
    parameters.clouds.add_defines(defines);
    return defines;
}

gl::Program& OpaquePass::prepared_program(const PassAccess& access, const Parameters& parameters, const Stand& stand,
                                          const gl::Defines& defines) {
    gl::Program& program = shaders_.get("mesh.frag", defines);
    program.set("pixels", glm::vec2(parameters.pixels));
    program.set("orthographic", stand.camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(stand.camera, parameters.pixels, stand.unit_world)));
    program.set("depth_of_z", stand.depth_of_z());
    program.set("world_from_camera",
                glm::mat3(glm::dmat3(stand.frame.right_world, stand.frame.up_world, stand.frame.back_world)));
    program.set("ambient", glm::vec3(parameters.environment.radiance));
    set_lights(program, parameters.lights, stand.camera, stand.unit_world);
    parameters.clouds.set(access, program, stand.camera.eye_world, stand.unit_world, first_cloud_unit);
    program.use();
    return program;
}

void OpaquePass::set_inside(const PassAccess& access, gl::Program& program, const MeshInput& input, gl::Buffer& lamps) {
    const TranslucentPasses::Shown& shown = *input.inside.shown;
    const ExitMaps& exits = access.read(shown.exits);
    exits.cameras.bind_storage(1);
    exits.depth.bind(1);
    program.set("exit_depth", 1);
    access.read(shown.radiosity).mean.bind(2);
    program.set("radiosity", 2);
    program.set("exit_count", exits.maps());
    set_entry(program, access.read(shown.light), shown.constants, shown.powers, 3, lamps);
    program.set("diffuse_reflectance", glm::vec3(shown.constants.diffuse_reflectance));
    set_entry_points(program, 0, points_in_turn);
    // Without maps all pixels get the points that the maps' texels would have got.
    const std::int64_t turns = access.read(shown.radiosity).passes * shown.settings.samples / points_in_turn;
    program.set("entry_turns",
                exits.maps() > 0 ? turns_beside_maps : int(std::clamp(turns, std::int64_t(1), most_turns)));
    program.set("body_from_model", glm::mat3(shown.frame.body_from_model));
    const glm::dmat3 normals = glm::inverse(shown.frame.body_from_model);  // which is symmetric
    program.set("body_from_normal", glm::mat3(normals / std::max({std::abs(normals[0][0]), std::abs(normals[1][1]),
                                                                  std::abs(normals[2][2]), 1e-300})));
}

void OpaquePass::draw_mesh(const PassAccess& access, gl::Program& program, const MeshInput& input, const Stand& stand,
                           Handle<ShadowMaps> shadows) {
    const MeshBuffers& buffers = access.read(input.buffers);
    const scene::TriangleMesh& mesh = *access.read(input.triangles);
    const glm::dmat3 linear(input.world_from_model);
    const glm::dmat3 camera_from_world =
        glm::transpose(glm::dmat3(stand.frame.right_world, stand.frame.up_world, stand.frame.back_world)) /
        stand.unit_world;
    // The eye is taken off in double, before anything is rounded.
    const glm::dvec3 middle_world = input.world_from_model * glm::dvec4(buffers.middle_model, 1.0);
    glm::dmat4 camera_from_model(camera_from_world * linear);
    camera_from_model[3] = glm::dvec4(camera_from_world * (middle_world - stand.camera.eye_world), 1.0);
    program.set("camera_from_model", glm::mat4(camera_from_model));
    // Normals stay outside when a transform mirrors; which way round a triangle then runs does not.
    glm::dmat3 world_from_normal = glm::transpose(glm::inverse(linear));
    double largest = 0.0;
    for (int k = 0; k < 9; ++k) {
        largest = std::max(largest, std::abs(world_from_normal[k / 3][k % 3]));
    }
    program.set("world_from_normal", glm::mat3(world_from_normal / largest));
    glFrontFace(glm::determinant(linear) < 0.0 ? GL_CW : GL_CCW);
    program.set("highlight", input.highlight);
    if (shadows.index >= 0) {
        const ShadowMaps& maps = access.read(shadows);
        program.set("shadow_from_model",
                    glm::mat4(maps.shadow_from_model(input.world_from_model, buffers.middle_model)));
        maps.lamps.bind_storage(6);
        maps.depth.bind(5);
        program.set("shadow_depth", 5);
    }
    program.set("diffuse_texture", 0);
    glBindVertexArray(buffers.array.name());
    for (const MeshBuffers::Part& part : buffers.parts) {
        const scene::MeshMaterial material = scene::shown_material(mesh, input.surface, part.material);
        program.set("diffuse", glm::vec3(material.diffuse));
        program.set("specular", glm::vec3(material.specular));
        program.set("shininess", float(material.shininess));
        const bool textured = input.textures.index >= 0 && material.diffuse_texture != nullptr;
        program.set("textured", textured ? 1 : 0);
        if (textured) {
            access.read(input.textures).of.at(material.diffuse_texture.get()).bind(0);
        }
        glDrawElements(GL_TRIANGLES, GLsizei(part.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t)));  // NOLINT: OpenGL's way
    }
    glFrontFace(GL_CCW);
}

}  // namespace bruma::render
