#include "scene/mesh/mesh_parts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "scene/mesh/mesh_normals.h"
#include "scene/mesh/mesh_polygon.h"
#include "scene/mesh/mesh_strays.h"
#include "scene/mesh/mesh_weld.h"

namespace bruma::scene {
namespace {

/// Whether single precision holds it; false for NaN.
bool is_finite(const glm::dvec3& p) {
    constexpr double most = std::numeric_limits<float>::max();
    return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
}

/// Zero for numbers that no texture lookup can use.
glm::dvec2 usable(const glm::dvec2& coordinate) {
    constexpr double most = 1e6;
    return std::abs(coordinate.x) <= most && std::abs(coordinate.y) <= most ? coordinate : glm::dvec2(0.0);
}

std::string counted(std::size_t count, std::string_view thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// The triangles that are kept: corners by lists in which equal things have one index.
struct CleanTriangles {
    std::vector<glm::dvec3> positions;  ///< metres, rounded to single precision
    std::vector<glm::uvec3> triangles;  ///< into `positions`
    std::vector<std::array<FaceCorner, 3>> corners;
    std::vector<std::uint32_t> materials;
};

/// What coordinates are counted from, in the unit of the file: 0 where that leaves them nearly as fine as floats about
/// the middle would be, so that they stay the numbers of the file.
glm::dvec3 origin_of(const MeshCore& core) {
    const glm::dvec3 middle = 0.5 * core.low + 0.5 * core.high;
    const glm::dvec3 sides = core.high - core.low;
    const glm::dvec3 away = glm::abs(middle);
    const bool far = std::max({away.x, away.y, away.z}) > 16.0 * std::max({sides.x, sides.y, sides.z});
    return far ? middle : glm::dvec3(0.0);
}

std::vector<glm::dvec3> rounded_metres(const MeshParts& parts, double millimetres_per_unit, glm::dvec3 origin) {
    std::vector<glm::dvec3> metres;
    metres.reserve(parts.positions.size());
    for (const glm::dvec3& p : parts.positions) {
        metres.emplace_back(glm::vec3(1e-3 * millimetres_per_unit * (p - origin)));
    }
    return metres;
}

CleanTriangles clean(const MeshParts& parts, double millimetres_per_unit, glm::dvec3 origin) {
    CleanTriangles kept;
    kept.positions = rounded_metres(parts, millimetres_per_unit, origin);
    const std::vector<std::uint32_t> first = first_equal(kept.positions);
    kept.triangles.reserve(parts.triangles.size());
    kept.corners.reserve(parts.triangles.size());
    kept.materials.reserve(parts.triangles.size());
    for (std::size_t n = 0; n < parts.triangles.size(); ++n) {
        const auto& corners = parts.triangles[n];
        const glm::uvec3 t(first[std::size_t(corners[0].position)], first[std::size_t(corners[1].position)],
                           first[std::size_t(corners[2].position)]);
        const glm::dvec3& a = kept.positions[t.x];
        const glm::dvec3& b = kept.positions[t.y];
        const glm::dvec3& c = kept.positions[t.z];
        if (!is_finite(a) || !is_finite(b) || !is_finite(c)) {
            throw InputError(
                fmt::format("{}: with {:g} mm to the unit its coordinates are too large for single precision; choose a "
                            "smaller millimetres_per_unit",
                            parts.where, millimetres_per_unit));
        }
        if (glm::length(glm::cross(b - a, c - a)) > 0.0) {
            kept.triangles.push_back(t);
            kept.corners.push_back(corners);
            kept.materials.push_back(parts.triangle_materials[n]);
        }
    }
    return kept;
}

void turn_round(CleanTriangles& kept) {
    for (std::size_t n = 0; n < kept.triangles.size(); ++n) {
        std::swap(kept.triangles[n].y, kept.triangles[n].z);
        std::swap(kept.corners[n][1], kept.corners[n][2]);
    }
}

/// Positive when the triangles run counter-clockwise seen from where their own normals point, by area; 0 without any.
double agreement_with(const CleanTriangles& kept, const std::vector<glm::dvec3>& normals) {
    double agreement = 0.0;
    for (std::size_t n = 0; n < kept.triangles.size(); ++n) {
        const glm::uvec3& t = kept.triangles[n];
        const glm::dvec3 area =
            glm::cross(kept.positions[t.y] - kept.positions[t.x], kept.positions[t.z] - kept.positions[t.x]);
        for (const FaceCorner& corner : kept.corners[n]) {
            agreement += corner.normal >= 0 ? glm::dot(area, normals[std::size_t(corner.normal)]) : 0.0;
        }
    }
    return agreement;
}

/// The unit normals of the file, if they are wanted. Corners lose their index to what is no direction, and equal
/// normals get one index.
std::vector<glm::dvec3> file_normals(CleanTriangles& kept, const MeshParts& parts, const MeshSource& source) {
    std::vector<glm::dvec3> normals(parts.normals.size());
    std::vector<char> is_good(parts.normals.size(), 0);
    for (std::size_t n = 0; n < parts.normals.size(); ++n) {
        const double length = glm::length(parts.normals[n]);
        is_good[n] = std::isfinite(length) && length > 0.0 && source.normals == MeshNormals::file ? 1 : 0;
        normals[n] = is_good[n] != 0 ? parts.normals[n] / length : glm::dvec3(0.0);
    }
    const std::vector<std::uint32_t> first = first_equal(normals);
    for (auto& corners : kept.corners) {
        for (FaceCorner& corner : corners) {
            const bool good = corner.normal >= 0 && is_good[std::size_t(corner.normal)] != 0;
            corner.normal = good ? std::int32_t(first[std::size_t(corner.normal)]) : -1;
        }
    }
    return normals;
}

/// Lets triangles and normals agree on which side is out. A closed surface has an inside; of an open one the file's
/// normals know more than the order of its corners.
void settle_orientation(CleanTriangles& kept, std::vector<glm::dvec3>& normals, const MeshReport& report,
                        const std::string& where, std::vector<std::string>& remarks) {
    double agreement = agreement_with(kept, normals);
    if (report.closed() ? report.inside_out() : agreement < 0.0) {
        turn_round(kept);
        agreement = -agreement;
        remarks.push_back(fmt::format("{}: {}; its triangles were turned round", where,
                                      report.closed() ? "closed, but inside out" : "runs against its own normals"));
    }
    if (agreement < 0.0) {
        for (glm::dvec3& normal : normals) {
            normal = -normal;
        }
        remarks.push_back(fmt::format("{}: its normals point inwards and were turned round", where));
    }
}

/// Puts computed normals behind those of the file, for the corners that have none.
void complete_normals(CleanTriangles& kept, std::vector<glm::dvec3>& normals, double crease_angle_deg) {
    const auto complete = [](const std::array<FaceCorner, 3>& corners) {
        return corners[0].normal >= 0 && corners[1].normal >= 0 && corners[2].normal >= 0;
    };
    if (std::all_of(kept.corners.begin(), kept.corners.end(), complete)) {
        return;
    }
    const CornerNormals computed = smooth_normals(kept.positions, kept.triangles, crease_angle_deg);
    const auto offset = std::int32_t(normals.size());
    normals.insert(normals.end(), computed.normals.begin(), computed.normals.end());
    for (std::size_t n = 0; n < kept.corners.size(); ++n) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (kept.corners[n][k].normal < 0) {
                kept.corners[n][k].normal = offset + std::int32_t(computed.corner_normal[3 * n + k]);
            }
        }
    }
}

/// Gives one index to corners that agree in everything: a short list of known vertices hangs on each position.
class VertexList {
  public:
    VertexList(TriangleMesh& mesh, const CleanTriangles& kept, const MeshParts& parts,
               const std::vector<glm::dvec3>& normals)
        : mesh_(mesh), kept_(kept), parts_(parts), normals_(normals), newest_(kept.positions.size(), none) {
        std::vector<glm::dvec3> coordinates;
        coordinates.reserve(parts.texture_coordinates.size());
        for (const glm::dvec2& coordinate : parts.texture_coordinates) {
            coordinates.emplace_back(usable(coordinate), 0.0);
        }
        first_coordinate_ = first_equal(coordinates);
        first_color_ = first_equal(std::vector<glm::dvec3>(parts.colors.begin(), parts.colors.end()));
    }

