#pragma once
#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"
#include "scene/mesh/mesh_parts.h"

/// Meshes and scenes for the stress suite 'mesh'; private to it.
namespace bruma::measure {

/// A ball of radius 10 around the origin, in the unit of its file; 240 triangles with exact normals.
scene::MeshParts ball_parts(double radius = 10.0, glm::dvec3 centre = glm::dvec3(0.0));
/// Three corners and one face each.
void add_triangle(scene::MeshParts& parts, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);
/// Small tetrahedra that do not touch, in a cube of 20.
scene::MeshParts many_pieces(int count);

std::shared_ptr<const scene::TriangleMesh> made(const scene::MeshParts& parts, double millimetres_per_unit = 1.0);

/// One mesh under parallel light of irradiance pi in black surroundings, seen whole. Translucent potato on small maps,
/// drawn in two passes.
scene::Scene mesh_scene(std::shared_ptr<const scene::TriangleMesh> mesh);
scene::Mesh& stress_mesh(scene::Scene& scene);
/// The same ball for all that asks for no other shape.
scene::Scene ball_scene();
void set_medium(scene::Scene& scene, const std::function<void(scene::SubsurfaceMedium&)>& change);
void set_sun(scene::Scene& scene, const scene::Light& light);

/// Radiance of a white surface in the default light is 1; no highlight and no model comes to this.
constexpr double most_radiance = 4.0;

/// Cases whose pictures are judged by themselves.
class MeshCases {
  public:
    explicit MeshCases(StressRig& rig) : rig_(rig) {}
    /// The brightest channel with each kind of surface: opaque and translucent by every model. Faults: radiance that is
    /// not finite or below 0, and a picture that takes more than half a minute.
    void sound(const std::string& name, const std::string& what, const std::function<scene::Scene()>& make,
               double most = most_radiance);
    /// Must throw one clear sentence for people.
    void refused(const std::string& name, const std::string& what, const std::function<void()>& act);
    /// `b` must show `b_over_a` times the radiance of `a`: largest difference as a share of the brightest channel.
    void same(const std::string& name, const std::string& what, double bound, const scene::Scene& a,
              const scene::Scene& b, double b_over_a = 1.0);
    StressRig& rig() { return rig_; }

  private:
    StressRig& rig_;
};

void stress_mesh_files(MeshCases& cases);
void stress_mesh_textures(MeshCases& cases);
void stress_mesh_shapes(MeshCases& cases, int pieces);
void stress_mesh_placement(MeshCases& cases);
void stress_mesh_matter(MeshCases& cases);
void stress_mesh_lamps(MeshCases& cases);
void stress_mesh_invariants(MeshCases& cases);

}  // namespace bruma::measure
