#include "render/subsurface/translucent_maps.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace bruma::render {
namespace {

/// Layout of subsurface/exit_maps.glsl.
struct ExitCameraData {
    glm::vec4 right, up, back, size;
};

/// Nearer to the body than this, in bounding radii, the outer texels of one view would be too large beside those in the
/// middle, and a lamp sees it in six.
constexpr double nearest_one_view = 1.25;

bool sees_all_at_once(const BodyLamp& lamp, double radius) {
    return !lamp.has_position || glm::length(lamp.position) > nearest_one_view * radius;
}

std::vector<MapCamera> cameras_of(const BodyLamp& lamp, const std::vector<glm::dvec3>& points, double radius,
                                  int size) {
    if (!lamp.has_position) {
        return {parallel_camera(points, lamp.toward, size)};
    }
    if (sees_all_at_once(lamp, radius)) {
        return {perspective_camera(points, lamp.position, size)};
    }
    std::vector<MapCamera> cube;
    cube.reserve(6);
    for (int face = 0; face < 6; ++face) {
        cube.push_back(cube_camera(lamp.position, face, radius, size));
    }
    return cube;
}

/// Size of a texel where the body stands, mm.
double texel_mm(const MapCamera& camera) {
    const double distance = camera.perspective ? std::max(glm::length(camera.eye), camera.near_depth) : 1.0;
    return distance * std::max(camera.texel.x, camera.texel.y);
}

void start_drawing() {
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);  // of two surfaces in one place both are lit
    glDepthMask(GL_TRUE);
}

void draw_body(const SeenBody& body, gl::Program& program, const MapCamera& camera) {
    set_body(program, body.body_from_model);
    program.set("clip_from_body", glm::mat4(camera.clip_from_body()));
    program.use();
    draw_all(body.buffers);
}

/// Depth alone, so that what lies behind stays empty; also of what stands nearer to the lamp than the body's view.
void draw_shades(gl::ShaderLibrary& shaders, const std::vector<SeenShade>& shades, const MapCamera& camera) {
    if (shades.empty()) {
        return;
    }
    gl::Program& program = shaders.get("light/shadow_map.frag");
    program.use();
    glEnable(GL_DEPTH_CLAMP);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const SeenShade& shade : shades) {
        glm::dmat4 from_middle(1.0);
        from_middle[3] = glm::dvec4(shade.buffers.middle_model, 1.0);
        program.set("clip_from_model", glm::mat4(camera.clip_from_body() * shade.body_from_model * from_middle));
        draw_all(shade.buffers);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_DEPTH_CLAMP);
}

/// Which texels of one map see the body, read back once per shape so that no shader starts for those beside it. Returns
/// how many.
std::uint32_t append_texels(std::vector<std::uint32_t>& words, const gl::Texture& depth, int map,
                            std::vector<float>& depths) {
    const int edge = depth.size().x;
    glGetTextureSubImage(depth.name(), 0, 0, 0, map, edge, edge, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                         GLsizei(depths.size() * sizeof(float)), depths.data());
    std::uint32_t count = 0;
    for (int y = 0; y < edge; ++y) {
        for (int x = 0; x < edge; ++x) {
            if (x % 32 == 0) {
                words.push_back(0);
            }
            if (depths[std::size_t(y) * std::size_t(edge) + std::size_t(x)] < 1.0F) {
                words.back() |= 1U << (x % 32);
                ++count;
            }
        }
    }
    return count;
}

}  // namespace

void set_body(gl::Program& program, const glm::dmat3& body_from_model) {
    const glm::dmat3 normals = glm::transpose(glm::inverse(body_from_model));
    double largest = 1e-300;
    for (int k = 0; k < 9; ++k) {
        largest = std::max(largest, std::abs(normals[k / 3][k % 3]));
    }
    program.set("body_from_model", glm::mat3(body_from_model));
    program.set("body_from_normal", glm::mat3(normals / largest));
}

