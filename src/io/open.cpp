#include "io/open.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>

#include "base/error.h"
#include "base/log.h"
#include "base/nearest_name.h"
#include "io/added_mesh.h"
#include "io/mesh/mesh_source.h"
#include "io/picture/weather_file.h"
#include "io/scene/scene_file.h"
#include "io/scene/scene_json.h"
#include "io/scene/scene_settings.h"
#include "io/volume/grid_source.h"
#include "io/volume/raw_layout.h"
#include "io/volume/raw_name.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/mesh_builtin.h"

namespace bruma::io {
namespace {

using Folders = std::vector<std::filesystem::path>;
using Settings = std::span<const std::string>;

enum class FileKind { scene, raw_volume, mesh, builtin_volume, builtin_scene };

/// Endings of formats that are not read, for files whose content does not tell.
const std::vector<std::string> foreign_endings{
    ".3ds", ".blend", ".csv", ".dae", ".dcm", ".exr", ".fbx", ".glb", ".gltf", ".gz",  ".h5",  ".hdf5",
    ".hdr", ".jpg",   ".mat", ".nc",  ".nii", ".pdf", ".ply", ".png", ".pvm",  ".stl", ".stp", ".tga",
    ".tif", ".tiff",  ".txt", ".usd", ".vdb", ".vti", ".vtk", ".vtp", ".vtu",  ".wrl", ".xml", ".zip"};

bool holds(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

FileKind kind_of(const std::string& argument, const scene::VolumeSource& hints) {
    if (is_mesh(argument)) {
        return FileKind::mesh;
    }
    if (is_builtin(argument)) {
        const std::string name = builtin_name(argument);
        std::vector<std::string> known = scene::builtin_volume_names();
        if (holds(known, name)) {
            return FileKind::builtin_volume;
        }
        const std::vector<std::string> scenes = scene::builtin_scene_names();
        if (holds(scenes, name)) {
            return FileKind::builtin_scene;
        }
        known.insert(known.end(), scenes.begin(), scenes.end());
        const std::vector<std::string> meshes = scene::builtin_mesh_names();
        known.insert(known.end(), meshes.begin(), meshes.end());
        throw InputError(fmt::format("{}: nothing of this name is built in{}", argument, suggestion(name, known)));
    }
    std::string ending = std::filesystem::path(argument).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".json") {
        return FileKind::scene;
    }
    if (ending == ".raw") {
        return FileKind::raw_volume;
    }
    std::error_code ignored;
    if (!std::filesystem::exists(argument, ignored)) {
        throw InputError(
            fmt::format("{}: {} is not read; known are .json scenes, .raw volumes, .obj, .off and .raw meshes "
                        "and builtin:NAME",
                        argument, ending.empty() ? "a name without ending" : "'" + ending + "'"));
    }
    // Whatever its name, it holds samples if somebody tells their layout, and may hold them if its content is of no
    // known format, which throws for others, and its name claims no other kind.
    if (!known_layout_parts(argument, hints).complete() && holds(foreign_endings, ending)) {
        throw InputError(
            fmt::format("{}: '{}' is not read, and its first bytes are of no format that is known; if it "
                        "holds plain samples, say --dims NXxNYxNZ and --type TYPE",
                        argument, ending));
    }
    return FileKind::raw_volume;
}

/// Says what was taken from the list of published volumes.
void note_known_volume(const std::string& argument, const RawLayout& layout) {
    std::string said_by;
    std::string what;
    const auto add = [&](const std::string& from, const std::string& words) {
        if (from.starts_with("known volume")) {
            said_by = from;
            what += (what.empty() ? "" : ", ") + words;
        }
    };
    const bool whole = layout.size_from == layout.type_from;
    add(layout.size_from, whole ? layout_words(layout.size, layout.type)
                                : fmt::format("{} x {} x {}", layout.size.x, layout.size.y, layout.size.z));
    add(whole ? "" : layout.type_from, std::string(scene::enum_words<scene::VoxelType>()[std::size_t(layout.type)]));
    add(layout.spacing_from, fmt::format("samples {:g} x {:g} x {:g} mm apart", 1e3 * layout.spacing_m.x,
                                         1e3 * layout.spacing_m.y, 1e3 * layout.spacing_m.z));
    add(layout.rotation_from, "set upright");
    if (!what.empty()) {
        log_note("{}: taken for the {}: {}", argument, said_by, what);
    }
}

std::string unique_name(const scene::Scene& scene, const std::string& wanted) {
    std::string name = wanted;
    for (int n = 2; scene.nodes.contains(name); ++n) {
        name = fmt::format("{}_{}", wanted, n);
    }
    return name;
}

bool overlap(const scene::Bounds& a, const scene::Bounds& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.low[axis] >= b.high[axis] || b.low[axis] >= a.high[axis]) {
            return false;
        }
    }
    return true;
}

