#pragma once
#include <vector>

#include "gl/program.h"
#include "render/mesh/mesh_passes.h"
#include "scene/camera.h"

/// Meshes before the camera, for passes that draw what it sees of them with mesh.vert.
namespace bruma::render {

/// A mesh in the world.
struct PlacedMesh {
    Handle<MeshPasses::Triangles> triangles;
    Handle<MeshBuffers> buffers;
    glm::dmat4 world_from_model{1.0};
    bool operator==(const PlacedMesh&) const = default;
};

/// Where meshes stand before the camera. Lengths are counted in a power of two of metres about as long as the meshes,
/// so that scenes of any size give numbers that floats and their squares can hold.
class MeshView {
  public:
    /// `skipped_distance`: metres, before parallel rays start.
    MeshView(const scene::Camera& camera, double skipped_distance, const PassAccess& access,
             const std::vector<PlacedMesh>& meshes);

    /// Uniforms of the view alone.
    void set(gl::Program& program, glm::ivec2 pixels) const;
    /// Uniforms of where a mesh stands, and which way round its triangles then run.
    void place(gl::Program& program, const glm::dmat4& world_from_model, glm::dvec3 middle_model) const;
    /// Width of a pixel at distance 0 and what it grows by per unit of distance, units.
    glm::dvec2 pixel_size(glm::ivec2 pixels) const;
    /// Draws depth alone; `program` is mesh.frag for that.
    void draw_depth(const PassAccess& access, gl::Program& program, const std::vector<PlacedMesh>& meshes) const;

    scene::Camera camera;  ///< as it looks: parallel rays may start nearer
    scene::CameraFrame frame;
    double unit_world = 1.0;  ///< metres

  private:
    glm::vec2 depth_of_z() const;
    double near_plane_ = 0.0, far_plane_ = 1.0;  ///< along the view axis, units
};

}  // namespace bruma::render
