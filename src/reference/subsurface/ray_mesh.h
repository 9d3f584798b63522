#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace bruma::reference {

/// Triangles, counter-clockwise seen from outside. One unit of length for all of it, stated where it is used.
struct TriangleMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;  ///< unit, outward, one per position; empty: faces are flat
    std::vector<glm::uvec3> triangles;
};

/// A point of a mesh met by a ray.
struct MeshHit {
    double t = 0.0;                    ///< along the ray's direction
    std::uint32_t triangle = 0;        ///< index into TriangleMesh::triangles
    glm::dvec2 barycentric{0.0};       ///< weights of the second and third corner
    glm::dvec3 position{0.0};          ///< on the triangle's plane to double precision
    glm::dvec3 geometric_normal{0.0};  ///< unit, outward by winding
    glm::dvec3 shading_normal{0.0};    ///< unit, interpolated; the geometric one where the mesh has none
};

/// A mesh made ready for rays. Traversal is Embree's, in float on a copy scaled to unit size, so that meshes of 1e-6
/// and of 1e6 do equally well; what is found is worked out again in double. May be used from several threads.
class RayMesh {
  public:
    /// Throws InputError for a mesh without triangles, with an index out of range or with a coordinate that is not
    /// finite, MachineError where Embree cannot start. Triangles without area are never hit.
    explicit RayMesh(TriangleMesh mesh);

    /// The first hit from `origin` along the unit vector `direction`, between `surface_offset()` and `limit`.
    std::optional<MeshHit> first_hit(glm::dvec3 origin, glm::dvec3 direction, double limit = 1e300) const;
    /// Whether anything lies between, with the same offset at the origin's end and none at the other.
    bool blocked(glm::dvec3 origin, glm::dvec3 direction, double limit = 1e300) const;

    const TriangleMesh& mesh() const { return mesh_; }
    glm::dvec3 bounding_centre() const { return centre_; }
    double bounding_radius() const { return radius_; }
    /// How far a ray must have gone before it may hit, in mesh units: 4e-6 of the bounding radius, some sixty roundings
    /// of the float copy.
    double surface_offset() const { return 4e-6 * radius_; }
    /// Twice the area times the outward normal of a triangle.
    glm::dvec3 area_vector(std::uint32_t triangle) const;
    /// Position and interpolated normal at barycentric weights of the second and third corner.
    glm::dvec3 position_at(std::uint32_t triangle, glm::dvec2 barycentric) const;
    glm::dvec3 normal_at(std::uint32_t triangle, glm::dvec2 barycentric) const;

  private:
    struct Traversal;
    TriangleMesh mesh_;
    glm::dvec3 centre_{0.0};
    double radius_ = 0.0;
    std::shared_ptr<const Traversal> traversal_;
};

}  // namespace bruma::reference
