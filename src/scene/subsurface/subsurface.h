#pragma once
#include <array>
#include <cstdint>

#include "scene/field.h"

namespace bruma::scene {

/// Analytic models of light that enters a body at one point and leaves it at another.
enum class SubsurfaceModel {
    standard_dipole,  ///< Jensen, Marschner, Levoy, Hanrahan, "A Practical Model for Subsurface Light Transport", 2001
    directional_dipole,  ///< Frisvad, Hachisuka, Kjeldsen, "Directional Dipole Model for Subsurface Scattering", 2014
    normalised_dipole,   ///< the same times the factor with which a half-space returns what random walks return
};
template <>
inline std::span<const std::string_view> enum_words<SubsurfaceModel>() {
    static constexpr std::array<std::string_view, 3> words{"standard_dipole", "directional_dipole",
                                                           "normalised_dipole"};
    return words;
}

/// The densities from which points where light enters are drawn.
enum class SubsurfaceSampling {
    core_tail,        ///< as narrow as the peak of the model and as wide as its tail; another one behind the body
    exponential_disk  ///< as published with the maps: e^(-sigma_tr rho) of the colour that spreads furthest
};
template <>
inline std::span<const std::string_view> enum_words<SubsurfaceSampling>() {
    static constexpr std::array<std::string_view, 2> words{"core_tail", "exponential_disk"};
    return words;
}

/// How the light inside a translucent mesh is computed: scattered radiosity maps (Dal Corso, Frisvad, Mosegaard,
/// Baerentzen, "Interactive Directional Subsurface Scattering and Transport of Emergent Light", 2016).
struct SubsurfaceSettings {
    SubsurfaceModel model = SubsurfaceModel::normalised_dipole;
    std::int64_t maps = 16;              ///< parallel cameras around the body; 0: each pixel by itself
    std::int64_t map_size = 256;         ///< texels along an edge of each
    std::int64_t light_map_size = 1024;  ///< texels along an edge of what each lamp sees
    std::int64_t samples = 8;            ///< points of light per lamp, texel and pass
    SubsurfaceSampling sampling = SubsurfaceSampling::core_tail;
    double noise = 0.01;      ///< passes are added until the standard error is below this share of the value
    bool whole_maps = false;  ///< also texels that no pixel of the picture looks up
    bool highlight = true;    ///< reflection at the surface on top
    bool unscattered = true;  ///< what shines straight through thin and weak matter
    bool operator==(const SubsurfaceSettings&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, SubsurfaceSettings>
void visit_fields(Self& settings, Visitor&& visit) {
    visit(Field{.name = "model",
                .sentence = "normalised_dipole: directional, returns as much light as measured; directional_dipole: as "
                            "published; standard_dipole: blind to the light's direction"},
          settings.model);
    visit(Field{.name = "maps",
                .sentence = "cameras around the body, each with a map of the light that leaves it; 0: each pixel by "
                            "itself, without texels in the way, anew in every picture",
                .min = 0,
                .max = 32,
                .panel_min = 1,
                .panel_max = 32},
          settings.maps);
    visit(Field{.name = "map_size",
                .sentence = "texels along an edge of each map",
                .min = 16,
                .max = 4096,
                .panel_min = 64,
                .panel_max = 1024,
                .logarithmic = true},
          settings.map_size);
    visit(Field{.name = "light_map_size",
                .sentence = "texels along an edge of what each lamp sees; best below 1 / (4 sigma_t')",
                .min = 16,
                .max = 8192,
                .panel_min = 128,
                .panel_max = 4096,
                .logarithmic = true},
          settings.light_map_size);
    visit(Field{.name = "samples",
                .sentence = "points where light enters, per lamp, texel and pass",
                .min = 1,
                .max = 256,
                .panel_min = 1,
                .panel_max = 64},
          settings.samples);
    visit(Field{.name = "sampling",
                .sentence = "where these points are drawn; core_tail: where the model needs them; exponential_disk: as "
                            "published, for comparison"},
          settings.sampling);
    visit(Field{.name = "noise",
                .sentence = "no more passes once the standard error is below this share of the local value",
                .min = 0.0,
                .max = 1.0,
                .panel_min = 0.001,
                .panel_max = 0.1,
                .logarithmic = true},
          settings.noise);
    visit(Field{.name = "whole_maps",
                .sentence = "work out all texels of the maps, not only those that the picture looks up: dearer at "
                            "first, and a camera that goes around finds them ready"},
          settings.whole_maps);
    visit(Field{.name = "highlight", .sentence = "reflection at the surface, on top of the light from inside"},
          settings.highlight);
    visit(Field{.name = "unscattered", .sentence = "what shines straight through where matter is thin or weak"},
          settings.unscattered);
}

}  // namespace bruma::scene
