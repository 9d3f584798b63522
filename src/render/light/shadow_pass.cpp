#include "render/light/shadow_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace bruma::render {
namespace {

/// Layout of light/shadow.glsl.
struct ShadowLampData {
    glm::vec4 eye{0.0F, 0.0F, 0.0F, -1.0F};
    MapFace faces[6];
};

/// The views of one lamp, in shadow space; none for a headlight.
std::vector<MapCamera> cameras_of(const scene::Light& light, const ShadowMaps& maps,
                                  const std::vector<glm::dvec3>& corners, int size) {
    if (light.kind == scene::LightKind::headlight) {
        return {};
    }
    if (light.kind == scene::LightKind::directional) {
        return {parallel_camera(corners, light.direction_world, size)};
    }
    const glm::dvec3 eye = (light.position_world - maps.center_world) / maps.unit_world;
    const double radius = bounding_radius(corners);
    if (glm::length(eye) > 1.25 * radius) {
        MapCamera camera = perspective_camera(corners, eye, size);
        return {camera};
    }
    if (light.kind == scene::LightKind::spot && light.spot_angle_deg < 60.0) {
        MapCamera camera = looking_against(light.direction_world);
        camera.perspective = true;
        camera.eye = eye;
        camera.high = glm::dvec2(std::tan(glm::radians(light.spot_angle_deg)) * size / std::max(1, size - 4));
        camera.low = -camera.high;
        camera.texel = (camera.high - camera.low) / double(size);
        camera.near_depth = 1e-3 * radius;
        camera.depth = glm::length(eye) + radius;
        return {camera};
    }
    std::vector<MapCamera> cube;
    cube.reserve(6);
    for (int face = 0; face < 6; ++face) {
        cube.push_back(cube_camera(eye, face, radius, size));
    }
    return cube;
}

}  // namespace

glm::dmat4 ShadowMaps::shadow_from_model(const glm::dmat4& world_from_model, glm::dvec3 middle_model) const {
    const glm::dvec3 middle_world = world_from_model * glm::dvec4(middle_model, 1.0);
    glm::dmat4 matrix(glm::dmat3(world_from_model) / unit_world);
    matrix[3] = glm::dvec4((middle_world - center_world) / unit_world, 1.0);
    return matrix;
}

ShadowPass::ShadowPass(FrameGraph& graph, gl::ShaderLibrary& shaders) : graph_(graph), shaders_(shaders) {
    shader_revision_ = graph.add_source<int>("shadow shaders");
    maps = graph.add_product<ShadowMaps>("shadow maps");
    pass_ = graph.add_pass({"shadow maps", "what each lamp sees of all meshes", {}, {maps.index}, {}});
}

void ShadowPass::remove() {
    graph_.remove_pass(pass_);
    graph_.remove_source(shader_revision_.index);
}

void ShadowPass::update(const scene::Scene& scene, const Meshes& meshes, const std::vector<scene::Light>& lights) {
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    Parameters parameters;
    parameters.size = int(scene.rendering->shadow_map_size);
    std::vector<int> reads{shader_revision_.index};
    for (const auto& [name, passes] : meshes) {
        parameters.casters.push_back({passes->triangles, passes->buffers, scene::world_from_model(scene, name)});
        reads.insert(reads.end(), {passes->triangles.index, passes->buffers.index});
    }
    for (scene::Light light : lights) {
        light.color = glm::dvec3(1.0);
        light.intensity = 1.0;
        parameters.lamps.push_back(light);
    }
    graph_.set_reads(pass_, reads);
    graph_.set_parameters(pass_, parameters);
    graph_.set_execute(pass_, [this, parameters](const PassAccess& access) { draw(access, parameters); });
}

void ShadowPass::draw(const PassAccess& access, const Parameters& parameters) {
    ShadowMaps& out = access.write(maps);
    std::vector<glm::dvec3> corners;
    for (const Caster& caster : parameters.casters) {
        const scene::TriangleMesh& mesh = *access.read(caster.triangles);
        for (int n = 0; n < 8; ++n) {
            const glm::dvec4 p(n & 1 ? mesh.high.x : mesh.low.x, n & 2 ? mesh.high.y : mesh.low.y,
                               n & 4 ? mesh.high.z : mesh.low.z, 1.0);
            corners.emplace_back(caster.world_from_model * p);
        }
    }
    glm::dvec3 low(1e300), high(-1e300);
    for (const glm::dvec3& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    out.center_world = 0.5 * (low + high);
    out.unit_world = std::exp2(std::floor(std::log2(std::max(glm::length(high - low), 1e-30))));
    for (glm::dvec3& corner : corners) {
        corner = (corner - out.center_world) / out.unit_world;
    }
    std::vector<ShadowLampData> data(std::max<std::size_t>(1, parameters.lamps.size()));
    std::vector<MapCamera> cameras;
    for (std::size_t n = 0; n < parameters.lamps.size(); ++n) {
        const std::vector<MapCamera> views = cameras_of(parameters.lamps[n], out, corners, parameters.size);
        for (std::size_t f = 0; f < views.size(); ++f) {
            const MapCamera& camera = views[f];
            data[n].eye = glm::vec4(camera.perspective ? camera.eye : glm::dvec3(0.0), views.size() > 1     ? 2.0
                                                                                       : camera.perspective ? 1.0
                                                                                                            : 0.0);
            data[n].faces[f] = map_face(camera, int(cameras.size()));
            cameras.push_back(camera);
        }
    }
    out.lamps = gl::Buffer("shadow lamps", std::span<const ShadowLampData>(data));
    const glm::ivec3 size(parameters.size, parameters.size, std::max<int>(1, int(cameras.size())));
    if (!out.depth || out.depth.size() != size) {
        out.depth = gl::Texture::make_2d_array("shadow depth", GL_DEPTH_COMPONENT32F, size);
        out.depth.set_nearest();
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    gl::Program& program = shaders_.get("light/shadow_map.frag");
    program.use();
    for (std::size_t n = 0; n < cameras.size(); ++n) {
        const gl::Framebuffer target("shadow map", {}, {&out.depth, int(n)});
        const float farthest = 1.0F;
        glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
        target.bind();
        for (const Caster& caster : parameters.casters) {
            const MeshBuffers& buffers = access.read(caster.buffers);
            program.set("clip_from_model",
                        glm::mat4(cameras[n].clip_from_body() *
                                  out.shadow_from_model(caster.world_from_model, buffers.middle_model)));
            draw_all(buffers);
        }
    }
    glDisable(GL_DEPTH_TEST);
    access.note(
        fmt::format("{} view{} of {} x {} texels", cameras.size(), cameras.size() == 1 ? "" : "s", size.x, size.y));
}

}  // namespace bruma::render
