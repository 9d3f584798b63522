#pragma once
#include <array>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

enum class LightKind { headlight, directional, point };
template <>
inline std::span<const std::string_view> enum_words<LightKind>() {
    static constexpr std::array<std::string_view, 3> words{"headlight", "directional", "point"};
    return words;
}

/// Light from outside. Colour times intensity is irradiance (headlight, directional) or, for a point light, the
/// irradiance at 1 m, falling with the square of the distance.
struct Light {
    LightKind kind = LightKind::directional;
    glm::dvec3 direction_world{-0.4, 0.8, 0.6};  ///< directional: from the scene towards the light
    glm::dvec3 position_world{1.0, 1.0, 1.0};    ///< point: metres
    glm::dvec3 color{1.0};                       ///< linear Rec.709
    double intensity = 1.0;
    bool on = true;
    bool operator==(const Light&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Light>
void visit_fields(Self& light, Visitor&& visit) {
    visit(Field{.name = "kind", .sentence = "headlight: shines along the view; directional: from far away; point"},
          light.kind);
    visit(Field{.name = "direction", .sentence = "directional: from the scene towards the light"},
          light.direction_world);
    visit(Field{.name = "position", .unit = "m", .sentence = "point: where it stands"}, light.position_world);
    visit(Field{.name = "color", .sentence = "linear red, green, blue", .min = 0.0, .max = 1e6, .is_color = true},
          light.color);
    visit(Field{.name = "intensity",
                .sentence = "irradiance for colour 1; of a point light, at a distance of 1 m",
                .min = 0.0,
                .max = 1e9,
                .panel_max = 5.0},
          light.intensity);
    visit(Field{.name = "on", .sentence = "whether it shines"}, light.on);
}

}  // namespace bruma::scene