    std::uint32_t index_of(std::uint32_t position, FaceCorner corner) {
        if (corner.texture_coordinate >= 0) {
            corner.texture_coordinate = std::int32_t(first_coordinate_[std::size_t(corner.texture_coordinate)]);
        }
        // Vertices at one place may differ in their colours.
        const std::uint32_t color = first_color_.empty() ? 0 : first_color_[std::size_t(corner.position)];
        for (std::uint32_t n = newest_[position]; n != none; n = known_[n].older) {
            if (known_[n].texture_coordinate == corner.texture_coordinate && known_[n].normal == corner.normal &&
                known_[n].color == color) {
                return n;
            }
        }
        const auto index = std::uint32_t(known_.size());
        known_.push_back({corner.texture_coordinate, corner.normal, color, newest_[position]});
        newest_[position] = index;
        mesh_.positions.emplace_back(kept_.positions[position]);
        mesh_.normals.emplace_back(normals_[std::size_t(corner.normal)]);
        if (!parts_.colors.empty()) {
            mesh_.colors.push_back(parts_.colors[color]);
        }
        if (!parts_.texture_coordinates.empty()) {
            mesh_.texture_coordinates.emplace_back(
                corner.texture_coordinate >= 0
                    ? usable(parts_.texture_coordinates[std::size_t(corner.texture_coordinate)])
                    : glm::dvec2(0.0));
        }
        return index;
    }

