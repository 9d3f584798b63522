#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "scene/field.h"
#include "scene/volume/transfer_function.h"

/// Visitors of the one table of parameters (scene/field.h) that write and read JSON. `where` is the path of a value, as
/// in "nodes.bonsai.ambient", and opens every message. Reading throws InputError for a wrong type, a number that is not
/// finite or outside the field's range, an unknown word or an unknown key, with the nearest known one.
namespace bruma::io {

using nlohmann::json;
using scene::Field;

json json_of(bool value);
json json_of(double value);
json json_of(std::int64_t value);
json json_of(const std::string& value);
json json_of(glm::ivec3 value);
json json_of(glm::dvec3 value);
json json_of(const std::array<double, 2>& value);
json json_of(const std::vector<scene::OpacityPoint>& value);
json json_of(const std::vector<scene::ColorPoint>& value);
json json_of(const std::vector<scene::EmissionPoint>& value);

void read_value(const json& from, const Field& field, const std::string& where, bool& value);
void read_value(const json& from, const Field& field, const std::string& where, double& value);
void read_value(const json& from, const Field& field, const std::string& where, std::int64_t& value);
void read_value(const json& from, const Field& field, const std::string& where, std::string& value);
void read_value(const json& from, const Field& field, const std::string& where, glm::ivec3& value);
void read_value(const json& from, const Field& field, const std::string& where, glm::dvec3& value);
void read_value(const json& from, const Field& field, const std::string& where, std::array<double, 2>& value);
void read_value(const json& from, const Field& field, const std::string& where,
                std::vector<scene::OpacityPoint>& value);
void read_value(const json& from, const Field& field, const std::string& where, std::vector<scene::ColorPoint>& value);
void read_value(const json& from, const Field& field, const std::string& where,
                std::vector<scene::EmissionPoint>& value);

/// Index of a word among `words`; '-' and '_' are the same there.
std::size_t read_word(const json& from, const std::string& where, std::span<const std::string_view> words);
/// `from` must be an object; throws otherwise.
void require_object(const json& from, const std::string& where);
/// Throws for the first key of an object that is not in `known`.
void require_known_keys(const json& from, const std::string& where, const std::vector<std::string>& known);
/// Throws unless `key` holds a version from 1 to `newest`; `name` is the file's.
void check_version(const json& document, const char* key, std::int64_t newest, const std::string& name);
/// `where` and `key` with a '.' between, or `key` alone.
std::string join_path(const std::string& where, std::string_view key);

template <class Enum>
requires std::is_enum_v<Enum> json json_of(Enum value) {
    return std::string(scene::enum_words<Enum>()[std::size_t(value)]);
}
template <class T>
json json_of(const std::optional<T>& value) {
    return value ? json_of(*value) : json(nullptr);
}

template <class Enum>
requires std::is_enum_v<Enum>
void read_value(const json& from, const Field&, const std::string& where, Enum& value) {
    value = Enum(read_word(from, where, scene::enum_words<Enum>()));
}
template <class T>
void read_value(const json& from, const Field& field, const std::string& where, std::optional<T>& value) {
    if (from.is_null()) {
        value.reset();
        return;
    }
    T present{};
    read_value(from, field, where, present);
    value = std::move(present);
}

/// Writes every field of a struct into `object`.
template <class T>
void write_fields(const T& from, json& object) {
    visit_fields(from,
                 [&](const Field& field, const auto& value) { object[std::string(field.name)] = json_of(value); });
}

/// The names of a struct's fields.
template <class T>
std::vector<std::string> field_names() {
    std::vector<std::string> names;
    const T example{};
    visit_fields(example, [&](const Field& field, const auto&) { names.emplace_back(field.name); });
    return names;
}

/// Reads the fields present in `object`; the others keep their values. Unknown keys are left to `require_known_keys`.
template <class T>
void read_present_fields(const json& object, const std::string& where, T& into) {
    require_object(object, where);
    visit_fields(into, [&](const Field& field, auto& value) {
        if (const auto found = object.find(std::string(field.name)); found != object.end()) {
            read_value(*found, field, join_path(where, field.name), value);
        }
    });
}

/// A struct of which `object` holds the fields and nothing else.
template <class T>
T read_fields(const json& object, const std::string& where) {
    T value{};
    require_object(object, where);
    require_known_keys(object, where, field_names<T>());
    read_present_fields(object, where, value);
    return value;
}

}  // namespace bruma::io
