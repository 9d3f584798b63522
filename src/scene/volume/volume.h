#pragma once
#include <memory>
#include <string>

#include "base/revision.h"
#include "scene/volume/light_volume.h"
#include "scene/volume/transfer_function.h"
#include "scene/volume/volume_grid.h"

namespace bruma::scene {

enum class Endian { little, big };
template <>
inline std::span<const std::string_view> enum_words<Endian>() {
    static constexpr std::array<std::string_view, 2> words{"little", "big"};
    return words;
}

/// Where a volume's samples come from, and what a headerless file does not say. Empty parts are found out from the
/// file name, a sidecar .json or the data.
struct VolumeSource {
    std::string file;  ///< path (relative to the scene file when read from one) or builtin:NAME
    std::optional<glm::ivec3> size;
    std::optional<VoxelType> type;
    std::optional<glm::dvec3> spacing;  ///< metres; 1 mm when nothing tells
    std::optional<Endian> endian;
    std::optional<std::int64_t> offset;  ///< bytes before the first sample
    bool operator==(const VolumeSource&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, VolumeSource>
void visit_fields(Self& source, Visitor&& visit) {
    visit(Field{.name = "file", .sentence = "path of the samples, relative to the scene file, or builtin:NAME"},
          source.file);
    visit(Field{.name = "size", .sentence = "samples along x, y, z; null: find out", .min = 1}, source.size);
    visit(Field{.name = "type", .sentence = "type of a sample; null: find out"}, source.type);
    visit(Field{.name = "spacing", .unit = "m", .sentence = "length between samples; null: find out", .min = 0.0},
          source.spacing);
    visit(Field{.name = "endian", .sentence = "byte order of the file"}, source.endian);
    visit(Field{.name = "offset", .unit = "byte", .sentence = "bytes before the first sample", .min = 0},
          source.offset);
}

/// Where the light that a volume scatters to the eye comes from.
enum class VolumeLighting { none, gradient, light_volume, shadow_rays, path_traced };
template <>
inline std::span<const std::string_view> enum_words<VolumeLighting>() {
    static constexpr std::array<std::string_view, 5> words{"none", "gradient", "light_volume", "shadow_rays",
                                                           "path_traced"};
    return words;
}
/// Whether light is scattered by a phase function, with shadows.
inline bool scatters(VolumeLighting lighting) {
    return lighting == VolumeLighting::light_volume || lighting == VolumeLighting::shadow_rays ||
           lighting == VolumeLighting::path_traced;
}

/// Exponent law of the highlight: angle to the mirrored light (Phong) or to the half vector (Blinn-Phong).
enum class Highlight { phong, blinn_phong };
template <>
inline std::span<const std::string_view> enum_words<Highlight>() {
    static constexpr std::array<std::string_view, 2> words{"phong", "blinn_phong"};
    return words;
}

/// How light is turned into the source radiance S (per unit of extinction) of the emission-absorption integral. With C
/// the colour and e the emission of the transfer function:
///
///     none       S = C + e C
///     gradient   S = C (ambient + diffuse sum of E |n.l| / pi) + specular sum of E highlight / pi + e C, where there
///     is
///                a surface; C + e C elsewhere
///     others     S = w (sum of E p(cos) T + what was scattered more than once) + e C,   w = albedo C, at most 1
///
/// E is a light's irradiance across its beam, T the transmittance to it, p the phase function of Henyey and Greenstein
/// (Astrophysical Journal 93, 1941), normalised to 1 over the sphere. e is the transfer function's emission +
/// `emission`.
struct VolumeOptics {
    VolumeLighting lighting = VolumeLighting::none;
    glm::dvec3 albedo{1.0};  ///< share of the light met that is scattered, times the transfer function's colour; 0..1
    double g = 0.0;          ///< mean cosine of scattering, -0.99 (back) .. 0.99 (forward)
    double emission = 0.0;   ///< added to the transfer function's emission, in units of its colour
    bool surfaces = false;  ///< light_volume, shadow_rays: shade surfaces by the gradient too, highlights in shadow too
    Highlight highlight = Highlight::blinn_phong;
    double density_scale = 1.0;         ///< multiplies the extinction
    double ambient = 0.15;              ///< share of the colour seen without light
    double diffuse = 0.85;              ///< share of the colour under a light of unit irradiance at normal incidence
    double specular = 0.2;              ///< strength of the highlight, in the light's colour
    double shininess = 30.0;            ///< exponent of the highlight
    bool two_sided = true;              ///< light both sides of thin sheets: |n.l| instead of max(n.l, 0)
    double gradient_soft_from = 0.002;  ///< gradients below this are unshaded, as a share of shading_range per voxel
    double gradient_soft_to = 0.02;     ///< gradients above this are fully shaded; smooth in between
    bool operator==(const VolumeOptics&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, VolumeOptics>
void visit_fields(Self& optics, Visitor&& visit) {
    visit(Field{.name = "lighting",
                .sentence =
                    "none: colour as it is; gradient: surfaces lit by their normals; light_volume: scattering with "
                    "shadows; shadow_rays: hard shadows; path_traced: all of the light, slowly"},
          optics.lighting);
    visit(Field{.name = "albedo",
                .sentence =
                    "share of light that is scattered on, not absorbed; multiplies the transfer function's colour",
                .min = 0.0,
                .max = 1.0,
                .is_color = true},
          optics.albedo);
    visit(Field{.name = "g",
                .sentence = "mean cosine of scattering: -1 back to the light, 0 to all sides alike, 1 straight on",
                .min = -0.99,
                .max = 0.99,
                .panel_min = -0.95,
                .panel_max = 0.95},
          optics.g);
    visit(Field{.name = "emission",
                .sentence = "light of its own, added to the transfer function's, in units of its colour",
                .min = 0.0,
                .max = 1e6,
                .panel_max = 4.0},
          optics.emission);
    visit(
        Field{.name = "surfaces", .sentence = "with light_volume or shadow_rays: shade surfaces by their normals too"},
        optics.surfaces);
    visit(Field{.name = "highlight", .sentence = "exponent law of the highlight"}, optics.highlight);
    visit(Field{.name = "density_scale",
                .sentence = "multiplies the extinction everywhere",
                .min = 0.0,
                .max = 1e9,
                .panel_min = 0.01,
                .panel_max = 100.0,
                .logarithmic = true},
          optics.density_scale);
    visit(Field{.name = "ambient",
                .sentence = "share of the colour seen without light",
                .min = 0.0,
                .max = 10.0,
                .panel_max = 1.0},
          optics.ambient);
    visit(Field{.name = "diffuse",
                .sentence = "share of the colour under full light",
                .min = 0.0,
                .max = 10.0,
                .panel_max = 1.0},
          optics.diffuse);
    visit(Field{.name = "specular", .sentence = "strength of the highlight", .min = 0.0, .max = 10.0, .panel_max = 1.0},
          optics.specular);
    visit(Field{.name = "shininess",
                .sentence = "exponent of the highlight: larger is smaller and sharper",
                .min = 1.0,
                .max = 1000.0,
                .panel_min = 1.0,
                .panel_max = 200.0,
                .logarithmic = true},
          optics.shininess);
    visit(Field{.name = "two_sided", .sentence = "light both sides of thin sheets"}, optics.two_sided);
    visit(Field{.name = "gradient_soft_from",
                .sentence = "gradients below this share of the window per voxel are left unshaded",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 0.1},
          optics.gradient_soft_from);
    visit(Field{.name = "gradient_soft_to",
                .sentence = "gradients above this share of the window per voxel are fully shaded",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 0.2},
          optics.gradient_soft_to);
}

/// The part of a volume that is shown, in texture space [0,1]^3.
struct ClipBox {
    glm::dvec3 low{0.0}, high{1.0};
    bool operator==(const ClipBox&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, ClipBox>
void visit_fields(Self& clip, Visitor&& visit) {
    visit(Field{.name = "low",
                .sentence = "lower corner of the shown part, 0..1 along each axis",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 1.0},
          clip.low);
    visit(Field{.name = "high",
                .sentence = "upper corner of the shown part, 0..1 along each axis",
                .min = 0.0,
                .max = 1.0,
                .panel_max = 1.0},
          clip.high);
}

/// A measured volume and how it is shown. Model space: metres, the box centred on the origin, axes of the data.
struct Volume {
    VolumeSource source;
    Tracked<std::shared_ptr<const VolumeGrid>> grid;  ///< never null in a scene that is ready to render
    Tracked<TransferFunction> transfer_function;
    Tracked<VolumeOptics> optics;
    Tracked<ClipBox> clip;
    Tracked<LightVolumeSettings> light_volume;
};

/// Data value at both ends of the transfer function: its window, else the data's range without outliers, widened if
/// empty.
std::array<double, 2> effective_window(const Volume& volume);
/// What a difference between samples is compared with before it is shaded as a surface: the width of the window, or of
/// the data's range without outliers where that is less. 0 for constant data.
double shading_range(const Volume& volume);

}  // namespace bruma::scene
