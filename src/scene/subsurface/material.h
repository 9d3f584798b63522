#pragma once
#include <array>
#include <glm/glm.hpp>

#include "scene/field.h"

namespace bruma::scene {

/// Matter that light enters and scatters in, per linear red, green and blue. Lengths are in millimetres, the unit of
/// the published tables and of the BSSRDF.
struct SubsurfaceMedium {
    glm::dvec3 reduced_scattering{0.0};  ///< sigma_s' = sigma_s (1 - g), 1/mm
    glm::dvec3 absorption{0.0};          ///< sigma_a, 1/mm
    glm::dvec3 asymmetry{0.0};           ///< mean cosine g of the scattering angle; 0 where only sigma_s' was measured
    double refraction_index = 1.3;       ///< eta, inside over outside
    bool operator==(const SubsurfaceMedium&) const = default;

    /// sigma_t' = sigma_a + sigma_s', 1/mm. Its inverse is the transport mean free path.
    glm::dvec3 reduced_extinction() const { return absorption + reduced_scattering; }
    /// sigma_s = sigma_s' / (1 - g), 1/mm.
    glm::dvec3 scattering() const { return reduced_scattering / (1.0 - asymmetry); }
    /// sigma_tr = sqrt(3 sigma_a sigma_t'), 1/mm; 0 without absorption. Its inverse is how far light spreads.
    glm::dvec3 effective_transport() const { return glm::sqrt(3.0 * absorption * reduced_extinction()); }
};

template <class Self, class Visitor>
requires std::same_as<std::remove_const_t<Self>, SubsurfaceMedium>
void visit_fields(Self& medium, Visitor&& visit) {
    visit(Field{.name = "reduced_scattering",
                .unit = "1/mm",
                .sentence = "custom: scattering times (1 - asymmetry), for red, green, blue",
                .min = 0.0,
                .max = 1e6},
          medium.reduced_scattering);
    visit(Field{.name = "absorption",
                .unit = "1/mm",
                .sentence = "custom: absorption, for red, green, blue",
                .min = 0.0,
                .max = 1e6},
          medium.absorption);
    visit(Field{.name = "asymmetry",
                .sentence = "custom: mean cosine of the scattering angle, for red, green, blue",
                .min = -0.99,
                .max = 0.99},
          medium.asymmetry);
    // Beyond 2.5 the polynomial fits of the Fresnel moments (d'Eon and Irving 2011) leave what is physical.
    visit(Field{.name = "refraction_index",
                .sentence = "custom: index of refraction inside over outside",
                .min = 1.0,
                .max = 2.5,
                .panel_min = 1.0,
                .panel_max = 2.5},
          medium.refraction_index);
}

/// Measured matter by name. All but the three drinks at the end: Jensen, Marschner, Levoy, Hanrahan, "A Practical Model
/// for Subsurface Light Transport" (2001), which gives sigma_s' only. The drinks: Narasimhan et al., "Acquiring
/// Scattering Properties of Participating Media by Dilution" (2006); tables differ in their dilution.
enum class Material {
    custom,
    apple,
    chicken1,
    chicken2,
    cream,
    ketchup,
    marble,
    potato,
    skim_milk,
    skin1,
    skin2,
    spectralon,
    whole_milk,
    grapefruit_juice,
    soy_milk,
    coffee,
};
template <>
inline std::span<const std::string_view> enum_words<Material>() {
    static constexpr std::array<std::string_view, 16> words{
        "custom",    "apple", "chicken1", "chicken2",   "cream",      "ketchup",          "marble",   "potato",
        "skim_milk", "skin1", "skin2",    "spectralon", "whole_milk", "grapefruit_juice", "soy_milk", "coffee"};
    return words;
}

/// The medium of a material; marble for `custom`, whose numbers stand elsewhere.
SubsurfaceMedium medium_of(Material material);

}  // namespace bruma::scene
