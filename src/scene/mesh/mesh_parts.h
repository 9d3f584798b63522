#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene/mesh/mesh.h"
#include "scene/mesh/mesh_report.h"
#include "scene/mesh/mesh_unit.h"

namespace bruma::scene {

/// A corner of a face: indices from 0 into the lists of MeshParts; negative where the file names none.
struct FaceCorner {
    std::int32_t position = -1, texture_coordinate = -1, normal = -1;
};

/// A mesh as a file lists it, in the unit of the file, while it is being read. Faces are checked and cut into triangles
/// as they arrive; what they may not name is left out and counted.
struct MeshParts {
    std::string name;                             ///< of the mesh, for people
    std::string where;                            ///< path or builtin:NAME; opens every message
    std::vector<glm::dvec3> positions;            ///< not finite where the file's numbers are none
    std::vector<glm::vec3> colors;                ///< linear, one per position or none at all
    std::vector<glm::dvec2> texture_coordinates;  ///< from the lower left corner of the picture
    std::vector<glm::dvec3> normals;              ///< of any length
    std::vector<std::array<FaceCorner, 3>> triangles;
    std::vector<std::uint32_t> triangle_materials;
    std::vector<MeshMaterial> materials;
    std::size_t faces = 0;                 ///< good ones
    std::size_t faces_of_few_corners = 0;  ///< less than three: left out
    std::size_t faces_out_of_range = 0;    ///< with a corner that does not exist: left out
    std::size_t faces_not_finite = 0;      ///< with a corner that is no finite number of single precision: left out
    std::size_t faces_too_tangled = 0;     ///< that were not cut within reason: left out
    std::string first_left_out;       ///< where the first such face stands in the file, as "line 7"; empty: not known
    std::size_t lost_attributes = 0;  ///< corners whose texture coordinate or normal does not exist, used without it

    enum class Verdict { good, few_corners, out_of_range, not_finite, too_tangled };
    /// Adds a face of any number of corners.
    Verdict add_face(std::span<const FaceCorner> corners, std::uint32_t material);

  private:
    std::vector<glm::dvec3> polygon_;
    std::vector<FaceCorner> checked_;
    std::vector<std::array<std::uint32_t, 3>> cut_;
};

/// A mesh with all that is to be said about it.
struct LoadedMesh {
    std::shared_ptr<const TriangleMesh> mesh;
    MeshReport report;  ///< of the triangles as the file has them, before anything was repaired
    UnitLength unit;
    std::size_t faces = 0;                ///< polygons of the file that were cut into triangles
    std::size_t texture_coordinates = 0;  ///< as listed
    std::size_t normals = 0;              ///< as listed
    std::vector<std::string> remarks;     ///< sentences a user should see; none of them stops anything
};

/// Makes a mesh of parts: metres, single precision, one index for corners that agree in everything. Where the mesh
/// stands further from the origin of its file than sixteen times its longest side, the middle of its box, strays left
/// aside, is taken off in double before anything is rounded (TriangleMesh::origin). Triangles without area are left
/// out; a closed surface that is inside out is turned round, an open one when most of its own normals ask for it;
/// missing normals are computed. Each repair is a remark. `said_unit_mm` is what the file itself tells of its unit, or
/// 0. Throws InputError when nothing remains to be shown or the unit makes coordinates too large.
LoadedMesh make_mesh(const MeshParts& parts, const MeshSource& source, double said_unit_mm);

/// The same mesh with another length of the file's unit.
void set_unit(LoadedMesh& loaded, UnitLength unit);

}  // namespace bruma::scene
