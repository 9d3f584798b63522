#include "render/surfaces/map_reads_pass.h"

#include <fmt/core.h>

#include <algorithm>

#include "render/products/sample_places.h"
#include "render/products/surface_layers.h"
#include "render/view_rays.h"

namespace bruma::render {

MapReadsPass::MapReadsPass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    camera_ = graph.add_source<scene::Camera>("camera");
    shader_revision_ = graph.add_source<int>("shaders");
    reads = graph.add_product<MapReads>("map reads");
    pass_ = graph.add_pass({"map reads", "which texels of maps the camera looks up", {}, {reads.index}, {}});
}

MapReadsPass::~MapReadsPass() {
    graph_.remove_pass(pass_);
    graph_.remove_source(camera_.index);
    graph_.remove_source(shader_revision_.index);
}

void MapReadsPass::update(const scene::Scene& scene, const Meshes& meshes, const Translucents& translucents,
                          glm::ivec2 pixels) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    Parameters parameters{
        pixels, int(scene.rendering->samples), skipped_distance(**scene.camera, scene::world_bounds(scene)), {}, {}};
    std::vector<int> inputs{camera_.index, shader_revision_.index};
    for (const auto& [name, passes] : meshes) {
        if (const auto found = translucents.find(name); found != translucents.end()) {
            const TranslucentPasses::Shown& shown = found->second->shown();
            parameters.bodies.push_back({name, parameters.meshes.size(), shown.exits, shown.frame.body_from_model});
            inputs.push_back(shown.exits.index);
        }
        parameters.meshes.push_back({passes->triangles, passes->buffers, scene::world_from_model(scene, name)});
        inputs.insert(inputs.end(), {passes->triangles.index, passes->buffers.index});
    }
    graph_.set_reads(pass_, inputs);
    graph_.set_parameters(pass_, parameters);
    graph_.set_execute(pass_, [this, parameters](const PassAccess& access) { draw(access, parameters); });
}

void MapReadsPass::draw(const PassAccess& access, const Parameters& parameters) {
    const MeshView view(access.read(camera_), parameters.skipped_distance, access, parameters.meshes);
    const int samples = samples_of_driver(parameters.samples);
    if (!depth_ || glm::ivec2(depth_.size()) != parameters.pixels || samples != samples_) {
        framebuffer_ = {};
        const char* const label = "depth before map reads";
        depth_ = samples == 1 ? gl::Texture::make_2d(label, GL_DEPTH_COMPONENT32F, parameters.pixels)
                              : gl::Texture::make_2d_samples(label, GL_DEPTH_COMPONENT32F, parameters.pixels, samples);
        samples_ = samples;
        framebuffer_ = gl::Framebuffer("map reads", {}, &depth_);
    }
    const float farthest = 0.0F;  // reversed
    glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &farthest);
    framebuffer_.bind();
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    gl::Program& depth_only = shaders_.get("mesh/mesh.frag", {{"DEPTH_ONLY", ""}});
    view.set(depth_only, parameters.pixels);
    view.draw_depth(access, depth_only, parameters.meshes);
    glDepthFunc(GL_GEQUAL);
    glDepthMask(GL_FALSE);
    gl::Defines defines{{"MAP_READS", ""}, {"TRANSLUCENT", ""}};
    if (samples > 1) {
        defines["SAMPLES"] = std::to_string(samples);
    }
    MapReads& out = access.write(reads);
    std::erase_if(out.of, [&](const auto& entry) {
        return std::none_of(parameters.bodies.begin(), parameters.bodies.end(),
                            [&](const Body& body) { return body.name == entry.first; });
    });
    for (const Body& body : parameters.bodies) {
        const ExitMaps& exits = access.read(body.exits);
        gl::Buffer& marks = out.of[body.name];
        const std::size_t bytes = std::max(1U, exits.words()) * sizeof(std::uint32_t);
        if (marks.bytes() != bytes) {
            marks = gl::Buffer("map reads", bytes);
        }
        const std::uint32_t unread = 0;
        glClearNamedBufferData(marks.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, &unread);
        marks.bind_storage(2);
        exits.bind_cameras();
        exits.depth.bind(0);
        defines["EXIT_MAPS"] = exits.room();
        gl::Program& program = shaders_.get("mesh/mesh.frag", defines);
        set_sample_places(program, samples);
        view.set(program, parameters.pixels);
        program.set("exit_depth", 0);
        program.set("last_texel", exits.depth.size().x - 1);
        program.set("row_words", int(exits.row_words()));
        set_body(program, body.body_from_model);
        const PlacedMesh& mesh = parameters.meshes[body.mesh];
        const MeshBuffers& buffers = access.read(mesh.buffers);
        view.place(program, mesh.world_from_model, buffers.middle_model);
        program.use();
        draw_all(buffers);
    }
    glFrontFace(GL_CCW);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    access.note(fmt::format("{} x {} pixels", parameters.pixels.x, parameters.pixels.y));
}

}  // namespace bruma::render
