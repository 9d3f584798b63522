#include "render/mesh/mesh_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/view_rays.h"

namespace bruma::render {
namespace {

std::array<glm::dvec3, 8> corners_world(const glm::dmat4& world_from_model, const scene::TriangleMesh& mesh) {
    std::array<glm::dvec3, 8> corners;
    for (int n = 0; n < 8; ++n) {
        const glm::dvec4 p(n & 1 ? mesh.high.x : mesh.low.x, n & 2 ? mesh.high.y : mesh.low.y,
                           n & 4 ? mesh.high.z : mesh.low.z, 1.0);
        corners[std::size_t(n)] = world_from_model * p;
    }
    return corners;
}

}  // namespace

MeshView::MeshView(const scene::Camera& seen_from, double skipped_distance, const PassAccess& access,
                   const std::vector<PlacedMesh>& meshes)
    : camera(started_nearer(seen_from, skipped_distance)), frame(scene::camera_frame(camera)) {
    glm::dvec3 low(1e300), high(-1e300);
    double nearest = 1e300, farthest = -1e300;
    for (const PlacedMesh& mesh : meshes) {
        for (const glm::dvec3& p : corners_world(mesh.world_from_model, *access.read(mesh.triangles))) {
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
    near_plane_ = std::max(camera.near_distance, nearest - room) / unit_world;
    far_plane_ = (farthest + room) / unit_world;
    if (camera.projection == scene::Projection::perspective) {
        near_plane_ = std::max(near_plane_, std::max(1e-9 * far_plane_, 1e-30));
    }
    far_plane_ = std::max(far_plane_, near_plane_ + 1e-6 * std::abs(near_plane_) + 1e-30);
}

glm::vec2 MeshView::depth_of_z() const {
    if (camera.projection == scene::Projection::perspective) {
        return {0.0, near_plane_};  // near / -z: 0 only at infinity
    }
    const double length = far_plane_ - near_plane_;
    return {1.0 / length, far_plane_ / length};
}

void MeshView::set(gl::Program& program, glm::ivec2 pixels) const {
    program.set("pixels", glm::vec2(pixels));
    program.set("orthographic", camera.projection == scene::Projection::orthographic ? 1 : 0);
    program.set("half_view", glm::vec2(half_view(camera, pixels, unit_world)));
    program.set("depth_of_z", depth_of_z());
}

glm::dvec2 MeshView::pixel_size(glm::ivec2 pixels) const {
    const double width = 2.0 * half_view(camera, pixels, unit_world).y / pixels.y;
    return camera.projection == scene::Projection::orthographic ? glm::dvec2(width, 0.0) : glm::dvec2(0.0, width);
}

void MeshView::place(gl::Program& program, const glm::dmat4& world_from_model, glm::dvec3 middle_model) const {
    const glm::dmat3 linear(world_from_model);
    const glm::dmat3 camera_from_world =
        glm::transpose(glm::dmat3(frame.right_world, frame.up_world, frame.back_world)) / unit_world;
    // The eye is taken off in double, before anything is rounded.
    const glm::dvec3 middle_world = world_from_model * glm::dvec4(middle_model, 1.0);
    glm::dmat4 camera_from_model(camera_from_world * linear);
    camera_from_model[3] = glm::dvec4(camera_from_world * (middle_world - camera.eye_world), 1.0);
    program.set("camera_from_model", glm::mat4(camera_from_model));
    // Normals stay outside when a transform mirrors; which way round a triangle then runs does not.
    glm::dmat3 world_from_normal = glm::transpose(glm::inverse(linear));
    double largest = 0.0;
    for (int k = 0; k < 9; ++k) {
        largest = std::max(largest, std::abs(world_from_normal[k / 3][k % 3]));
    }
    program.set("world_from_normal", glm::mat3(world_from_normal / largest));
    glFrontFace(glm::determinant(linear) < 0.0 ? GL_CW : GL_CCW);
}

void MeshView::draw_depth(const PassAccess& access, gl::Program& program, const std::vector<PlacedMesh>& meshes) const {
    program.use();
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    for (const PlacedMesh& mesh : meshes) {
        const MeshBuffers& buffers = access.read(mesh.buffers);
        place(program, mesh.world_from_model, buffers.middle_model);
        draw_all(buffers);
    }
    glFrontFace(GL_CCW);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace bruma::render
