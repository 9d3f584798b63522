#include "render/passes/opaque_pass.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.h"
#include "render/view_rays.h"

namespace bruma::render {
namespace {

void make_targets(OpaquePicture& picture, glm::ivec2 pixels) {
    if (!picture.radiance || glm::ivec2(picture.radiance.size()) != pixels) {
        picture.framebuffer = {};
        picture.radiance = gl::Texture::make_2d("opaque radiance", GL_RGBA32F, pixels);
        picture.distance = gl::Texture::make_2d("opaque distance", GL_R32F, pixels);
        picture.depth = gl::Texture::make_2d("opaque depth", GL_DEPTH_COMPONENT32F, pixels);
        picture.framebuffer = gl::Framebuffer("opaque", {&picture.radiance, &picture.distance}, &picture.depth);
    }
}

void clear(const OpaquePicture& picture) {
    const GLuint name = picture.framebuffer.name();
    const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
    const float far_away[4] = {1e30F, 0.0F, 0.0F, 0.0F};
    const float farthest = 0.0F;  // reversed
    glClearNamedFramebufferfv(name, GL_COLOR, 0, nothing);
    glClearNamedFramebufferfv(name, GL_COLOR, 1, far_away);
    glClearNamedFramebufferfv(name, GL_DEPTH, 0, &farthest);
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

int highlight_of(scene::MeshShading shading) {
    return shading == scene::MeshShading::phong ? 1 : shading == scene::MeshShading::blinn_phong ? 2 : 0;
}

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

void OpaquePass::update(const scene::Scene& scene, const Meshes& meshes, glm::ivec2 pixels, Handle<SkyLight> sky) {
    graph_.set_source(camera_, **scene.camera, scene.camera->revision());
    graph_.set_source(shader_revision_, 0, shaders_.revision());
    Parameters parameters{
        pixels, skipped_distance(**scene.camera, scene::world_bounds(scene)), {}, {}, *scene.environment, sky};
    std::vector<int> reads{camera_.index, shader_revision_.index};
    if (sky.index >= 0) {
        reads.push_back(sky.index);
    }
    for (const auto& [name, passes] : meshes) {
        const auto& mesh = std::get<scene::Mesh>(scene.nodes.at(name).content);
        MeshInput input{name,         passes->triangles, passes->buffers, {}, scene::world_from_model(scene, name),
                        *mesh.surface};
        reads.insert(reads.end(), {input.triangles.index, input.buffers.index});
        if (shows_texture(**mesh.triangles, *mesh.surface)) {
            input.textures = passes->textures;
            reads.push_back(input.textures.index);
        }
        if (input.surface.shading == scene::MeshShading::translucent && !said_translucent_) {
            said_translucent_ = true;
            log_warning("nodes.{}.shading: translucent is not drawn yet; this mesh is shaded as lambert", name);
        }
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

    gl::Defines defines;
    count_lights(defines, parameters.lights);
    if (parameters.sky.index >= 0) {
        defines["SKY_LIGHT"] = "";
        access.read(parameters.sky).buffer.bind_storage(sky_light_binding);
    }
    gl::Program& program = shaders_.get("mesh.frag", defines);
    program.set("pixels", glm::vec2(parameters.pixels));
    program.set("orthographic", stand.camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(stand.camera, parameters.pixels, stand.unit_world)));
    program.set("depth_of_z", stand.depth_of_z());
    program.set("world_from_camera",
                glm::mat3(glm::dmat3(stand.frame.right_world, stand.frame.up_world, stand.frame.back_world)));
    program.set("ambient", glm::vec3(parameters.environment.radiance));
    set_lights(program, parameters.lights, stand.camera, stand.unit_world);

    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_TRUE);
    program.use();
    std::size_t triangles = 0;
    for (const MeshInput& input : parameters.meshes) {
        draw_mesh(access, program, input, stand);
        triangles += access.read(input.triangles)->triangles.size();
    }
    glDisable(GL_DEPTH_TEST);
    access.note(fmt::format("{} x {} pixels, {} triangles of {} mesh{}", parameters.pixels.x, parameters.pixels.y,
                            triangles, parameters.meshes.size(), parameters.meshes.size() == 1 ? "" : "es"));
}

void OpaquePass::draw_mesh(const PassAccess& access, gl::Program& program, const MeshInput& input, const Stand& stand) {
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
    program.set("highlight", highlight_of(input.surface.shading));
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
