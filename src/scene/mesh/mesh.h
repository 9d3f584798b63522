#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/revision.h"
#include "scene/mesh/mesh_data.h"
#include "scene/subsurface/material.h"
#include "scene/subsurface/subsurface.h"

namespace bruma::scene {

/// Which normals a mesh is lit by.
enum class MeshNormals { file, computed };
template <>
inline std::span<const std::string_view> enum_words<MeshNormals>() {
    static constexpr std::array<std::string_view, 2> words{"file", "computed"};
    return words;
}

/// Where a mesh's triangles come from, and what its file does not say.
struct MeshSource {
    std::string file;  ///< path (relative to the scene file when read from one) or builtin:NAME
    std::optional<double> millimetres_per_unit = {};  ///< empty: as the file says, or proposed from its size
    MeshNormals normals = MeshNormals::file;
    double crease_angle_deg = 60.0;         ///< computed normals: edges that bend more than this stay sharp
    std::string texture = {};               ///< path of a picture for all of it; empty: those that the file names
    std::optional<glm::dvec3> origin = {};  ///< units of the file: the place in it that the node's transform moves
    bool operator==(const MeshSource&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, MeshSource>
void visit_fields(Self& source, Visitor&& visit) {
    visit(Field{.name = "file", .sentence = "path of the triangles, relative to the scene file, or builtin:NAME"},
          source.file);
    visit(Field{.name = "millimetres_per_unit",
                .unit = "mm",
                .sentence = "length of one unit of the file; null: as the file says, or proposed from its size",
                .min = 1e-12,
                .max = 1e12,
                .logarithmic = true},
          source.millimetres_per_unit);
    visit(Field{.name = "normals", .sentence = "file: its own where it has any; computed: always from the triangles"},
          source.normals);
    visit(Field{.name = "crease_angle",
                .unit = "deg",
                .sentence = "edges that bend more than this stay sharp where normals are computed",
                .min = 0.0,
                .max = 180.0,
                .panel_max = 180.0},
          source.crease_angle_deg);
    visit(Field{.name = "texture", .sentence = "path of a picture for all of it; empty: those that the file names"},
          source.texture);
    visit(Field{.name = "origin",
                .sentence = "the place in the file, in its units, that stands where the transform says; null: its 0"},
          source.origin);
}

/// How light leaves the surface.
enum class MeshShading { lambert, phong, blinn_phong, translucent };
template <>
inline std::span<const std::string_view> enum_words<MeshShading>() {
    static constexpr std::array<std::string_view, 4> words{"lambert", "phong", "blinn_phong", "translucent"};
    return words;
}

/// How a mesh is shown.
struct MeshSurface {
    MeshShading shading = MeshShading::blinn_phong;
    bool file_materials = true;            ///< colours and highlights as the file says, where it has materials
    glm::dvec3 diffuse_color{0.8};         ///< linear Rec.709; where the file has no materials
    bool textured = true;                  ///< multiply the colour by textures
    double specular = 0.2;                 ///< strength of the highlight, in the light's colour
    double shininess = 30.0;               ///< exponent of the highlight
    Material material = Material::marble;  ///< translucent: what is inside
    SubsurfaceMedium custom_medium = medium_of(Material::marble);  ///< read when `material` is `custom`
    bool operator==(const MeshSurface&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, MeshSurface>
void visit_fields(Self& surface, Visitor&& visit) {
    visit(Field{.name = "shading",
                .sentence = "lambert, phong, blinn_phong: opaque; translucent: light wanders inside before it leaves"},
          surface.shading);
    visit(
        Field{.name = "file_materials", .sentence = "colours and highlights as the file says, where it has materials"},
        surface.file_materials);
    visit(Field{.name = "diffuse_color",
                .sentence = "linear colour where the file has no materials",
                .min = 0.0,
                .max = 1.0,
                .is_color = true},
          surface.diffuse_color);
    visit(Field{.name = "textured", .sentence = "multiply the colour by textures"}, surface.textured);
    visit(Field{.name = "specular",
                .sentence = "strength of the highlight where the file has no materials",
                .min = 0.0,
                .max = 10.0,
                .panel_max = 1.0},
          surface.specular);
    visit(Field{.name = "shininess",
                .sentence = "exponent of the highlight: larger is smaller and sharper",
                .min = 1.0,
                .max = 1000.0,
                .panel_min = 1.0,
                .panel_max = 200.0,
                .logarithmic = true},
          surface.shininess);
    visit(Field{.name = "material", .sentence = "translucent: the matter inside; custom: by its coefficients"},
          surface.material);
    visit_fields(surface.custom_medium, visit);
}

/// Whether two sources give the same triangles: `origin` only says where these stand.
bool same_triangles(const MeshSource& a, const MeshSource& b);

/// A surface and how it is shown. Model space: metres from the origin of its triangles.
struct Mesh {
    MeshSource source;
    Tracked<std::shared_ptr<const TriangleMesh>> triangles;  ///< never null in a scene that is ready to render
    Tracked<MeshSurface> surface;
    Tracked<SubsurfaceSettings> subsurface;  ///< translucent
};

/// What model space is shifted by before the node's transform moves it, metres.
glm::dvec3 shift_of(const Mesh& mesh);

/// The matter inside a translucent surface: by name, or its own coefficients.
SubsurfaceMedium medium_of(const MeshSurface& surface);

/// What part `index` of a mesh's materials looks like under a surface: the file's own colours, or the surface's.
MeshMaterial shown_material(const TriangleMesh& mesh, const MeshSurface& surface, std::size_t index);

}  // namespace bruma::scene