/// The box around a box that a node is turned and moved by.
scene::Bounds moved_box(const glm::dmat4& world_from_box, const glm::dvec3& low, const glm::dvec3& high) {
    // Each axis of the world sees a share of each edge.
    const glm::dmat3 linear(world_from_box);
    const glm::dvec3 half = 0.5 * (high - low);
    const glm::dvec3 reach = glm::abs(linear[0]) * half.x + glm::abs(linear[1]) * half.y + glm::abs(linear[2]) * half.z;
    const glm::dvec3 middle = world_from_box * glm::dvec4(0.5 * (low + high), 1.0);
    return {middle - reach, middle + reach};
}

/// How far along x a box must go to stand beside what is there.
double way_out(const scene::Scene& scene, const scene::Bounds& box) {
    const bool empty = scene::shown_volumes(scene).empty() && scene::shown_meshes(scene).empty();
    if (empty || scene.placement->common_coordinates) {
        return 0.0;
    }
    const scene::Bounds taken = scene::world_bounds(scene);
    const double gap = 0.1 * std::max(box.high.x - box.low.x, taken.high.x - taken.low.x);
    return overlap(taken, box) ? taken.high.x + gap - box.low.x : 0.0;
}

void add_node(scene::Scene& scene, const std::string& name, decltype(scene::Node::content) content,
              const scene::Bounds& box, const scene::Transform& turn = {}) {
    scene::Node node;
    node.transform = turn;
    node.transform.edit([&](scene::Transform& transform) { transform.translation.x += way_out(scene, box); });
    node.content = std::move(content);
    scene.nodes.emplace(name, std::move(node));
}

void add_mesh(scene::Scene& scene, const std::string& file, Settings settings, const Progress& progress,
              const Folders& folders) {
    const std::string name =
        unique_name(scene, is_builtin(file) ? builtin_name(file) : std::filesystem::path(file).stem().string());
    AddedMesh added = read_added_mesh(scene, name, file, settings, progress, folders);
    const scene::TriangleMesh& mesh = **added.mesh.triangles;
    const glm::dmat4 moved = glm::translate(scene::parent_from_model(added.transform), scene::shift_of(added.mesh));
    const scene::Bounds box = moved_box(moved, mesh.low, mesh.high);
    add_node(scene, name, std::move(added.mesh), box, added.transform);
}

void add_volume(scene::Scene& scene, const std::string& name, scene::VolumeSource source,
                std::shared_ptr<const scene::VolumeGrid> grid, glm::dvec3 rotation_deg) {
    scene::Volume volume;
    volume.source = std::move(source);
    volume.transfer_function = scene::suggested_transfer_function(*grid);
    // Lit surfaces tell shapes at the first look; nothing is lost by switching it off.
    volume.optics.edit([](scene::VolumeOptics& optics) { optics.lighting = scene::VolumeLighting::gradient; });
    scene::Transform turn{.rotation_deg = rotation_deg};
    const glm::dvec3 extent = grid->extent();
    if (scene.placement->common_coordinates) {
        // Headerless files tell no place: coordinates count from their first sample, as other programs take them.
        turn.rotation_deg = glm::dvec3(0.0);
        turn.translation = -common_coordinates(scene).origin_m;
        turn.translation += is_builtin(volume.source.file) ? glm::dvec3(0.0) : 0.5 * (extent - grid->spacing);
        log_note("{}: its first sample stands at 0 of the common coordinates{}", volume.source.file,
                 rotation_deg == glm::dvec3(0.0) ? "" : ", and it is not set upright");
    }
    const scene::Bounds box = moved_box(scene::parent_from_model(turn), -0.5 * extent, 0.5 * extent);
    volume.grid = std::move(grid);
    add_node(scene, name, std::move(volume), box, turn);
}

Tracked<scene::Placement> placement_as_set(const scene::Scene& scene, Settings settings, const Folders& folders) {
    scene::Scene empty;
    empty.placement = scene.placement;
    return with_sources_set(empty, settings, folders).placement;
}

scene::Scene whole_scene(const std::string& argument, FileKind kind, Settings settings, const Progress& progress,
                         const Folders& folders) {
    return kind == FileKind::scene ? read_scene_file(argument, progress, folders, settings)
                                   : scene::builtin_scene(builtin_name(argument));
}

void add_without_light(scene::Scene& scene, const std::string& argument, const scene::VolumeSource& hints,
                       Settings settings, const Progress& progress, const Folders& folders) {
    const FileKind kind = kind_of(argument, hints);
    if (kind == FileKind::scene || kind == FileKind::builtin_scene) {
        if (!scene.nodes.empty()) {
            throw InputError(
                fmt::format("{}: a whole scene cannot be added to another one; name it first, or open it "
                            "alone",
                            argument));
        }
        scene = whole_scene(argument, kind, settings, progress, folders);
        return;
    }
    if (kind == FileKind::mesh) {
        add_mesh(scene, argument, settings, progress, folders);
        return;
    }
    scene::VolumeSource source;
    if (kind == FileKind::raw_volume) {
        source = hints;
    }
    std::string name = kind == FileKind::raw_volume ? make_grid_name(argument) : builtin_name(argument);
    source.file = argument;
    name = unique_name(scene, name);
    scene::Volume volume;
    volume.source = std::move(source);
    source = with_source_set(std::move(volume), name, settings, folders).source;
    auto grid = load_grid(source, progress);
    glm::dvec3 rotation_deg(0.0);
    if (kind == FileKind::raw_volume && source.file == argument) {
        const RawLayout layout = find_raw_layout(argument, source);
        rotation_deg = layout.rotation_deg;
        note_known_volume(argument, layout);
    }
    add_volume(scene, name, std::move(source), std::move(grid), rotation_deg);
}

