#include "io/added_mesh.h"

#include "base/log.h"
#include "io/mesh/mesh_source.h"
#include "io/scene/scene_settings.h"
#include "io/volume/grid_source.h"
#include "scene/mesh/mesh_up.h"

namespace bruma::io {
CommonCoordinates common_coordinates(const scene::Scene& scene) {
    CommonCoordinates common;
    for (const auto& [name, node] : scene.nodes) {
        if (std::holds_alternative<scene::Volume>(node.content)) {
            common.settled = true;
            common.millimetres_per_unit = 1.0;
        }
    }
    for (const auto& [name, node] : scene.nodes) {
        if (const auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
            const double millimetres = (*mesh->triangles)->millimetres_per_unit;
            common.settled = true;
            common.millimetres_per_unit = common.millimetres_per_unit.value_or(millimetres);
            common.origin_m = 1e-3 * millimetres * mesh->source.origin.value_or(glm::dvec3(0.0));
        }
    }
    return common;
}

AddedMesh read_added_mesh(const scene::Scene& scene, const std::string& name, const std::string& file,
                          std::span<const std::string> settings, const Progress& progress,
                          const std::vector<std::filesystem::path>& preset_folders) {
    AddedMesh added;
    scene::MeshSource& source = added.mesh.source;
    source.file = file;
    added.mesh = with_source_set(added.mesh, name, settings, preset_folders);
    scene::LoadedMesh loaded = load_mesh(source, progress);
    const bool keeps = scene.placement->common_coordinates;
    const CommonCoordinates common = keeps ? common_coordinates(scene) : CommonCoordinates{};
    const bool unit_is_open = !is_builtin(source.file) && loaded.unit.is_proposed;
    if (unit_is_open && common.millimetres_per_unit && *common.millimetres_per_unit != loaded.unit.millimetres) {
        source.millimetres_per_unit = common.millimetres_per_unit;
        scene::set_unit(loaded, {*common.millimetres_per_unit, "that of the others", true});
    }
    log_remarks(source, loaded);
    const double metres_per_unit = 1e-3 * loaded.unit.millimetres;
    if (const glm::dvec3 far = loaded.mesh->origin; !source.origin && far != glm::dvec3(0.0) && !common.settled) {
        source.origin = far / metres_per_unit;
        log_note(
            "{}: far from the origin of its coordinates: ({:.10g}, {:.10g}, {:.10g}) units, its middle, {}; "
            "mesh.source.origin holds this{}",
            file, source.origin->x, source.origin->y, source.origin->z,
            keeps ? "stands at 0 for all files" : "stands at 0",
            keeps ? "" : ", and --common-coordinates keeps several files together");
    } else if (!source.origin && common.origin_m != glm::dvec3(0.0)) {
        source.origin = common.origin_m / metres_per_unit;
    }
    if (!keeps && !is_builtin(source.file) && scene::is_z_plainly_up(*loaded.mesh)) {
        added.transform.rotation_deg = {-90.0, 0.0, 0.0};
        log_note(
            "{}: stands on a wide flat base at its lowest z, so that z is taken for its up axis; --set "
            "nodes.{}.transform.rotation=[0,0,0] takes this back",
            file, name);
    }
    added.mesh.triangles = std::move(loaded.mesh);
    return added;
}

}  // namespace bruma::io