std::string draw_light_maps(LightMaps& out, gl::ShaderLibrary& shaders, const SeenBody& body,
                            const std::vector<SeenShade>& shades, const std::vector<BodyLamp>& lamps, double eta,
                            int size) {
    const std::vector<glm::dvec3> points = body_points(body.triangles, body.body_from_model);
    out.bounding_radius = bounding_radius(points);
    int layers = 0;
    for (const BodyLamp& lamp : lamps) {
        layers += sees_all_at_once(lamp, out.bounding_radius) ? 1 : 6;
    }
    const glm::ivec3 texels(size, size, std::max(1, layers));
    if (!out.points || out.points.size() != texels) {
        out.points = gl::Texture::make_2d_array("light points", GL_RGBA32F, texels);
        out.normals = gl::Texture::make_2d_array("light normals", GL_RG16, texels);
    }
    const gl::Texture depth = gl::Texture::make_2d("light depth", GL_DEPTH_COMPONENT32F, glm::ivec2(texels));
    start_drawing();
    gl::Program& program = shaders.get("subsurface/light_map.frag");
    program.set("eta", float(eta));
    out.lamps.clear();
    out.coarsest_texel_mm = 0.0;
    int layer = 0;
    for (const BodyLamp& lamp : lamps) {
        LightMaps::Drawn drawn{lamp, layer, cameras_of(lamp, points, out.bounding_radius, size)};
        program.set("has_position", lamp.has_position ? 1 : 0);
        program.set("lamp", glm::vec3(lamp.has_position ? lamp.position : lamp.toward));
        program.set("axis", glm::vec3(lamp.axis));
        program.set("cone", glm::vec2(lamp.cone));
        for (const MapCamera& camera : drawn.cameras) {
            const gl::Framebuffer target("light map", {{&out.points, layer}, {&out.normals, layer}}, {&depth});
            const float nothing[4] = {0.0F, 0.0F, 0.0F, 0.0F};
            const float farthest = 1.0F;
            glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, nothing);
            glClearNamedFramebufferfv(target.name(), GL_COLOR, 1, nothing);
            glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
            target.bind();
            draw_shades(shaders, shades, camera);
            draw_body(body, program, camera);
            out.coarsest_texel_mm = std::max(out.coarsest_texel_mm, texel_mm(camera));
            ++layer;
        }
        out.lamps.push_back(std::move(drawn));
    }
    glDisable(GL_DEPTH_TEST);
    return fmt::format("{} lamp{}, {} view{} of {} x {} texels, {:.3g} mm each", lamps.size(),
                       lamps.size() == 1 ? "" : "s", layer, layer == 1 ? "" : "s", size, size, out.coarsest_texel_mm);
}

std::string draw_exit_maps(ExitMaps& out, gl::ShaderLibrary& shaders, const SeenBody& body, int maps, int size) {
    const std::vector<glm::dvec3> points = body_points(body.triangles, body.body_from_model);
    const glm::ivec3 layers(size, size, std::max(1, maps));
    if (!out.depth || out.depth.size() != layers) {
        out.depth = gl::Texture::make_2d_array("exit depth", GL_DEPTH_COMPONENT32F, layers);
        out.depth.set_nearest();
        out.normals = gl::Texture::make_2d_array("exit normals", GL_RG16, layers);
    }
    start_drawing();
    gl::Program& program = shaders.get("subsurface/exit_map.frag");
    std::vector<ExitCameraData> cameras;
    std::vector<std::uint32_t> words;
    std::vector<float> depths(std::size_t(size) * std::size_t(size));
    out.texel_mm = 0.0;
    out.texel_count = 0;
    for (int map = 0; map < maps; ++map) {
        const MapCamera camera = parallel_camera(points, halton_direction(unsigned(map) + 1), size);
        const gl::Framebuffer target("exit map", {{&out.normals, map}}, {&out.depth, map});
        const float farthest = 1.0F;
        glClearNamedFramebufferfv(target.name(), GL_DEPTH, 0, &farthest);
        target.bind();
        program.set("toward_camera", glm::vec3(camera.back));
        draw_body(body, program, camera);
        cameras.push_back({glm::vec4(camera.right, camera.low.x), glm::vec4(camera.up, camera.low.y),
                           glm::vec4(camera.back, camera.near_depth), glm::vec4(camera.texel, camera.depth, 0.0)});
        out.texel_mm = std::max(out.texel_mm, std::max(camera.texel.x, camera.texel.y));
        out.texel_count += append_texels(words, out.depth, map, depths);
    }
    glDisable(GL_DEPTH_TEST);
    out.maps = maps;
    // Buffers are never empty.
    cameras.resize(32);  // as many as the shaders have room for
    words.push_back(0);
    out.cameras = gl::Buffer("exit cameras", std::span<const ExitCameraData>(cameras));
    out.see_body = gl::Buffer("exit texels", std::span<const std::uint32_t>(words));
    return fmt::format("{} maps of {} x {} texels, {:.3g} mm at most", maps, size, size, out.texel_mm);
}

}  // namespace bruma::render