void add_default_light(scene::Scene& scene) {
    if (scene.lights.empty() && !scene.outdoors) {
        scene.lights.emplace("headlight", scene::Light{.kind = scene::LightKind::headlight});
        // Dark enough for glow, bright enough to see dark matter before it.
        if (*scene.background == scene::Background{}) {
            scene.background =
                scene::Background{.top = glm::dvec3(0.012, 0.014, 0.018), .bottom = glm::dvec3(0.055, 0.06, 0.068)};
        }
    }
}

}  // namespace

bool is_raw_volume(const std::string& argument, const scene::VolumeSource& hints) {
    return kind_of(argument, hints) == FileKind::raw_volume;
}

std::vector<scene::VolumeSource> hints_for_each(std::span<const std::string> arguments,
                                                const scene::VolumeSource& hints) {
    std::vector<scene::VolumeSource> each(arguments.size(), hints);
    std::vector<std::size_t> raw;
    for (std::size_t n = 0; n < arguments.size(); ++n) {
        if (is_raw_volume(arguments[n], hints)) {
            raw.push_back(n);
        }
    }
    if (raw.size() < 2) {
        return each;
    }
    std::map<std::string, std::vector<std::string>> overruled_in;
    for (const std::size_t n : raw) {
        std::vector<std::string> overruled;
        each[n] = hints_among_others(arguments[n], hints, overruled);
        for (const std::string& option : overruled) {
            overruled_in[option].push_back(arguments[n]);
        }
    }
    for (const auto& [option, files] : overruled_in) {
        if (files.size() == raw.size()) {
            throw InputError(
                fmt::format("{} holds for none of the {} files, since each says its own by its name, a header or a "
                            "sidecar; open a file alone to overrule what it says",
                            option, raw.size()));
        }
        for (const std::string& file : files) {
            log_note("{}: {} holds for the other files; this one says its own", file, option);
        }
    }
    return each;
}

scene::Scene open_files(std::span<const std::string> arguments, const scene::VolumeSource& hints,
                        std::span<const std::string> settings, const Progress& progress,
                        const Folders& preset_folders) {
    // Names are judged before the first gigabyte is read.
    const std::vector<scene::VolumeSource> own_hints = hints_for_each(arguments, hints);
    scene::Scene scene;
    scene.placement = placement_as_set(scene, settings, preset_folders);
    std::vector<std::size_t> in_order(arguments.size());
    std::iota(in_order.begin(), in_order.end(), std::size_t(0));
    if (scene.placement->common_coordinates) {
        // Volumes settle the unit of meshes that do not say theirs.
        std::stable_partition(in_order.begin(), in_order.end(),
                              [&](std::size_t argument) { return !is_mesh(arguments[argument]); });
    }
    for (std::size_t n = 0; n < in_order.size(); ++n) {
        const auto part = [&](double share, std::string_view what) {
            progress((double(n) + share) / double(in_order.size()), what);
        };
        const std::size_t argument = in_order[n];
        add_without_light(scene, arguments[argument], own_hints[argument], settings,
                          progress ? Progress(part) : Progress(), preset_folders);
    }
    add_default_light(scene);
    return settings.empty() ? scene : with_settings(scene, settings, progress, preset_folders);
}

void add_file(scene::Scene& scene, const std::string& argument, const scene::VolumeSource& hints,
              const Progress& progress, const Folders& preset_folders, Settings settings) {
    scene::Scene changed = scene;
    changed.placement = placement_as_set(scene, settings, preset_folders);
    add_without_light(changed, argument, hints, settings, progress, preset_folders);
    add_default_light(changed);
    scene::check(changed);
    scene = std::move(changed);
}

scene::Scene with_settings(const scene::Scene& scene, std::span<const std::string> settings, const Progress& progress,
                           const Folders& preset_folders) {
    nlohmann::json document = to_json(scene);
    const bool about_camera = std::any_of(settings.begin(), settings.end(),
                                          [](const std::string& setting) { return setting.starts_with("camera."); });
    if (about_camera && !scene.camera) {
        // One part of the camera is chosen: the others start from the view that shows everything.
        scene::Scene framed = scene;
        framed.camera.emplace(scene::fit_camera(scene::world_bounds(scene), 16.0 / 9.0));
        document = to_json(framed);
    }
    for (const std::string& setting : settings) {
        apply_setting(document, setting);
    }
    scene::Scene changed = from_json(document, "--set", preset_folders);
    load_missing_grids(changed, &scene, progress);
    load_missing_meshes(changed, &scene, progress);
    load_missing_weather(changed, &scene);
    return changed;
}

}  // namespace bruma::io
