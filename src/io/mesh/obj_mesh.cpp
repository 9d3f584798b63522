#include "io/mesh/obj_mesh.h"

#include <fmt/core.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <limits>
#include <set>
#include <span>
#include <streambuf>

#include "io/mesh/obj_materials.h"
#include "io/mesh/obj_text.h"

namespace bruma::io {
namespace {

/// Hands out a text in pieces and tells how far it is.
class TextInPieces : public std::streambuf {
  public:
    TextInPieces(std::string& text, const Progress& progress, std::string what)
        : text_(text), progress_(progress), what_(std::move(what)) {}

  protected:
    int_type underflow() override {
        constexpr std::size_t piece_bytes = 1 << 20;
        if (progress_ && !text_.empty()) {
            progress_(double(handed_out_) / double(text_.size()), what_);
        }
        if (handed_out_ == text_.size()) {
            return traits_type::eof();
        }
        char* const from = text_.data() + handed_out_;
        const std::size_t length = std::min(piece_bytes, text_.size() - handed_out_);
        setg(from, from, from + length);
        handed_out_ += length;
        return traits_type::to_int_type(*from);
    }

  private:
    std::string& text_;
    const Progress& progress_;
    std::string what_;
    std::size_t handed_out_ = 0;
};

/// The receiving end of the parser's callbacks. Faces are kept until all is read: they may name what comes later.
struct Receiver {
    const ObjText& text;
    const ObjMaterials& materials;
    scene::MeshParts parts;
    std::vector<scene::FaceCorner> corners;  ///< of all faces, one after the other
    std::vector<std::size_t> face_ends;
    std::vector<std::uint32_t> face_materials;
    std::uint32_t material;
    std::set<std::string> unknown_materials;

