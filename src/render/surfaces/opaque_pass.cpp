#include "render/surfaces/opaque_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "render/products/sample_places.h"
#include "render/view_rays.h"

namespace bruma::render {
namespace {

void clear(GLuint name) {
    const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    const float far_away[4] = {1e30F, 1.0F, 0.0F, 0.0F};
    glClearNamedFramebufferfv(name, GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(name, GL_COLOR, 1, far_away);
    const float farthest = 0.0F;  // reversed
    glClearNamedFramebufferfv(name, GL_DEPTH, 0, &farthest);
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

constexpr GLuint first_cloud_unit = 8;  ///< behind the textures of surfaces and of what is inside

}  // namespace

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
    Parameters parameters{pixels,
                          int(scene.rendering->samples),
                          skipped_distance(**scene.camera, scene::world_bounds(scene)),
                          {},
                          {},
                          *scene.environment,
                          shadows,
                          sky,
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
        input.placed = {passes->triangles, passes->buffers, scene::world_from_model(scene, name)};
        input.surface = *mesh.surface;
        reads.insert(reads.end(), {input.placed.triangles.index, input.placed.buffers.index});
        input.colored = mesh.surface->file_materials && !(*mesh.triangles)->colors.empty();
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
    std::vector<PlacedMesh> placed;
    for (const MeshInput& input : parameters.meshes) {
        placed.push_back(input.placed);
    }
    const MeshView view(access.read(camera_), parameters.skipped_distance, access, placed);
    OpaquePicture& out = access.write(picture);
    out.sampled.prepare(out.layers, parameters.pixels, parameters.samples);
    out.layers.unit_world = view.unit_world;
    clear(out.sampled.target(out.layers).name());
    out.sampled.target(out.layers).bind();

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
        view.draw_depth(access, prepared_program(access, parameters, view, {{"DEPTH_ONLY", ""}}), placed);
        glDepthFunc(GL_GEQUAL);
    }
    for (const MeshInput& input : parameters.meshes) {
        triangles += access.read(input.placed.triangles)->triangles.size();
        if (input.inside.shown) {
            out.unseen += draw_translucent(access, parameters, view, input);
            continue;
        }
        gl::Defines opaque = defines_of(parameters);
        if (input.colored) {
            opaque["VERTEX_COLORS"] = "";
        }
        draw_mesh(access, prepared_program(access, parameters, view, opaque), input, view, parameters.shadows);
    }
    glDisable(GL_DEPTH_TEST);
    out.sampled.resolve(out.layers, shaders_, view.pixel_size(parameters.pixels));
    std::string note =
        fmt::format("{} x {} pixels, {} triangles of {} mesh{}", parameters.pixels.x, parameters.pixels.y, triangles,
                    parameters.meshes.size(), parameters.meshes.size() == 1 ? "" : "es");
    if (any_translucent) {
        note += fmt::format(", {} pixels that no map sees well", out.unseen);
    }
    access.note(note);
}

gl::Defines OpaquePass::defines_of(const Parameters& parameters) {
    gl::Defines defines;
    count_lights(defines, parameters.lights);
    if (parameters.samples > 1) {
        defines["SAMPLES"] = std::to_string(samples_of_driver(parameters.samples));
    }
    if (parameters.shadows.index >= 0) {
        defines["SHADOWS"] = "";
    }
    if (parameters.sky.index >= 0) {
        defines["SKY_LIGHT"] = "";
    }
    parameters.clouds.add_defines(defines);
    return defines;
}

gl::Program& OpaquePass::prepared_program(const PassAccess& access, const Parameters& parameters, const MeshView& view,
                                          const gl::Defines& defines) {
    gl::Program& program = shaders_.get("mesh/mesh.frag", defines);
    view.set(program, parameters.pixels);
    if (defines.contains("SAMPLES")) {
        set_sample_places(program, samples_of_driver(parameters.samples));
    }
    program.set("world_from_camera",
                glm::mat3(glm::dmat3(view.frame.right_world, view.frame.up_world, view.frame.back_world)));
    program.set("ambient", glm::vec3(parameters.environment.radiance));
    set_lights(program, parameters.lights, view.camera, view.unit_world);
    parameters.clouds.set(access, program, view.camera.eye_world, view.unit_world, first_cloud_unit);
    program.use();
    return program;
}

void OpaquePass::draw_mesh(const PassAccess& access, gl::Program& program, const MeshInput& input, const MeshView& view,
                           Handle<ShadowMaps> shadows) {
    const MeshBuffers& buffers = access.read(input.placed.buffers);
    const scene::TriangleMesh& mesh = *access.read(input.placed.triangles);
    view.place(program, input.placed.world_from_model, buffers.middle_model);
    program.set("highlight", input.highlight);
    if (shadows.index >= 0) {
        const ShadowMaps& maps = access.read(shadows);
        program.set("shadow_from_model",
                    glm::mat4(maps.shadow_from_model(input.placed.world_from_model, buffers.middle_model)));
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
        const scene::TexturePlacement& placement = material.placement;
        program.set("textured", textured ? 1 : 0);
        program.set("picture_place", glm::vec4(placement.scale, placement.offset));
        program.set("picture_range", glm::vec2(placement.base, placement.gain));
        program.set("picture_once", placement.once ? 1 : 0);
        program.set("emission", glm::vec3(material.emission));
        program.set("constant_color", material.constant ? 1 : 0);
        if (textured) {
            access.read(input.textures).of.at(material.diffuse_texture.get()).bind(0);
        }
        glDrawElements(GL_TRIANGLES, GLsizei(part.count), GL_UNSIGNED_INT,
                       reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t)));  // NOLINT: OpenGL's way
    }
    glFrontFace(GL_CCW);
}

}  // namespace bruma::render
