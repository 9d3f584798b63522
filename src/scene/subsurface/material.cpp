#include "scene/subsurface/material.h"

namespace bruma::scene {
namespace {

/// From sigma_s and g, which is how liquids were measured.
SubsurfaceMedium liquid(const glm::dvec3& scattering, const glm::dvec3& absorption, const glm::dvec3& asymmetry) {
    return {scattering * (1.0 - asymmetry), absorption, asymmetry, 1.3};
}

}  // namespace

SubsurfaceMedium medium_of(Material material) {
    constexpr glm::dvec3 unknown(0.0);  // sigma_s' holds all that was measured of the phase function
    switch (material) {
        case Material::apple:
            return {{2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, unknown, 1.3};
        case Material::chicken1:
            return {{0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, unknown, 1.3};
        case Material::chicken2:
            return {{0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}, unknown, 1.3};
        case Material::cream:
            return {{7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, unknown, 1.3};
        case Material::ketchup:
            return {{0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, unknown, 1.3};
        case Material::potato:
            return {{0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, unknown, 1.3};
        case Material::skim_milk:
            return {{0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, unknown, 1.3};
        case Material::skin1:
            return {{0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, unknown, 1.3};
        case Material::skin2:
            return {{1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, unknown, 1.3};
        case Material::spectralon:
            return {{11.6, 20.4, 14.9}, {0.0, 0.0, 0.0}, unknown, 1.3};
        case Material::whole_milk:
            return {{2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, unknown, 1.3};
        case Material::grapefruit_juice:
            return liquid({0.3513, 0.3669, 0.5237}, {0.0096, 0.0131, 0.0395}, {0.548, 0.545, 0.565});
        case Material::soy_milk:
            return liquid({0.2433, 0.2714, 0.4563}, {0.0001, 0.0005, 0.0034}, {0.873, 0.858, 0.832});
        case Material::coffee:
            return liquid({0.2707, 0.2828, 0.297}, {0.1669, 0.2287, 0.3078}, {0.907, 0.896, 0.88});
        case Material::marble:
        case Material::custom:
            break;
    }
    return {{2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, unknown, 1.5};
}

}  // namespace bruma::scene
