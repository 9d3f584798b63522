#pragma once
#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

/// How the transfer function meets the data along a ray.
enum class Classification { post, preintegrated };
template <>
inline std::span<const std::string_view> enum_words<Classification>() {
    static constexpr std::array<std::string_view, 2> words{"post", "preintegrated"};
    return words;
}

enum class Jitter { off, hashed, blue_noise };
template <>
inline std::span<const std::string_view> enum_words<Jitter>() {
    static constexpr std::array<std::string_view, 3> words{"off", "hashed", "blue_noise"};
    return words;
}

/// What a picture costs and how exact it is.
struct RenderSettings {
    Classification classification = Classification::preintegrated;
    bool refine = true;  ///< preintegrated: cut segments finer where the data bend under the transfer function
    double step = 1.0;   ///< length of a segment of the march, in voxels (smallest spacing in world space)
    bool empty_space_skipping = true;  ///< changes no bit of the picture
    bool early_termination = true;
    double stop_transmittance = 1.0 / 1024.0;  ///< rays end below this; error at most this times the largest radiance
    Jitter jitter = Jitter::off;
    std::int64_t samples = 4;  ///< places in each pixel where meshes are asked for; 1: their edges are not smoothed
    std::int64_t shadow_map_size = 1024;  ///< texels along an edge of what each lamp sees of all meshes; 0: no shadows
    bool operator==(const RenderSettings&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, RenderSettings>
void visit_fields(Self& settings, Visitor&& visit) {
    visit(Field{.name = "classification",
                .sentence = "post: transfer function at points; preintegrated: exactly over each segment"},
          settings.classification);
    visit(Field{.name = "refine",
                .sentence = "preintegrated: cut a segment into halves or eighths where the data bend and it shows"},
          settings.refine);
    visit(Field{.name = "step",
                .unit = "voxel",
                .sentence = "length of a segment of the march",
                .min = 0.01,
                .max = 64.0,
                .panel_min = 0.1,
                .panel_max = 8.0,
                .logarithmic = true},
          settings.step);
    visit(Field{.name = "empty_space_skipping", .sentence = "leap over what is transparent; changes no bit"},
          settings.empty_space_skipping);
    visit(Field{.name = "early_termination", .sentence = "end rays behind opaque matter"}, settings.early_termination);
    visit(Field{.name = "stop_transmittance",
                .sentence = "rays end below this transmittance; the error is at most this times the largest radiance",
                .min = 0.0,
                .max = 1.0,
                .panel_min = 1e-5,
                .panel_max = 0.1,
                .logarithmic = true},
          settings.stop_transmittance);
    visit(Field{.name = "jitter", .sentence = "shift each ray's first segment to trade bands for grain"},
          settings.jitter);
    visit(
        Field{.name = "samples",
              .sentence = "places in each pixel where meshes cover it or not; 1: their edges are stairs; at most what "
                          "the driver has",
              .min = 1,
              .max = 16,
              .panel_min = 1,
              .panel_max = 8},
        settings.samples);
    visit(Field{.name = "shadow_map_size",
                .sentence = "texels along an edge of what each lamp sees of all meshes; 0: meshes cast no shadows",
                .min = 0,
                .max = 8192,
                .panel_min = 0,
                .panel_max = 4096},
          settings.shadow_map_size);
}

/// What is seen where nothing is: vertical blend between two colours, linear Rec.709.
struct Background {
    glm::dvec3 top{0.0};
    glm::dvec3 bottom{0.0};
    bool operator==(const Background&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Background>
void visit_fields(Self& background, Visitor&& visit) {
    visit(Field{.name = "top", .sentence = "linear colour at the upper edge", .min = 0.0, .max = 1e6, .is_color = true},
          background.top);
    visit(
        Field{
            .name = "bottom", .sentence = "linear colour at the lower edge", .min = 0.0, .max = 1e6, .is_color = true},
        background.bottom);
}

/// Light of one radiance from all sides. It is not seen directly: what is seen behind all is the background.
struct Environment {
    glm::dvec3 radiance{0.0};  ///< linear Rec.709, W/(m^2 sr)
    bool operator==(const Environment&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Environment>
void visit_fields(Self& environment, Visitor&& visit) {
    visit(Field{.name = "radiance",
                .unit = "W/(m2 sr)",
                .sentence = "light from all sides, for path_traced lighting and references",
                .min = 0.0,
                .max = 1e6,
                .is_color = true},
          environment.radiance);
}

enum class ToneMap { none, filmic };
template <>
inline std::span<const std::string_view> enum_words<ToneMap>() {
    static constexpr std::array<std::string_view, 2> words{"none", "filmic"};
    return words;
}

/// From linear radiance to the display, once, in `composite`.
struct Display {
    double exposure_ev = 0.0;  ///< radiance is multiplied by 2^exposure
    ToneMap tone_map = ToneMap::none;
    bool dither = true;  ///< half a step of 8-bit noise against bands
    bool operator==(const Display&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, Display>
void visit_fields(Self& display, Visitor&& visit) {
    visit(Field{.name = "exposure",
                .unit = "EV",
                .sentence = "radiance is multiplied by 2 to this power",
                .min = -32.0,
                .max = 32.0,
                .panel_min = -6.0,
                .panel_max = 6.0},
          display.exposure_ev);
    visit(Field{.name = "tone_map", .sentence = "none: clip at 1; filmic: bend highlights softly"}, display.tone_map);
    visit(Field{.name = "dither", .sentence = "hide 8-bit bands under half a step of noise"}, display.dither);
}

}  // namespace bruma::scene
