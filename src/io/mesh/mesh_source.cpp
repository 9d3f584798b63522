#include "io/mesh/mesh_source.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/log.h"
#include "io/builtin_name.h"
#include "io/foreign_format.h"
#include "io/mesh/ascii_triangles.h"
#include "io/mesh/mesh_texture.h"
#include "io/mesh/obj_mesh.h"
#include "io/mesh/off_mesh.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::io {
namespace {

std::string ending_of(const std::string& file) {
    std::string ending = std::filesystem::path(file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

scene::LoadedMesh load_triangle_text(const std::filesystem::path& path, const scene::MeshSource& source,
                                     const Progress& progress) {
    auto found = read_ascii_triangles(path, progress);
    if (!found) {
        throw InputError(fmt::format(
            "{}: is no text of triangles (nine numbers a line), so it is no mesh; open it as a volume", path.string()));
    }
    scene::MeshParts parts;
    parts.name = path.stem().string();
    parts.where = path.string();
    parts.positions = std::move(found->corners);
    for (std::int32_t n = 0; n < std::int32_t(parts.positions.size()); n += 3) {
        parts.add_face(std::array<scene::FaceCorner, 3>{{{n}, {n + 1}, {n + 2}}}, 0);
    }
    scene::LoadedMesh loaded = scene::make_mesh(parts, source, 0.0);
    if (found->first_bad_line > 0) {
        loaded.remarks.push_back(fmt::format("{}: line {} is no triangle and was left out, as all like it: '{}'",
                                             path.string(), found->first_bad_line, found->first_bad_text));
    }
    return loaded;
}

scene::LoadedMesh load_by_kind(const scene::MeshSource& source, const Progress& progress) {
    if (is_builtin(source.file)) {
        return scene::builtin_mesh(builtin_name(source.file), source);
    }
    const std::string ending = ending_of(source.file);
    if (ending == ".obj") {
        return load_obj_mesh(source.file, source, progress);
    }
    if (ending == ".off") {
        return load_off_mesh(source.file, source, progress);
    }
    if (ending == ".raw") {
        return load_triangle_text(source.file, source, progress);
    }
    refuse_foreign_format(source.file);
    throw InputError(
        fmt::format("{}: is not read as a mesh; known are .obj, .off, .raw texts of triangles and "
                    "builtin:NAME",
                    source.file));
}

/// The mesh with one picture over all its parts.
std::shared_ptr<const scene::TriangleMesh> with_texture(const scene::TriangleMesh& mesh, const std::string& file) {
    auto textured = std::make_shared<scene::TriangleMesh>(mesh);
    const auto texture = load_texture(file);
    for (scene::MeshMaterial& material : textured->materials) {
        material.diffuse_texture = texture;
        material.placement = {};
    }
    return textured;
}

std::shared_ptr<const scene::TriangleMesh> known_triangles(const scene::Scene* known, const scene::MeshSource& source) {
    if (known == nullptr) {
        return nullptr;
    }
    for (const auto& [name, node] : known->nodes) {
        const auto* mesh = std::get_if<scene::Mesh>(&node.content);
        if (mesh != nullptr && scene::same_triangles(mesh->source, source) && *mesh->triangles) {
            return *mesh->triangles;
        }
    }
    return nullptr;
}

}  // namespace

bool is_mesh(const std::string& file) {
    if (is_builtin(file)) {
        const std::vector<std::string> names = scene::builtin_mesh_names();
        return std::find(names.begin(), names.end(), builtin_name(file)) != names.end();
    }
    const std::string ending = ending_of(file);
    return ending == ".obj" || ending == ".off" || (ending == ".raw" && holds_ascii_triangles(file));
}

scene::LoadedMesh load_mesh(const scene::MeshSource& source, const Progress& progress) {
    scene::LoadedMesh loaded = load_by_kind(source, progress);
    if (!source.texture.empty()) {
        loaded.mesh = with_texture(*loaded.mesh, source.texture);
        if (loaded.mesh->texture_coordinates.empty()) {
            loaded.remarks.push_back(fmt::format("{}: has no texture coordinates, so {} cannot be laid over it",
                                                 source.file, source.texture));
        }
    }
    if (progress) {
        progress(1.0, "reading " + std::filesystem::path(source.file).filename().string());
    }
    return loaded;
}

void log_remarks(const scene::MeshSource& source, const scene::LoadedMesh& loaded) {
    for (const std::string& remark : loaded.remarks) {
        log_line(LogLevel::warning, remark);
    }
    if (!source.millimetres_per_unit && !is_builtin(source.file)) {
        log_note("{}: one unit is {:g} mm ({}); mesh.source.millimetres_per_unit changes it", source.file,
                 loaded.unit.millimetres, loaded.unit.from);
    }
}

std::shared_ptr<const scene::TriangleMesh> load_triangles(const scene::MeshSource& source, const Progress& progress) {
    const scene::LoadedMesh loaded = load_mesh(source, progress);
    log_remarks(source, loaded);
    return loaded.mesh;
}

void load_missing_meshes(scene::Scene& scene, const scene::Scene* known, const Progress& progress) {
    for (auto& [name, node] : scene.nodes) {
        auto* mesh = std::get_if<scene::Mesh>(&node.content);
        if (mesh == nullptr || *mesh->triangles) {
            continue;
        }
        auto triangles = known_triangles(known, mesh->source);
        // Two nodes of one file share its triangles.
        triangles = triangles ? triangles : known_triangles(&scene, mesh->source);
        if (!triangles) {
            try {
                triangles = load_triangles(mesh->source, progress);
            } catch (const InputError& error) {
                throw InputError(fmt::format("nodes.{}.source: {}", name, error.what()));
            }
        }
        mesh->triangles = std::move(triangles);
    }
}

}  // namespace bruma::io
