#include "render/mesh/mesh_passes.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace bruma::render {
namespace {

/// As shaders/mesh/mesh.vert reads it.
struct Vertex {
    glm::vec3 position, normal;
    glm::vec2 coordinate;
};

/// The corners of a triangle counter-clockwise on the side of its normals: files do mix the two up, and the side that a
/// rasteriser sees must be the side that is lit.
glm::uvec3 wound_as_lit(const scene::TriangleMesh& mesh, glm::uvec3 t) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    const glm::dvec3 lit(mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]);
    return glm::dot(glm::cross(b - a, c - a), lit) < 0.0 ? glm::uvec3(t.x, t.z, t.y) : t;
}

MeshBuffers upload(const scene::TriangleMesh& mesh) {
    MeshBuffers out;
    out.middle_model = 0.5 * (mesh.low + mesh.high);
    std::vector<Vertex> vertices;
    vertices.reserve(mesh.positions.size());
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
        vertices.push_back({glm::vec3(glm::dvec3(mesh.positions[n]) - out.middle_model), mesh.normals[n],
                            mesh.texture_coordinates.empty() ? glm::vec2(0.0F) : mesh.texture_coordinates[n]});
    }
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return mesh.triangle_materials[a] < mesh.triangle_materials[b];
    });
    std::vector<glm::uvec3> indices;
    indices.reserve(order.size());
    for (const std::uint32_t n : order) {
        const std::size_t material = mesh.triangle_materials[n];
        if (out.parts.empty() || out.parts.back().material != material) {
            out.parts.push_back({material, 3 * indices.size(), 0});
        }
        out.parts.back().count += 3;
        indices.push_back(wound_as_lit(mesh, mesh.triangles[n]));
    }
    out.vertices = gl::Buffer("mesh vertices", std::span<const Vertex>(vertices));
    out.indices = gl::Buffer("mesh indices", std::span<const glm::uvec3>(indices));
    out.array = gl::VertexArray("mesh");
    const GLuint array = out.array.name();
    glVertexArrayVertexBuffer(array, 0, out.vertices.name(), 0, sizeof(Vertex));
    glVertexArrayElementBuffer(array, out.indices.name());
    const auto attribute = [&](GLuint location, GLint size, std::size_t offset, GLuint buffer) {
        glEnableVertexArrayAttrib(array, location);
        glVertexArrayAttribFormat(array, location, size, GL_FLOAT, GL_FALSE, GLuint(offset));
        glVertexArrayAttribBinding(array, location, buffer);
    };
    attribute(0, 3, offsetof(Vertex, position), 0);
    attribute(1, 3, offsetof(Vertex, normal), 0);
    attribute(2, 2, offsetof(Vertex, coordinate), 0);
    if (!mesh.colors.empty()) {
        out.colors = gl::Buffer("mesh colours", std::span<const glm::vec3>(mesh.colors));
        glVertexArrayVertexBuffer(array, 1, out.colors.name(), 0, sizeof(glm::vec3));
        attribute(3, 3, 0, 1);
    }
    return out;
}

gl::Texture upload(const scene::MeshTexture& picture) {
    const bool deep = picture.bits == 16;
    gl::Texture texture = gl::Texture::make_2d_with_levels("mesh texture", deep ? GL_RGBA16F : GL_SRGB8_ALPHA8,
                                                           {picture.width, picture.height});
    if (deep) {
        // No format decodes sixteen bits of sRGB, so they are decoded here.
        std::vector<glm::vec4> linear;
        linear.reserve(std::size_t(picture.width) * std::size_t(picture.height));
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                linear.emplace_back(glm::vec3(picture.linear_color(x, y)), 1.0F);
            }
        }
        texture.upload({GL_RGBA, GL_FLOAT}, linear.data());
    } else {
        texture.upload({GL_RGBA, GL_UNSIGNED_BYTE}, picture.texels.data());
    }
    texture.set_repeat();
    texture.make_smaller_levels();
    return texture;
}

}  // namespace

void draw_all(const MeshBuffers& buffers) {
    std::size_t indices = 0;
    for (const MeshBuffers::Part& part : buffers.parts) {
        indices += part.count;
    }
    glBindVertexArray(buffers.array.name());
    glDrawElements(GL_TRIANGLES, GLsizei(indices), GL_UNSIGNED_INT, nullptr);
}

MeshPasses::MeshPasses(FrameGraph& graph, const std::string& name) : graph_(graph) {
    triangles = graph.add_source<Triangles>(name + ": triangles");
    buffers = graph.add_product<MeshBuffers>(name + ": buffers");
    textures = graph.add_product<MeshTextures>(name + ": textures");
    upload_ = graph.add_pass({name + ": upload",
                              "puts corners and triangles into buffers",
                              {triangles.index},
                              {buffers.index},
                              [this](const PassAccess& access) {
                                  const scene::TriangleMesh& mesh = *access.read(triangles);
                                  access.write(buffers) = upload(mesh);
                                  access.note(fmt::format("{} triangles", mesh.triangles.size()));
                              }});
    upload_textures_ =
        graph.add_pass({name + ": upload textures",
                        "puts the pictures of its materials into textures",
                        {triangles.index},
                        {textures.index},
                        [this](const PassAccess& access) {
                            MeshTextures& out = access.write(textures);
                            out.of.clear();
                            for (const scene::MeshMaterial& material : access.read(triangles)->materials) {
                                const scene::MeshTexture* picture = material.diffuse_texture.get();
                                if (picture != nullptr && !out.of.contains(picture)) {
                                    out.of.emplace(picture, upload(*picture));
                                }
                            }
                            access.note(fmt::format("{} pictures", out.of.size()));
                        }});
}

void MeshPasses::update(const scene::Mesh& mesh) {
    graph_.set_source(triangles, *mesh.triangles, mesh.triangles.revision());
}

void MeshPasses::remove() {
    graph_.remove_pass(upload_);
    graph_.remove_pass(upload_textures_);
    graph_.remove_source(triangles.index);
}

}  // namespace bruma::render
