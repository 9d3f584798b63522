#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/revision.h"
#include "scene/field.h"
#include "scene/volume/transfer_function.h"

/// Widgets for any struct of the table of parameters (scene/field.h): its name, unit, range and sentence say all that
/// is needed. Lengths in metres are shown in millimetres, and colours, which are stored linear, by their sRGB values.
namespace bruma::app {

using scene::Field;

/// One widget each; return whether the value changed. Values stay within the field's range.
bool edit_value(const Field& field, bool& value);
bool edit_value(const Field& field, double& value);
bool edit_value(const Field& field, std::int64_t& value);
bool edit_value(const Field& field, std::string& value);
bool edit_value(const Field& field, glm::dvec3& value);
bool edit_value(const Field& field, glm::ivec3& value);
bool edit_value(const Field& field, std::array<double, 2>& value);
/// A menu of words.
bool edit_word(const Field& field, std::span<const std::string_view> words, std::size_t& index);
/// Curves have an editor of their own.
template <class Point>
bool edit_value(const Field&, std::vector<Point>&) {
    return false;
}
template <class Enum>
requires std::is_enum_v<Enum>
bool edit_value(const Field& field, Enum& value) {
    auto index = std::size_t(value);
    const bool changed = edit_word(field, scene::enum_words<Enum>(), index);
    value = Enum(index);
    return changed;
}
template <class T>
bool edit_value(const Field& field, std::optional<T>& value) {
    return value && edit_value(field, *value);
}

/// A name from the table as people read it: "soft from" for "soft_from".
std::string readable(std::string_view name);

/// Whether a sentence opens with words of an enumeration but not with the chosen one, as in "point, spot: where it
/// stands".
bool is_for_another_word(std::string_view sentence, std::span<const std::string_view> words, std::size_t chosen);

struct IgnoreField {
    void operator()(const Field&) const {}
};

/// Widgets for all fields for which `wanted(field)` holds, but not for those that only serve another choice of an
/// enumeration than the present one. `drawn(field)` is called after each.
template <class T, class Wanted, class Drawn = IgnoreField>
bool edit_fields(T& value, Wanted&& wanted, Drawn&& drawn = {}) {
    bool changed = false;
    std::vector<std::pair<std::span<const std::string_view>, std::size_t>> choices;
    visit_fields(value, [&](const Field& field, auto& part) {
        using Part = std::remove_cvref_t<decltype(part)>;
        for (const auto& [words, chosen] : choices) {
            if (is_for_another_word(field.sentence, words, chosen)) {
                return;
            }
        }
        if (wanted(field)) {
            changed = edit_value(field, part) || changed;
            drawn(field);
        }
        if constexpr (std::is_enum_v<Part>) {
            choices.emplace_back(scene::enum_words<Part>(), std::size_t(part));
        }
    });
    return changed;
}

/// The same on a tracked value, which becomes newer only if it differs afterwards.
template <class T, class Wanted, class Drawn = IgnoreField>
bool edit_tracked(Tracked<T>& tracked, Wanted&& wanted, Drawn&& drawn = {}) {
    T copy = *tracked;
    return edit_fields(copy, wanted, drawn) && tracked.set(std::move(copy));
}
template <class T>
bool edit_tracked(Tracked<T>& tracked) {
    return edit_tracked(tracked, [](const Field&) { return true; });
}

/// A direction by two sliders, azimuth and elevation about +y in degrees; its length becomes 1 when it is turned.
bool edit_direction(glm::dvec3& direction);

/// Shows the words while the pointer rests on the last widget.
void tooltip(std::string_view words);

/// The sRGB value of a linear one and back; values above 1 go on along the curve.
double srgb_of_linear(double linear);
/// Linear values of three encoded ones.
glm::dvec3 linear_of_encoded(const float* encoded);
/// Three linear numbers as a colour button with a picker.
bool edit_color(const char* label, glm::dvec3& linear);

}  // namespace bruma::app
