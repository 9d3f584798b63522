#include "reference/subsurface/fresnel.h"

#include <algorithm>
#include <cmath>

#include "reference/gauss_legendre.h"

namespace bruma::reference {

double fresnel_reflectance(double cos_incidence, double relative_index) {
    const double c = std::clamp(cos_incidence, 0.0, 1.0);
    const double cos2_far = 1.0 - (1.0 - c * c) / (relative_index * relative_index);
    if (cos2_far <= 0.0) {
        return 1.0;
    }
    const double cos_far = std::sqrt(cos2_far);
    const double s = (c - relative_index * cos_far) / (c + relative_index * cos_far);
    const double p = (relative_index * c - cos_far) / (relative_index * c + cos_far);
    return 0.5 * (s * s + p * p);
}

double fresnel_transmittance(double cos_outside, double eta) {
    return cos_outside > 0.0 ? 1.0 - fresnel_reflectance(cos_outside, eta) : 0.0;
}

glm::dvec3 refract_into(glm::dvec3 to_light, glm::dvec3 normal, double eta) {
    const double c = glm::dot(to_light, normal);
    const double cos_inside = std::sqrt(std::max(0.0, 1.0 - (1.0 - c * c) / (eta * eta)));
    return glm::normalize((c * normal - to_light) / eta - cos_inside * normal);
}

std::optional<glm::dvec3> refract_out(glm::dvec3 direction, glm::dvec3 normal, double eta) {
    const double c = glm::dot(direction, normal);
    const double cos2_outside = 1.0 - (1.0 - c * c) * eta * eta;
    if (cos2_outside <= 0.0) {
        return std::nullopt;
    }
    return glm::normalize(eta * (direction - c * normal) + std::sqrt(cos2_outside) * normal);
}

FresnelMoments fitted_fresnel_moments(double index) {
    const double n = index;
    if (n < 1.0) {
        return {0.919317 + n * (-3.4793 + n * (6.75335 + n * (-7.80989 + n * (4.98554 - n * 1.36881)))),
                0.828421 + n * (-2.62051 + n * (3.36231 + n * (-1.95284 + n * (0.236494 + n * 0.145787))))};
    }
    const double m = 1.0 / n;
    return {-9.23372 + n * (22.2272 + n * (-20.9292 + n * (10.2291 + n * (-2.54396 + n * 0.254913)))),
            -1641.1 + m * (1376.53 + m * (-656.175 + m * 135.926)) +
                n * (1213.67 + n * (-568.556 + n * (164.798 + n * (-27.0181 + n * 1.91826))))};
}

bool fresnel_fits_hold(double index) {
    const double above_1 = index < 1.0 ? 1.0 / index : index;
    return above_1 >= 1.05 && above_1 <= 2.5;
}

FresnelMoments exact_fresnel_moments(double index) {
    if (index == 1.0) {
        return {};
    }
    // With mu = mu_c + (1 - mu_c) t^2 the root that R has at the critical angle becomes smooth.
    static const GaussLegendre rule(64);
    const double critical = index > 1.0 ? std::sqrt(1.0 - 1.0 / (index * index)) : 0.0;
    const glm::dvec2 beyond = rule.integrate(0.0, 1.0, [&](double t) {
        const double mu = critical + (1.0 - critical) * t * t;
        const double weighted = fresnel_reflectance(mu, 1.0 / index) * mu * 2.0 * (1.0 - critical) * t;
        return glm::dvec2(weighted, weighted * mu);
    });
    return {critical * critical + 2.0 * beyond.x, critical * critical * critical + 3.0 * beyond.y};
}

DiffuseBoundary diffuse_boundary(double eta, MomentSource source) {
    const bool fits = source == MomentSource::published_fits && fresnel_fits_hold(eta);
    const FresnelMoments inside = fits ? fitted_fresnel_moments(eta) : exact_fresnel_moments(eta);
    const FresnelMoments outside = fits ? fitted_fresnel_moments(1.0 / eta) : exact_fresnel_moments(1.0 / eta);
    DiffuseBoundary boundary;
    boundary.c_phi = (1.0 - inside.twice_c1) / 4.0;
    boundary.c_e = (1.0 - inside.thrice_c2) / 2.0;
    boundary.c_phi_inverse = (1.0 - outside.twice_c1) / 4.0;
    boundary.a = (1.0 - boundary.c_e) / (2.0 * boundary.c_phi);
    return boundary;
}

}  // namespace bruma::reference
