#include "io/scene/scene_json.h"

#include <fmt/core.h>

#include "base/error.h"
#include "base/nearest_name.h"
#include "io/json/json_fields.h"
#include "io/scene/clouds_json.h"
#include "io/scene/transfer_function_file.h"

namespace bruma::io {
namespace {

constexpr const char* version_key = "bruma_scene";
constexpr std::int64_t version = 1;
/// In the order of the alternatives of scene::Node::content.
constexpr std::array<std::string_view, 4> node_kinds{"group", "volume", "mesh", "clouds"};

template <class T>
json fields_json(const T& from) {
    json object = json::object();
    write_fields(from, object);
    return object;
}

json node_json(const scene::Node& node) {
    json object{{"kind", std::string(node_kinds[node.content.index()])},
                {"parent", node.parent},
                {"visible", node.visible},
                {"transform", fields_json(*node.transform)}};
    if (const auto* volume = std::get_if<scene::Volume>(&node.content)) {
        object["source"] = fields_json(volume->source);
        object["transfer_function"] = transfer_function_json(*volume->transfer_function);
        object["clip"] = fields_json(*volume->clip);
        object["light_volume"] = fields_json(*volume->light_volume);
        write_fields(*volume->optics, object);
    } else if (const auto* mesh = std::get_if<scene::Mesh>(&node.content)) {
        object["source"] = fields_json(mesh->source);
        object["subsurface"] = fields_json(*mesh->subsurface);
        write_fields(*mesh->surface, object);
    } else if (const auto* clouds = std::get_if<scene::Clouds>(&node.content)) {
        write_clouds(*clouds, object);
    }
    return object;
}

/// Calls `read(value, path)` when `object` has the key.
template <class Read>
void if_present(const json& object, const std::string& where, const char* key, Read&& read) {
    if (const auto found = object.find(key); found != object.end()) {
        read(*found, join_path(where, key));
    }
}

using Folders = std::vector<std::filesystem::path>;

scene::Volume read_volume(const json& object, const std::string& where, const Folders& folders) {
    scene::Volume volume;
    if_present(object, where, "source", [&](const json& from, const std::string& here) {
        volume.source = read_fields<scene::VolumeSource>(from, here);
    });
    if (volume.source.file.empty()) {
        throw InputError(
            fmt::format("{}: a volume needs a file or builtin:NAME here", join_path(where, "source.file")));
    }
    if_present(object, where, "transfer_function", [&](const json& from, const std::string& here) {
        volume.transfer_function = from.is_string()
                                       ? load_transfer_function(find_preset(from.get<std::string>(), folders, here))
                                       : read_transfer_function(from, here);
    });
    if_present(object, where, "clip", [&](const json& from, const std::string& here) {
        volume.clip = read_fields<scene::ClipBox>(from, here);
    });
    if_present(object, where, "light_volume", [&](const json& from, const std::string& here) {
        volume.light_volume = read_fields<scene::LightVolumeSettings>(from, here);
    });
    scene::VolumeOptics optics;
    read_present_fields(object, where, optics);
    volume.optics = optics;
    return volume;
}

scene::Mesh read_mesh(const json& object, const std::string& where) {
    scene::Mesh mesh;
    if_present(object, where, "source", [&](const json& from, const std::string& here) {
        mesh.source = read_fields<scene::MeshSource>(from, here);
    });
    if (mesh.source.file.empty()) {
        throw InputError(fmt::format("{}: a mesh needs a file or builtin:NAME here", join_path(where, "source.file")));
    }
    if_present(object, where, "subsurface", [&](const json& from, const std::string& here) {
        mesh.subsurface = read_fields<scene::SubsurfaceSettings>(from, here);
    });
    scene::MeshSurface surface;
    read_present_fields(object, where, surface);
    mesh.surface = surface;
    return mesh;
}

/// Throws for a key that is none of `known`, no field of a struct, and not one that every node has.
template <class Fields>
void require_node_keys(const json& object, const std::string& where, std::vector<std::string> known) {
    const std::vector<std::string> fields = field_names<Fields>();
    known.insert(known.end(), fields.begin(), fields.end());
    known.insert(known.end(), {"kind", "parent", "visible", "transform"});
    require_known_keys(object, where, known);
}

scene::Node read_node(const json& object, const std::string& where, const Folders& folders) {
    require_object(object, where);
    scene::Node node;
    const auto kind = object.find("kind");
    if (kind == object.end()) {
        throw InputError(fmt::format("{}: missing; expected \"volume\", \"mesh\", \"clouds\" or \"group\"",
                                     join_path(where, "kind")));
    }
    const std::string_view word = node_kinds[read_word(*kind, join_path(where, "kind"), node_kinds)];
    if (word == "volume") {
        require_node_keys<scene::VolumeOptics>(object, where, {"source", "transfer_function", "clip", "light_volume"});
        node.content = read_volume(object, where, folders);
    } else if (word == "mesh") {
        require_node_keys<scene::MeshSurface>(object, where, {"source", "subsurface"});
        node.content = read_mesh(object, where);
    } else if (word == "clouds") {
        require_node_keys<scene::CloudLayer>(object, where, {"preset", "optics", "weather", "march"});
        node.content = read_clouds(object, where);
    } else {
        require_known_keys(object, where, {"kind", "parent", "visible", "transform"});
    }
    if_present(object, where, "parent",
               [&](const json& from, const std::string& here) { read_value(from, Field{}, here, node.parent); });
    if_present(object, where, "visible",
               [&](const json& from, const std::string& here) { read_value(from, Field{}, here, node.visible); });
    if_present(object, where, "transform", [&](const json& from, const std::string& here) {
        node.transform = read_fields<scene::Transform>(from, here);
    });
    return node;
}

/// Calls `read(name, value, path)` for each named part of an object.
template <class Read>
void for_each_named(const json& object, const std::string& where, Read&& read) {
    require_object(object, where);
    for (const auto& [name, value] : object.items()) {
        if (name.empty()) {
            throw InputError(fmt::format("{}: a name is empty; give it one", where));
        }
        read(name, value, join_path(where, name));
    }
}

/// Any of the three makes an outdoor scene; what is left out or null has its defaults.
void read_outdoors(const json& document, const std::string& top, scene::Scene& scene) {
    const auto read = [&]<class T>(const char* key, Tracked<T> scene::Outdoors::*part) {
        if_present(document, top, key, [&](const json& from, const std::string& here) {
            if (!from.is_null()) {
                if (!scene.outdoors) {
                    scene.outdoors.emplace();
                }
                (*scene.outdoors).*part = read_fields<T>(from, here);
            }
        });
    };
    read("sky", &scene::Outdoors::sky);
    read("sun", &scene::Outdoors::sun);
    read("atmosphere", &scene::Outdoors::atmosphere);
}

}  // namespace

json to_json(const scene::Scene& scene) {
    json document{{version_key, version},
                  {"background", fields_json(*scene.background)},
                  {"environment", fields_json(*scene.environment)},
                  {"rendering", fields_json(*scene.rendering)},
                  {"display", fields_json(*scene.display)},
                  {"time", fields_json(*scene.time)},
                  {"placement", fields_json(*scene.placement)},
                  {"lights", json::object()},
                  {"nodes", json::object()}};
    if (scene.camera) {
        document["camera"] = fields_json(**scene.camera);
    }
    if (scene.outdoors) {
        document["sky"] = fields_json(*scene.outdoors->sky);
        document["sun"] = fields_json(*scene.outdoors->sun);
        document["atmosphere"] = fields_json(*scene.outdoors->atmosphere);
    }
    for (const auto& [name, light] : scene.lights) {
        document["lights"][name] = fields_json(*light);
    }
    for (const auto& [name, node] : scene.nodes) {
        document["nodes"][name] = node_json(node);
    }
    return document;
}

scene::Scene from_json(const json& document, const std::string& where, const Folders& preset_folders) {
    const std::string top = where.empty() ? "" : where + ":";
    require_object(document, top);
    check_version(document, version_key, version, where);
    require_known_keys(document, top,
                       {version_key, "camera", "sky", "sun", "atmosphere", "background", "environment", "rendering",
                        "display", "time", "placement", "lights", "nodes"});
    scene::Scene scene;
    if_present(document, top, "camera", [&](const json& from, const std::string& here) {
        if (!from.is_null()) {
            scene.camera.emplace(read_fields<scene::Camera>(from, here));
        }
    });
    read_outdoors(document, top, scene);
    if_present(document, top, "background", [&](const json& from, const std::string& here) {
        scene.background = read_fields<scene::Background>(from, here);
    });
    if_present(document, top, "environment", [&](const json& from, const std::string& here) {
        scene.environment = read_fields<scene::Environment>(from, here);
    });
    if_present(document, top, "rendering", [&](const json& from, const std::string& here) {
        scene.rendering = read_fields<scene::RenderSettings>(from, here);
    });
    if_present(document, top, "display", [&](const json& from, const std::string& here) {
        scene.display = read_fields<scene::Display>(from, here);
    });
    if_present(document, top, "time", [&](const json& from, const std::string& here) {
        scene.time = read_fields<scene::Timeline>(from, here);
    });
    if_present(document, top, "placement", [&](const json& from, const std::string& here) {
        scene.placement = read_fields<scene::Placement>(from, here);
    });
    if_present(document, top, "lights", [&](const json& lights, const std::string& here) {
        for_each_named(lights, here, [&](const std::string& name, const json& from, const std::string& path) {
            scene.lights.emplace(name, read_fields<scene::Light>(from, path));
        });
    });
    if_present(document, top, "nodes", [&](const json& nodes, const std::string& here) {
        for_each_named(nodes, here, [&](const std::string& name, const json& from, const std::string& path) {
            scene.nodes.emplace(name, read_node(from, path, preset_folders));
        });
    });
    try {
        scene::check(scene);
    } catch (const InputError& error) {
        throw InputError(where.empty() ? error.what() : fmt::format("{}: {}", where, error.what()));
    }
    return scene;
}

}  // namespace bruma::io
