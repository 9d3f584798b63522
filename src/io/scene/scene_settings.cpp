#include "io/scene/scene_settings.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/nearest_name.h"
#include "io/json/json_fields.h"
#include "io/json/json_text.h"
#include "io/scene/clouds_json.h"
#include "io/scene/scene_json.h"
#include "scene/camera.h"
#include "scene/sky/sky.h"

namespace bruma::io {
namespace {

std::vector<std::string> split(std::string_view path) {
    std::vector<std::string> parts(1);
    for (const char c : path) {
        if (c == '.') {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

std::vector<std::string> keys_of(const json& object) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : object.items()) {
        keys.push_back(key);
    }
    return keys;
}

/// Walks down a path; `setting` opens the messages.
class Walk {
  public:
    Walk(std::string_view setting, std::vector<std::string> parts) : setting_(setting), parts_(std::move(parts)) {}

    json& down(json& from, std::size_t first) const {
        json* at = &from;
        for (std::size_t n = first; n < parts_.size();) {
            at = at->is_object() ? &member(*at, n) : &element(*at, n);
        }
        return *at;
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw InputError(fmt::format("--set {}: {}", setting_, what));
    }

  private:
    /// Moves `n` behind the parts it used: names may hold dots, so as many parts as it takes are tried.
    json& member(json& object, std::size_t& n) const {
        std::string key;
        for (std::size_t last = n; last < parts_.size(); ++last) {
            key += (last == n ? "" : ".") + parts_[last];
            if (const auto found = object.find(key); found != object.end()) {
                n = last + 1;
                return *found;
            }
        }
        fail(fmt::format("there is no '{}' here{}", parts_[n], suggestion(parts_[n], keys_of(object))));
    }

    json& element(json& array, std::size_t& n) const {
        const std::string& part = parts_[n];
        if (array.is_null()) {
            fail(fmt::format("what '{}' would be a part of is null; set the whole first", part));
        }
        if (!array.is_array()) {
            fail(fmt::format("'{}' goes too far, the path ends in a single value before it", part));
        }
        std::size_t index = 0;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
        if (error != std::errc() || end != part.data() + part.size() || index >= array.size()) {
            fail(fmt::format("'{}' is no index of an array of {} parts, counted from 0", part, array.size()));
        }
        ++n;
        return array[index];
    }

    std::string setting_;
    std::vector<std::string> parts_;
};

/// The nodes or lights that a kind's name addresses.
std::vector<json*> all_of_kind(json& document, const std::string& kind) {
    std::vector<json*> found;
    json& group = document[kind == "light" ? "lights" : "nodes"];
    if (group.is_object()) {
        for (auto& [name, part] : group.items()) {
            if (kind == "light" || (part.is_object() && part.value("kind", json()) == json(kind))) {
                found.push_back(&part);
            }
        }
    }
    return found;
}

std::optional<json> json_if_it_is(const std::string& text, const std::string& name) {
    try {
        return parse_json(text, name);
    } catch (const BrokenJson&) {
        return std::nullopt;
    }
}

/// A single number with a decimal comma, as 0,5; with the comma as a point. Nothing for other texts.
std::optional<std::string> with_decimal_point(const std::string& value) {
    const std::size_t comma = value.find(',');
    if (comma == std::string::npos || value.find_first_of(",.", comma + 1) != std::string::npos ||
        value.find('.') < comma) {
        return std::nullopt;
    }
    std::string number = value;
    number[comma] = '.';
    return json::accept(number) ? std::optional(number) : std::nullopt;
}

/// Whether the comma may as well part thousands, as in 1,000 or 12,500.
bool may_part_thousands(const std::string& value) {
    const std::size_t comma = value.find(',');
    const std::size_t first = value.find_first_of("123456789");
    const bool three_behind =
        value.size() == comma + 4 && value.find_first_not_of("0123456789", comma + 1) == std::string::npos;
    return three_behind && first < comma && comma - first <= 3;
}

/// JSON where it is JSON, else a word; a place that holds text takes the value as text in any case. Numbers with commas
/// between them are a vector, as `--spacing` and `--up` take them; where one number stands, its comma is a decimal one.
void assign(const Walk& walk, json& place, const std::string& value, const std::string& setting) {
    const std::string name = "--set " + setting.substr(0, setting.find('='));
    std::optional<json> parsed = json_if_it_is(value, name);
    if (const auto number = with_decimal_point(value); number && place.is_number()) {
        if (may_part_thousands(value)) {
            walk.fail(fmt::format("does the comma of {} part thousands or decimals? write {} or {}", value,
                                  std::string(value).erase(value.find(','), 1), *number));
        }
        parsed = json_if_it_is(*number, name);
    }
    if (!parsed && !place.is_string() && value.find_first_not_of("0123456789.,+-eE ") == std::string::npos) {
        parsed = json_if_it_is("[" + value + "]", name);
    }
    const bool is_text = !parsed || (place.is_string() && !parsed->is_string() && !parsed->is_structured());
    place = is_text ? json(value) : std::move(*parsed);
}

/// Parts of a scene that nobody has chosen yet: a setting of one changes the default one.
template <class Part>
void make_if_missing(json& document, const std::string& asked, const char* name) {
    if (asked == name && (!document.contains(name) || document[name].is_null())) {
        json& part = document[name] = json::object();
        write_fields(Part{}, part);
    }
}

/// A preset is no parameter but many: `clouds.preset` and `nodes.NAME.preset` write all of them into the document.
bool set_cloud_presets(json& document, const std::vector<std::string>& parts, const std::string& value) {
    std::vector<json*> targets;
    if (parts.size() == 2 && parts.front() == "clouds") {
        targets = all_of_kind(document, "clouds");
    } else if (parts.front() == "nodes" && document.contains("nodes")) {
        std::string name;
        for (std::size_t n = 1; n + 1 < parts.size(); ++n) {
            name += (n == 1 ? "" : ".") + parts[n];
        }
        const auto node = document["nodes"].find(name);
        if (node != document["nodes"].end() && node->is_object() && node->value("kind", json()) == json("clouds")) {
            targets.push_back(&*node);
        }
    }
    for (json* target : targets) {
        write_cloud_preset(json(value), "--set clouds.preset", *target);
    }
    return !targets.empty();
}

}  // namespace

void apply_setting(json& scene_document, std::string_view path_equals_value) {
    const std::size_t equals = path_equals_value.find('=');
    const std::string_view path = path_equals_value.substr(0, equals);
    const std::vector<std::string> parts = split(path);
    const Walk walk(path_equals_value, parts);
    if (equals == std::string_view::npos || parts.size() < 2) {
        walk.fail("expected PATH=VALUE with a path such as volume.lighting or nodes.NAME.density_scale");
    }
    require_object(scene_document, "");
    const std::string value(path_equals_value.substr(equals + 1));
    const std::string& first = parts.front();
    if (parts.back() == "preset" && set_cloud_presets(scene_document, parts, value)) {
        return;
    }
    if (first == "volume" || first == "mesh" || first == "clouds" || first == "group" || first == "light") {
        const std::vector<json*> targets = all_of_kind(scene_document, first);
        if (targets.empty()) {
            walk.fail(fmt::format("there is no {} in the scene to change", first));
        }
        for (json* target : targets) {
            assign(walk, walk.down(*target, 1), value, std::string(path_equals_value));
        }
        return;
    }
    make_if_missing<scene::Camera>(scene_document, first, "camera");
    make_if_missing<scene::Sky>(scene_document, first, "sky");
    make_if_missing<scene::Sun>(scene_document, first, "sun");
    make_if_missing<scene::Atmosphere>(scene_document, first, "atmosphere");
    assign(walk, walk.down(scene_document, 0), value, std::string(path_equals_value));
}

scene::Scene with_sources_set(const scene::Scene& scene, std::span<const std::string> settings,
                              const std::vector<std::filesystem::path>& preset_folders) {
    const auto comes_first = [](const std::string& setting) {
        const std::string path = setting.substr(0, setting.find('=')) + ".";
        return path.find(".source.") != std::string::npos || path.starts_with("placement.");
    };
    if (std::none_of(settings.begin(), settings.end(), comes_first)) {
        return scene;
    }
    const json before = to_json(scene);
    json document = before;
    for (const std::string& setting : settings) {
        if (!comes_first(setting)) {
            continue;
        }
        try {
            json changed = document;
            apply_setting(changed, setting);
            document = std::move(changed);
        } catch (const InputError&) {
            continue;
        }
    }
    return document == before ? scene : from_json(document, "--set", preset_folders);
}

}  // namespace bruma::io
