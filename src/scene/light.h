#pragma once
#include <array>
#include <glm/glm.hpp>
#include <numbers>

#include "scene/field.h"

namespace bruma::scene {

enum class LightKind { headlight, directional, point, spot };
template <>
inline std::span<const std::string_view> enum_words<LightKind>() {
    static constexpr std::array<std::string_view, 4> words{"headlight", "directional", "point", "spot"};
    return words;
}

/// Light of known direction. Colour times intensity is the irradiance on a plane across the beam, W/m^2 (headlight,
/// directional), or the radiant intensity, W/sr, which is the irradiance at 1 m and falls with the square of the
/// distance (point, spot). A white Lambert surface under irradiance pi has radiance 1, hence the default.
struct Light {
    LightKind kind = LightKind::directional;
    glm::dvec3 direction_world{-0.4, 0.8, 0.6};  ///< directional, spot: against the beam, from the scene to the light
    glm::dvec3 position_world{1.0, 1.0, 1.0};    ///< point, spot: metres
    double spot_angle_deg = 25.0;                ///< spot: between the axis and the edge of the cone
    double spot_softness = 0.2;                  ///< spot: share of the angle over which the edge fades
    glm::dvec3 color{1.0};                       ///< linear Rec.709
    double intensity = std::numbers::pi;
    bool on = true;
    bool operator==(const Light&) const = default;
};

/// Light as it arrives at one point.
struct Incident {
    glm::dvec3 toward_world{0.0, 0.0, 1.0};  ///< unit, to the light
    double distance = 0.0;                   ///< metres to the light; infinite for parallel light
    glm::dvec3 irradiance{0.0};  ///< across the beam, unoccluded; 0 in the light itself and outside its cone
};
/// `camera_back_world`, unit, from the scene to the eye, is where a headlight shines from.
Incident incident_light(const Light& light, glm::dvec3 point_world, glm::dvec3 camera_back_world);

/// Share of a spot's intensity at an angle from its axis: 1 inside, smoothstep of the cosine over the soft edge, 0
/// outside.
double spot_share(const Light& light, double cosine_to_axis);

/// Whether a light adds anything anywhere.
bool shines(const Light& light);
/// Whether all of its light comes from one place.
inline bool has_position(const Light& light) {
    return light.kind == LightKind::point || light.kind == LightKind::spot;
}

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Light>
void visit_fields(Self& light, Visitor&& visit) {
    visit(Field{.name = "kind",
                .sentence =
                    "headlight: shines along the view; directional: from far away; point: to all sides; spot: a cone"},
          light.kind);
    visit(Field{.name = "direction", .sentence = "directional, spot: from the scene towards the light"},
          light.direction_world);
    visit(Field{.name = "position", .unit = "m", .sentence = "point, spot: where it stands"}, light.position_world);
    visit(Field{.name = "spot_angle",
                .unit = "deg",
                .sentence = "spot: angle between the axis and the edge of the cone",
                .min = 0.1,
                .max = 179.0,
                .panel_min = 1.0,
                .panel_max = 90.0},
          light.spot_angle_deg);
    visit(Field{.name = "spot_softness",
                .sentence = "spot: share of the angle over which its edge fades",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 1.0},
          light.spot_softness);
    visit(Field{.name = "color", .sentence = "linear red, green, blue", .min = 0.0, .max = 1e6, .is_color = true},
          light.color);
    visit(Field{.name = "intensity",
                .unit = "W/m2",
                .sentence = "irradiance for colour 1, pi makes white surfaces as bright as colour 1; point, spot: W/sr",
                .min = 0.0,
                .max = 1e12,
                .panel_min = 0.01,
                .panel_max = 100.0,
                .logarithmic = true},
          light.intensity);
    visit(Field{.name = "on", .sentence = "whether it shines"}, light.on);
}

}  // namespace bruma::scene
