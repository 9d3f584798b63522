#include "io/scene/clouds_json.h"

#include "io/json/json_fields.h"

namespace bruma::io {
namespace {

scene::CloudType read_preset(const json& name, const std::string& where) {
    return scene::CloudType(read_word(name, where, scene::enum_words<scene::CloudType>()));
}

template <class Fields>
void write_part(const Tracked<Fields>& part, const char* key, json& object) {
    object[key] = json::object();
    write_fields(*part, object[key]);
}

template <class Fields>
void read_part(const json& object, const std::string& where, const char* key, Tracked<Fields>& into) {
    if (const auto found = object.find(key); found != object.end()) {
        const std::string here = join_path(where, key);
        require_object(*found, here);
        require_known_keys(*found, here, field_names<Fields>());
        into.edit([&](Fields& fields) { read_present_fields(*found, here, fields); });
    }
}

}  // namespace

void write_clouds(const scene::Clouds& clouds, json& object) {
    write_fields(*clouds.layer, object);
    write_part(clouds.optics, "optics", object);
    write_part(clouds.weather, "weather", object);
    write_part(clouds.march, "march", object);
}

scene::Clouds read_clouds(const json& object, const std::string& where) {
    scene::Clouds clouds;
    if (const auto preset = object.find("preset"); preset != object.end()) {
        clouds = scene::preset_clouds(read_preset(*preset, join_path(where, "preset")));
    }
    clouds.layer.edit([&](scene::CloudLayer& layer) { read_present_fields(object, where, layer); });
    read_part(object, where, "optics", clouds.optics);
    read_part(object, where, "weather", clouds.weather);
    read_part(object, where, "march", clouds.march);
    return clouds;
}

void write_cloud_preset(const json& name, const std::string& where, json& object) {
    const scene::Clouds preset = scene::preset_clouds(read_preset(name, where));
    const json march = object.value("march", json());
    write_clouds(preset, object);
    if (!march.is_null()) {
        object["march"] = march;
    }
}

}  // namespace bruma::io
