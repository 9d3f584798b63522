#include "io/mesh/mesh_text.h"

#include <fmt/core.h>

#include "scene/mesh/mesh_up.h"

namespace bruma::io {
namespace {

std::string materials_text(const scene::TriangleMesh& mesh) {
    std::vector<std::size_t> counts(mesh.materials.size(), 0);
    for (const std::uint32_t material : mesh.triangle_materials) {
        ++counts[material];
    }
    std::string text = mesh.colors.empty() ? "" : "colors   at its vertices, which multiply those of its materials\n";
    for (std::size_t n = 0; n < counts.size(); ++n) {
        const scene::MeshMaterial& material = mesh.materials[n];
        if (material.name.empty() && material.diffuse_texture == nullptr && counts.size() == 1) {
            return text;
        }
        text += fmt::format("material {}: {} triangles, diffuse ({:.3g}, {:.3g}, {:.3g})",
                            material.name.empty() ? "without name" : "'" + material.name + "'", counts[n],
                            material.diffuse.r, material.diffuse.g, material.diffuse.b);
        if (material.specular != glm::dvec3(0.0)) {
            text += fmt::format(", highlight ({:.3g}, {:.3g}, {:.3g}) to the power of {:.4g}", material.specular.r,
                                material.specular.g, material.specular.b, material.shininess);
        }
        if (material.emission != glm::dvec3(0.0)) {
            text += fmt::format(", emission ({:.3g}, {:.3g}, {:.3g})", material.emission.r, material.emission.g,
                                material.emission.b);
        }
        text += material.constant ? ", the same in any light" : "";
        if (material.diffuse_texture) {
            const scene::MeshTexture& texture = *material.diffuse_texture;
            text += fmt::format(", texture {} ({} x {}, {} bits)", texture.file, texture.width, texture.height,
                                texture.bits);
        }
        text += '\n';
    }
    return text;
}

std::string orientation_words(const scene::MeshReport& report) {
    return !report.closed()      ? "not closed: it has no inside"
           : report.inside_out() ? "closed, inside out"
                                 : "closed, outward";
}

}  // namespace

std::string mesh_text(const std::string& file, const scene::LoadedMesh& loaded) {
    const scene::MeshReport& report = loaded.report;
    const double mm = loaded.unit.millimetres;
    const glm::dvec3 extent = report.high - report.low;
    std::string text = fmt::format("{}: mesh\n", file);
    text += fmt::format("vertices {}{}, {} normals, {} texture coordinates\n", report.vertices,
                        report.unused_vertices > 0 ? fmt::format(" ({} in no face)", report.unused_vertices) : "",
                        loaded.normals, loaded.texture_coordinates);
    text += fmt::format("faces    {}, {} triangles\n", loaded.faces, report.triangles);
    text += fmt::format("bounds   ({:.10g}, {:.10g}, {:.10g}) to ({:.10g}, {:.10g}, {:.10g}) units\n", report.low.x,
                        report.low.y, report.low.z, report.high.x, report.high.y, report.high.z);
    if (const glm::dvec3 far = 1e3 / mm * loaded.mesh->origin; far != glm::dvec3(0.0)) {
        text += fmt::format(
            "offset   ({:.10g}, {:.10g}, {:.10g}) units, far from the origin: taken off in double precision, and at 0 "
            "of scenes without common coordinates\n",
            far.x, far.y, far.z);
    }
    if (scene::is_z_plainly_up(*loaded.mesh)) {
        text += "up       z (it stands on a wide flat base at its lowest z)\n";
    }
    text += fmt::format("extent   {:.6g} x {:.6g} x {:.6g} mm\n", mm * extent.x, mm * extent.y, mm * extent.z);
    text += fmt::format("unit     {:.6g} mm ({})\n", mm, loaded.unit.from);
    text += fmt::format("area     {:.6g} mm^2\n", mm * mm * report.area);
    text += report.closed() ? fmt::format("volume   {:.6g} mm^3\n", mm * mm * mm * report.volume) : "";
    text += fmt::format("surface  {}, {} piece{}\n", orientation_words(report), report.components,
                        report.components == 1 ? "" : "s");
    if (report.open_edges_as_indexed != report.open_edges) {
        text += fmt::format("seams    {} more open edges if vertices at the same place are told apart\n",
                            report.open_edges_as_indexed - report.open_edges);
    }
    text += materials_text(*loaded.mesh);
    const std::vector<std::string> faults = scene::fault_words(report);
    text += faults.empty() ? "faults   none\n" : "";
    for (const std::string& fault : faults) {
        text += fmt::format("faults   {}\n", fault);
    }
    for (const std::string& remark : loaded.remarks) {
        text += fmt::format("remark   {}\n", remark);
    }
    return text;
}

}  // namespace bruma::io