    Receiver(const ObjText& obj, const ObjMaterials& known)
        : text(obj), materials(known), material(default_material()) {}
    /// Behind those of the file.
    std::uint32_t default_material() const { return std::uint32_t(materials.materials.size()); }
};

Receiver& receiver(void* user) {
    return *static_cast<Receiver*>(user);
}

bool is_among(const std::vector<std::size_t>& ordinals, std::size_t ordinal) {
    return std::binary_search(ordinals.begin(), ordinals.end(), ordinal);
}

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

void take_vertex(void* user, double x, double y, double z, double) {
    Receiver& to = receiver(user);
    const bool broken = is_among(to.text.broken_vertices, to.parts.positions.size());
    to.parts.positions.push_back(broken ? glm::dvec3(no_number) : glm::dvec3(x, y, z));
}
void take_normal(void* user, double x, double y, double z) {
    Receiver& to = receiver(user);
    const bool broken = is_among(to.text.broken_normals, to.parts.normals.size());
    to.parts.normals.push_back(broken ? glm::dvec3(no_number) : glm::dvec3(x, y, z));
}
void take_coordinate(void* user, double u, double v, double) {
    Receiver& to = receiver(user);
    const bool broken = is_among(to.text.broken_coordinates, to.parts.texture_coordinates.size());
    to.parts.texture_coordinates.push_back(broken ? glm::dvec2(no_number) : glm::dvec2(u, v));
}

/// Index from 0 of what a face means: counted from 1, or backwards from the last one read so far; -1 for 0.
std::int32_t from_zero(int index, std::size_t so_far) {
    constexpr std::int64_t none = -1;
    return std::int32_t(index > 0 ? index - 1 : index < 0 ? std::max(none, std::int64_t(so_far) + index) : none);
}

void take_face(void* user, tinyobj::index_t* indices, int count) {
    Receiver& to = receiver(user);
    for (const tinyobj::index_t& index : std::span(indices, std::size_t(count))) {
        to.corners.push_back({from_zero(index.vertex_index, to.parts.positions.size()),
                              from_zero(index.texcoord_index, to.parts.texture_coordinates.size()),
                              from_zero(index.normal_index, to.parts.normals.size())});
    }
    to.face_ends.push_back(to.corners.size());
    to.face_materials.push_back(to.material);
}

void take_material(void* user, const char* text, int) {
    Receiver& to = receiver(user);
    std::string name(text);
    name.erase(0, name.find_first_not_of(" \t"));
    name.erase(name.find_last_not_of(" \t\r") + 1);
    const std::uint32_t* const found = to.materials.find(name);
    to.material = found != nullptr ? *found : to.default_material();
    if (found == nullptr) {
        to.unknown_materials.insert(name);
    }
}

/// Adds the faces that were kept, and notes where the first one stands that is left out.
void add_faces(Receiver& from) {
    std::size_t begin = 0;
    for (std::size_t n = 0; n < from.face_ends.size(); ++n) {
        const auto corners = std::span(from.corners).subspan(begin, from.face_ends[n] - begin);
        begin = from.face_ends[n];
        const auto verdict = from.parts.add_face(corners, from.face_materials[n]);
        if (verdict != scene::MeshParts::Verdict::good && from.parts.first_left_out.empty()) {
            from.parts.first_left_out = fmt::format("line {}", line_of_statement(from.text.text, "f", n));
        }
    }
}

bool names_a_texture(const scene::TriangleMesh& mesh) {
    return std::any_of(mesh.triangle_materials.begin(), mesh.triangle_materials.end(),
                       [&](std::uint32_t material) { return mesh.materials[material].diffuse_texture != nullptr; });
}

std::string unknown_materials_remark(const std::set<std::string>& names, const std::string& where) {
    std::string list;
    std::size_t shown = 0;
    for (const std::string& name : names) {
        constexpr std::size_t most = 5;
        list += shown < most ? (shown == 0 ? "'" : ", '") + name + "'" : shown == most ? " and others" : "";
        ++shown;
    }
    return fmt::format("{}: uses material{} {}, which no library describes; the default one stands in", where,
                       names.size() == 1 ? "" : "s", list);
}

}  // namespace

scene::LoadedMesh load_obj_mesh(const std::filesystem::path& path, const scene::MeshSource& source,
                                const Progress& progress) {
    ObjText obj = read_obj_text(path);
    ObjMaterials materials = read_obj_materials(path, obj.material_libraries);
    Receiver to(obj, materials);
    to.parts.name = path.stem().string();
    to.parts.where = path.string();

    tinyobj::callback_t callback;
    callback.vertex_cb = take_vertex;
    callback.normal_cb = take_normal;
    callback.texcoord_cb = take_coordinate;
    callback.index_cb = take_face;
    callback.usemtl_cb = take_material;
    TextInPieces pieces(obj.text, progress, "reading " + path.filename().string());
    std::istream stream(&pieces);
    // Lets through what `progress` throws.
    stream.exceptions(std::ios::badbit);
    tinyobj::LoadObjWithCallback(stream, callback, &to);

    add_faces(to);
    to.parts.colors = obj.colors.linear(to.parts.positions.size());
    to.parts.materials = std::move(materials.materials);
    const std::size_t named = to.parts.materials.size();
    const auto& used = to.parts.triangle_materials;
    if (std::find(used.begin(), used.end(), named) != used.end()) {
        to.parts.materials.emplace_back();
    }
    scene::LoadedMesh loaded = scene::make_mesh(to.parts, source, obj.unit_mm);
    if (const std::string others = obj.others.remark(!to.parts.normals.empty()); !others.empty()) {
        loaded.remarks.push_back(fmt::format("{}: tells more than is drawn: {}", path.string(), others));
    }
    loaded.remarks.insert(loaded.remarks.end(), materials.remarks.begin(), materials.remarks.end());
    if (loaded.mesh->texture_coordinates.empty() && names_a_texture(*loaded.mesh)) {
        loaded.remarks.push_back(
            fmt::format("{}: has no texture coordinates (vt), so the textures of its materials cannot be laid over it",
                        path.string()));
    }
    if (!to.unknown_materials.empty()) {
        loaded.remarks.push_back(unknown_materials_remark(to.unknown_materials, path.string()));
    }
    return loaded;
}

}  // namespace bruma::io