  private:
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    struct Known {
        std::int32_t texture_coordinate, normal;
        std::uint32_t color, older;
    };
    TriangleMesh& mesh_;
    const CleanTriangles& kept_;
    const MeshParts& parts_;
    const std::vector<glm::dvec3>& normals_;
    std::vector<std::uint32_t> newest_, first_coordinate_, first_color_;
    std::vector<Known> known_;
};

std::shared_ptr<TriangleMesh> indexed(CleanTriangles& kept, const MeshParts& parts,
                                      const std::vector<glm::dvec3>& normals) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->name = parts.name;
    VertexList vertices(*mesh, kept, parts, normals);
    mesh->triangles.reserve(kept.triangles.size());
    for (std::size_t n = 0; n < kept.triangles.size(); ++n) {
        glm::uvec3 t(0);
        for (int k = 0; k < 3; ++k) {
            t[k] = vertices.index_of(kept.triangles[n][k], kept.corners[n][std::size_t(k)]);
        }
        mesh->triangles.push_back(t);
    }
    mesh->triangle_materials = std::move(kept.materials);
    mesh->materials = parts.materials;
    if (mesh->materials.empty()) {
        mesh->materials.emplace_back();
    }
    mesh->low = mesh->high = mesh->positions.front();
    for (const glm::vec3& p : mesh->positions) {
        mesh->low = glm::min(mesh->low, glm::dvec3(p));
        mesh->high = glm::max(mesh->high, glm::dvec3(p));
    }
    return mesh;
}

void remark_losses(const MeshParts& parts, std::vector<std::string>& remarks) {
    const auto say = [&](std::size_t count, std::string_view what) {
        if (count > 0) {
            remarks.push_back(fmt::format("{}: {} {}", parts.where, counted(count, "face"), what));
        }
    };
    say(parts.faces_of_few_corners, "with less than three corners left out");
    say(parts.faces_out_of_range, "with vertices that do not exist left out");
    say(parts.faces_not_finite, "with vertices that are no finite numbers up to 3.4e38 left out");
    say(parts.faces_too_tangled, "whose outlines cross themselves too often to be cut left out");
    if (!parts.first_left_out.empty()) {
        remarks.push_back(
            fmt::format("{}: the first face that was left out stands in {}", parts.where, parts.first_left_out));
    }
    if (parts.lost_attributes > 0) {
        remarks.push_back(fmt::format("{}: {} named texture coordinates or normals that do not exist, and do without",
                                      parts.where, counted(parts.lost_attributes, "corner")));
    }
}

std::string nothing_to_show(const MeshParts& parts) {
    std::string lost;
    const auto add = [&](std::size_t count, std::string_view what) {
        if (count > 0) {
            lost += fmt::format("{}{} {}", lost.empty() ? "" : ", ", count, what);
        }
    };
    add(parts.faces_of_few_corners, "with less than three corners");
    add(parts.faces_out_of_range, "with corners that do not exist");
    add(parts.faces_not_finite, "with corners that are no finite numbers up to 3.4e38");
    add(parts.faces_too_tangled, "whose outlines cross themselves too often to be cut");
    if (lost.empty()) {
        return fmt::format(
            "{}: holds no faces, so there is nothing to show; found {}, and lines and points are not drawn; export it "
            "with its faces",
            parts.where, counted(parts.positions.size(), "vertex position"));
    }
    return fmt::format("{}: none of its faces can be shown: {}{}; is the file complete?", parts.where, lost,
                       parts.first_left_out.empty() ? "" : ", the first in " + parts.first_left_out);
}

std::vector<glm::uvec3> triangles_of(const MeshParts& parts) {
    std::vector<glm::uvec3> triangles;
    triangles.reserve(parts.triangles.size());
    for (const auto& corners : parts.triangles) {
        triangles.emplace_back(corners[0].position, corners[1].position, corners[2].position);
    }
    return triangles;
}

