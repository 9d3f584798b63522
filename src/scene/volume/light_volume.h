#pragma once
#include <array>
#include <cstdint>

#include "scene/field.h"

namespace bruma::scene {

/// How light is carried from slice to slice of a light volume.
enum class SweepMode { physical, paper };
template <>
inline std::span<const std::string_view> enum_words<SweepMode>() {
    static constexpr std::array<std::string_view, 2> words{"physical", "paper"};
    return words;
}

/// Size of a light volume beside the data.
enum class LightResolution { full, half, quarter };
template <>
inline std::span<const std::string_view> enum_words<LightResolution>() {
    static constexpr std::array<std::string_view, 3> words{"full", "half", "quarter"};
    return words;
}

/// What a light volume keeps in memory; the sweep itself is always in single precision.
enum class LightPrecision { half, single };
template <>
inline std::span<const std::string_view> enum_words<LightPrecision>() {
    static constexpr std::array<std::string_view, 2> words{"half", "single"};
    return words;
}

/// How the light inside a volume is computed (lighting light_volume and shadow_rays): a grid of light, swept away from
/// each light (Ropinski, Doering, Rezk-Salama, Interactive Volumetric Lighting Simulating Scattering and Shadowing,
/// PacificVis 2010), or a shadow ray for each of its cells.
struct LightVolumeSettings {
    SweepMode mode = SweepMode::physical;
    LightResolution resolution = LightResolution::half;
    LightPrecision precision = LightPrecision::half;
    bool diffuse = true;  ///< physical: light scattered more than once, forward only
    /// physical: standard deviation of the sideways step that each scattering makes, as a share of the volume's longest
    /// edge; n scatterings spread light by sqrt(n) times as much, at any resolution.
    double spread = 0.03;
    std::int64_t near_steps = 2;  ///< samples of the data towards the light at each lookup, below the grid's resolution
    double cone_angle_deg = 30.0;  ///< paper: half-angle of the kernel
    bool soft_shadows = false;     ///< paper: blur attenuated light with the same kernel
    /// Slices swept by one launch; 0: chosen by their size. Changes the cost only.
    std::int64_t slices_per_dispatch = 0;
    bool operator==(const LightVolumeSettings&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, LightVolumeSettings>
void visit_fields(Self& settings, Visitor&& visit) {
    visit(Field{.name = "mode",
                .sentence =
                    "physical: three axes, energy kept; paper: Ropinski et al. 2010, a look with coloured bleeding"},
          settings.mode);
    visit(Field{.name = "resolution", .sentence = "cells of light along each edge, beside the data"},
          settings.resolution);
    visit(Field{.name = "precision", .sentence = "what is kept of each cell: 16 or 32 bits a number"},
          settings.precision);
    visit(Field{.name = "diffuse", .sentence = "physical: add light scattered more than once (forward only)"},
          settings.diffuse);
    visit(Field{.name = "spread",
                .sentence = "physical: sideways step of each scattering, as a share of the volume's longest edge",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 0.2},
          settings.spread);
    visit(Field{.name = "near_steps",
                .sentence = "samples of the data towards the light at each lookup, for shadows finer than the grid",
                .min = 0,
                .max = 8,
                .panel_max = 8},
          settings.near_steps);
    visit(Field{.name = "cone_angle",
                .unit = "deg",
                .sentence = "paper: half-angle of the cone from which light is gathered",
                .min = 1.0,
                .max = 80.0,
                .panel_min = 5.0,
                .panel_max = 60.0},
          settings.cone_angle_deg);
    visit(Field{.name = "soft_shadows", .sentence = "paper: blur shadows as the scattered light is blurred"},
          settings.soft_shadows);
    visit(Field{.name = "slices_per_dispatch",
                .sentence = "slices swept by one launch on the GPU, 0: chosen; changes the time, not the picture",
                .min = 0,
                .max = 4096,
                .panel_max = 64.0},
          settings.slices_per_dispatch);
}

}  // namespace bruma::scene
