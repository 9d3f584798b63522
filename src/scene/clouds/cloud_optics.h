#pragma once
#include <array>
#include <cstdint>

#include "scene/field.h"

namespace bruma::scene {

/// physical: radiative transfer with scattering octaves; artistic: the repaired look of Alaminos 2020, which conserves
/// nothing and is no phase function.
enum class CloudLighting { physical, artistic };
template <>
inline std::span<const std::string_view> enum_words<CloudLighting>() {
    static constexpr std::array<std::string_view, 2> words{"physical", "artistic"};
    return words;
}

/// artistic: the darkening of thin cloud as printed, which makes it black from all sides, or only away from the sun.
enum class CloudPowder { everywhere, away_from_sun };
template <>
inline std::span<const std::string_view> enum_words<CloudPowder>() {
    static constexpr std::array<std::string_view, 2> words{"everywhere", "away_from_sun"};
    return words;
}

/// physical: light that is scattered more than once: a fit to random paths that leaks out of clouds as diffusing light
/// does, or the octaves of Wrenninge 2013, which lose it in thick clouds and make it in thin ones.
enum class MultipleScattering { diffusion, octaves };
template <>
inline std::span<const std::string_view> enum_words<MultipleScattering>() {
    static constexpr std::array<std::string_view, 2> words{"diffusion", "octaves"};
    return words;
}

/// How a cloud extinguishes and scatters light, for both models of lighting.
struct CloudOptics {
    CloudLighting lighting = CloudLighting::physical;
    double extinction_per_m = 0.05;  ///< of density 1; real cumulus 0.02 to 0.12, cirrus 1e-4 to 1e-3
    double albedo = 1.0;             ///< share of the extinguished light that is scattered; droplets: above 0.9999

    double forward_g = 0.8;      ///< physical: Henyey-Greenstein asymmetry of the forward lobe
    double backward_g = -0.2;    ///< and of the other lobe
    double forward_share = 0.5;  ///< weight of the forward lobe
    MultipleScattering multiple_scattering = MultipleScattering::diffusion;
    std::int64_t octaves = 8;        ///< octaves: terms; 1 is single scattering
    double octave_strength = 0.5;    ///< a: factor of each term; at most octave_extinction, else energy is made
    double octave_extinction = 0.5;  ///< b: factor of the optical depth
    double octave_anisotropy = 0.5;  ///< c: factor of both asymmetries
    double ambient = 1.0;            ///< factor of light from sky and ground

    double in_scatter = 0.2;        ///< artistic: asymmetry of the lobe towards the sun, [0, 0.95]
    double out_scatter = 0.1;       ///< asymmetry of the lobe away from it, [0, 0.95]
    double in_out_mix = 0.5;        ///< 0: towards the sun only; 1: away only
    double silver_intensity = 3.0;  ///< of the rim around the sun
    double silver_exponent = 2.0;
    double absorption = 6.0;  ///< b: per reference length at density 1
    double reference_length_m = 1000.0;
    CloudPowder powder = CloudPowder::away_from_sun;

    double cone_length = 0.4;   ///< sun samples: reach of the first five, in thicknesses of the layer
    double cone_far = 4.0;      ///< reach of the sixth, in lengths of the cone
    double cone_spread = 0.15;  ///< tangent of half the angle of the cone
    bool operator==(const CloudOptics&) const = default;
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, CloudOptics>
void visit_fields(Self& optics, Visitor&& visit) {
    const auto number = [](std::string_view name, std::string_view sentence, double min, double max, double panel_max) {
        return Field{
            .name = name, .sentence = sentence, .min = min, .max = max, .panel_min = min, .panel_max = panel_max};
    };
    visit(Field{.name = "lighting", .sentence = "physical: transfer of light; artistic: a look that conserves nothing"},
          optics.lighting);
    visit(Field{.name = "extinction",
                .unit = "1/m",
                .sentence = "extinction at density 1; cumulus 0.02 to 0.12, cirrus 1e-4 to 1e-3",
                .min = 0.0,
                .max = 1e6,
                .panel_min = 1e-4,
                .panel_max = 0.2,
                .logarithmic = true},
          optics.extinction_per_m);
    visit(number("albedo", "share of the extinguished light that is scattered", 0.0, 1.0, 1.0), optics.albedo);
    visit(number("forward_g", "physical: asymmetry of the forward lobe", -0.95, 0.95, 0.95), optics.forward_g);
    visit(number("backward_g", "physical: asymmetry of the other lobe", -0.95, 0.95, 0.95), optics.backward_g);
    visit(number("forward_share", "physical: weight of the forward lobe", 0.0, 1.0, 1.0), optics.forward_share);
    visit(Field{.name = "multiple_scattering",
                .sentence = "physical: a fit that diffuses through thick clouds, or octaves, which do not"},
          optics.multiple_scattering);
    visit(number("octaves", "octaves: how many; 1 is single scattering", 1.0, 16.0, 16.0), optics.octaves);
    visit(number("octave_strength", "octaves: strength of each term to the one before; at most octave_extinction", 0.0,
                 1.0, 1.0),
          optics.octave_strength);
    visit(number("octave_extinction", "octaves: optical depth of each term to the one before", 0.0, 1.0, 1.0),
          optics.octave_extinction);
    visit(number("octave_anisotropy", "octaves: asymmetry of each term to the one before", 0.0, 1.0, 1.0),
          optics.octave_anisotropy);
    visit(number("ambient", "factor of the light from sky and ground", 0.0, 100.0, 2.0), optics.ambient);
    visit(number("in_scatter", "artistic: asymmetry of the lobe towards the sun", 0.0, 0.95, 0.95), optics.in_scatter);
    visit(number("out_scatter", "artistic: asymmetry of the lobe away from the sun", 0.0, 0.95, 0.95),
          optics.out_scatter);
    visit(number("in_out_mix", "artistic: 0 is the lobe towards the sun only, 1 the other only", 0.0, 1.0, 1.0),
          optics.in_out_mix);
    visit(number("silver_intensity", "artistic: strength of the rim around the sun", 0.0, 1000.0, 10.0),
          optics.silver_intensity);
    visit(number("silver_exponent", "artistic: larger makes the rim smaller", 0.0, 1000.0, 20.0),
          optics.silver_exponent);
    visit(number("absorption", "artistic: absorption per reference length at density 1", 0.0, 1e6, 20.0),
          optics.absorption);
    visit(Field{.name = "reference_length",
                .unit = "m",
                .sentence = "artistic: length over which absorption counts",
                .min = 1e-3,
                .max = 1e7,
                .panel_min = 10.0,
                .panel_max = 10000.0,
                .logarithmic = true},
          optics.reference_length_m);
    visit(
        Field{.name = "powder", .sentence = "artistic: thin cloud is dark from everywhere, or only away from the sun"},
        optics.powder);
    visit(number("cone_length", "reach of the first five sun samples, in thicknesses of the layer", 0.0, 10.0, 1.0),
          optics.cone_length);
    visit(number("cone_far", "reach of the sixth sun sample, in lengths of the cone", 1.0, 100.0, 8.0),
          optics.cone_far);
    visit(number("cone_spread", "tangent of half the angle of the cone of sun samples", 0.0, 1.0, 0.5),
          optics.cone_spread);
}

/// Mean cosine of a scattering by the two lobes.
inline double mean_asymmetry(const CloudOptics& optics) {
    return optics.forward_share * optics.forward_g + (1.0 - optics.forward_share) * optics.backward_g;
}

}  // namespace bruma::scene