/// Examines triangles as the file has them; how far out strays stand is a remark.
MeshCore examine(const MeshParts& parts, LoadedMesh& loaded) {
    const std::vector<glm::uvec3> triangles = triangles_of(parts);
    loaded.report = mesh_report(parts.positions, triangles);
    MeshCore core = mesh_core(parts.positions, triangles, loaded.report);
    if (core.strays > 0) {
        loaded.remarks.push_back(stray_words(core, parts.where));
    }
    return core;
}

}  // namespace

MeshParts::Verdict MeshParts::add_face(std::span<const FaceCorner> corners, std::uint32_t material) {
    if (corners.size() < 3) {
        ++faces_of_few_corners;
        return Verdict::few_corners;
    }
    polygon_.clear();
    for (const FaceCorner& corner : corners) {
        if (corner.position < 0 || corner.position >= std::int64_t(positions.size())) {
            ++faces_out_of_range;
            return Verdict::out_of_range;
        }
        polygon_.push_back(positions[std::size_t(corner.position)]);
        if (!is_finite(polygon_.back())) {
            ++faces_not_finite;
            return Verdict::not_finite;
        }
    }
    checked_.assign(corners.begin(), corners.end());
    for (FaceCorner& corner : checked_) {
        if (corner.texture_coordinate >= std::int64_t(texture_coordinates.size()) ||
            corner.normal >= std::int64_t(normals.size())) {
            ++lost_attributes;
            corner.texture_coordinate = corner.normal = -1;
        }
    }
    cut_.clear();
    if (!triangulate(polygon_, cut_)) {
        ++faces_too_tangled;
        return Verdict::too_tangled;
    }
    for (const auto& cut : cut_) {
        triangles.push_back({checked_[cut[0]], checked_[cut[1]], checked_[cut[2]]});
        triangle_materials.push_back(material);
    }
    ++faces;
    return Verdict::good;
}

LoadedMesh make_mesh(const MeshParts& parts, const MeshSource& source, double said_unit_mm) {
    LoadedMesh loaded;
    loaded.faces = parts.faces;
    loaded.texture_coordinates = parts.texture_coordinates.size();
    loaded.normals = parts.normals.size();
    remark_losses(parts, loaded.remarks);
    if (parts.triangles.empty()) {
        throw InputError(nothing_to_show(parts));
    }
    const MeshCore core = examine(parts, loaded);
    const glm::dvec3 extent = core.high - core.low;
    loaded.unit = source.millimetres_per_unit ? UnitLength{*source.millimetres_per_unit, "the scene", false}
                  : said_unit_mm > 0.0        ? UnitLength{said_unit_mm, "a comment of the file", false}
                                              : proposed_unit(std::max({extent.x, extent.y, extent.z}));

    const glm::dvec3 origin = origin_of(core);
    CleanTriangles kept = clean(parts, loaded.unit.millimetres, origin);
    if (const std::size_t lost = parts.triangles.size() - kept.triangles.size(); lost > 0) {
        if (kept.triangles.empty()) {
            throw InputError(fmt::format("{}: none of its {} has an area{}, so there is nothing to show", parts.where,
                                         counted(lost, "triangle"),
                                         loaded.report.degenerate_triangles < lost ? " in single precision" : ""));
        }
        loaded.remarks.push_back(fmt::format("{}: {} without area left out", parts.where, counted(lost, "triangle")));
    }
    std::vector<glm::dvec3> normals = file_normals(kept, parts, source);
    settle_orientation(kept, normals, loaded.report, parts.where, loaded.remarks);
    complete_normals(kept, normals, source.crease_angle_deg);
    auto mesh = indexed(kept, parts, normals);
    mesh->millimetres_per_unit = loaded.unit.millimetres;
    mesh->origin = 1e-3 * loaded.unit.millimetres * origin;
    mesh->closed = loaded.report.closed();
    loaded.mesh = std::move(mesh);
    return loaded;
}

void set_unit(LoadedMesh& loaded, UnitLength unit) {
    auto mesh = std::make_shared<TriangleMesh>(*loaded.mesh);
    const double ratio = unit.millimetres / loaded.unit.millimetres;
    for (glm::vec3& position : mesh->positions) {
        position = glm::vec3(ratio * glm::dvec3(position));
    }
    mesh->low = glm::vec3(ratio * mesh->low);
    mesh->high = glm::vec3(ratio * mesh->high);
    mesh->origin *= ratio;
    mesh->millimetres_per_unit = unit.millimetres;
    loaded.mesh = std::move(mesh);
    loaded.unit = std::move(unit);
}

}  // namespace bruma::scene
