#include "render/subsurface/subsurface_constants.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/subsurface/energy_table.h"

namespace bruma::render {
namespace {

/// Share of power reflected at a boundary; `index`: on the far side over this side.
double fresnel_reflectance(double cosine, double index) {
    const double squared = 1.0 - (1.0 - cosine * cosine) / (index * index);
    if (squared <= 0.0) {
        return 1.0;
    }
    const double far_cosine = std::sqrt(squared);
    const double s = (cosine - index * far_cosine) / (cosine + index * far_cosine);
    const double p = (index * cosine - far_cosine) / (index * cosine + far_cosine);
    return 0.5 * (s * s + p * p);
}

/// 2 C1 and 3 C2: moments of the reflectance of a boundary, seen from the side whose index is `index` times the
/// other's.
struct Moments {
    double twice_c1 = 0.0, thrice_c2 = 0.0;
};

/// The fits of d'Eon and Irving, "A Quantized-Diffusion Model for Rendering Translucent Materials", 2011.
Moments fitted_moments(double n) {
    if (n < 1.0) {
        return {0.919317 + n * (-3.4793 + n * (6.75335 + n * (-7.80989 + n * (4.98554 - n * 1.36881)))),
                0.828421 + n * (-2.62051 + n * (3.36231 + n * (-1.95284 + n * (0.236494 + n * 0.145787))))};
    }
    const double m = 1.0 / n;
    return {-9.23372 + n * (22.2272 + n * (-20.9292 + n * (10.2291 + n * (-2.54396 + n * 0.254913)))),
            -1641.1 + m * (1376.53 + m * (-656.175 + m * 135.926)) +
                n * (1213.67 + n * (-568.556 + n * (164.798 + n * (-27.0181 + n * 1.91826))))};
}

/// By the midpoint rule in t with mu = mu_c + (1 - mu_c) t^2, which is smooth at the critical angle.
Moments integrated_moments(double n) {
    const double critical = n > 1.0 ? std::sqrt(1.0 - 1.0 / (n * n)) : 0.0;
    Moments moments{critical * critical, critical * critical * critical};
    constexpr int points = 256;
    for (int k = 0; k < points && n != 1.0; ++k) {
        const double t = (k + 0.5) / points;
        const double mu = critical + (1.0 - critical) * t * t;
        const double weight = fresnel_reflectance(mu, 1.0 / n) * mu * 2.0 * (1.0 - critical) * t / points;
        moments.twice_c1 += 2.0 * weight;
        moments.thrice_c2 += 3.0 * weight * mu;
    }
    return moments;
}

/// Where the fits hold they are used, since published pictures and numbers come from them.
Moments moments(double n) {
    const double above_1 = std::max(n, 1.0 / n);
    return above_1 >= 1.05 && above_1 <= 2.5 ? fitted_moments(n) : integrated_moments(n);
}

/// Between the rows of the table, from 0 where nothing scatters.
double normalisation(double albedo, double eta) {
    const auto& table = scene::energy_table;
    const double between = std::clamp((eta - 1.3) / 0.2, 0.0, 1.0);
    const auto value = [&](const scene::EnergyRow& row) { return std::lerp(row.at_1_3, row.at_1_5, between); };
    // The curve is straight in the albedo while this is small, and in -log10(1 - albedo) beyond.
    const auto place = [](double a) { return a <= 0.5 ? a : 0.5 - std::log10(1.0 - a) + std::log10(0.5); };
    const double a = std::clamp(albedo, 0.0, table.back().albedo);
    std::size_t n = 0;
    while (n + 1 < table.size() && table[n].albedo < a) {
        ++n;
    }
    const scene::EnergyRow nothing{0.0, 0.0, 0.0};
    const scene::EnergyRow& below = n == 0 ? nothing : table[n - 1];
    const double low = place(below.albedo), high = place(table[n].albedo);
    return std::lerp(value(below), value(table[n]), (place(a) - low) / (high - low));
}

}  // namespace

SubsurfaceConstants subsurface_constants(const scene::SubsurfaceMedium& medium, scene::SubsurfaceModel model) {
    SubsurfaceConstants k;
    const double eta = medium.refraction_index;
    const Moments inside = moments(eta);
    k.eta = eta;
    k.c_phi = (1.0 - inside.twice_c1) / 4.0;
    k.c_e = (1.0 - inside.thrice_c2) / 2.0;
    k.c_phi_inverse = (1.0 - moments(1.0 / eta).twice_c1) / 4.0;
    k.a = (1.0 - k.c_e) / (2.0 * k.c_phi);
    const double f_dr = -1.440 / (eta * eta) + 0.710 / eta + 0.668 + 0.0636 * eta;
    k.standard_a = (1.0 + f_dr) / (1.0 - f_dr);
    // Matter that neither scatters nor absorbs has no diffusion length. A thousand km is as good as none, and bodies
    // may be a km across: lengths times coefficients are all that counts.
    constexpr double least = 1e-9;
    k.sigma_t_reduced = glm::max(medium.reduced_extinction(), glm::dvec3(least));
    k.sigma_t = glm::max(medium.absorption + medium.scattering(), glm::dvec3(least));
    k.d = 1.0 / (3.0 * k.sigma_t_reduced);
    k.sigma_tr = glm::sqrt(medium.absorption / k.d);
    k.albedo_reduced = glm::max(medium.reduced_scattering / k.sigma_t_reduced, glm::dvec3(1e-3));
    k.d_e = 2.131 * k.d / glm::sqrt(k.albedo_reduced);
    // delta-Eddington (Joseph, Wiscombe, Weinman 1976): the forward peak g^2 counts as not scattered.
    k.sigma_unscattered = medium.absorption + medium.scattering() * (1.0 - medium.asymmetry * medium.asymmetry);
    for (int c = 0; c < 3; ++c) {
        const double albedo = k.albedo_reduced[c];
        if (model == scene::SubsurfaceModel::normalised_dipole) {
            k.normalisation[c] = normalisation(albedo, eta);
        }
        const double q = std::sqrt(3.0 * (1.0 - std::min(1.0, albedo)));
        k.diffuse_reflectance[c] = 0.5 * albedo * (1.0 + std::exp(-4.0 / 3.0 * k.standard_a * q)) * std::exp(-q);
    }
    return k;
}

void set_medium(gl::Program& program, const SubsurfaceConstants& k) {
    const auto set = [&](const char* member, glm::dvec3 value) { program.set(member, glm::vec3(value)); };
    set("medium.d", k.d);
    set("medium.sigma_tr", k.sigma_tr);
    set("medium.sigma_t", k.sigma_t);
    set("medium.d_e", k.d_e);
    set("medium.sigma_t_reduced", k.sigma_t_reduced);
    set("medium.albedo_reduced", k.albedo_reduced);
    set("medium.normalisation", k.normalisation);
    program.set("medium.eta", float(k.eta));
    program.set("medium.c_phi", float(k.c_phi));
    program.set("medium.c_e", float(k.c_e));
    program.set("medium.c_phi_inverse", float(k.c_phi_inverse));
    program.set("medium.a", float(k.a));
    program.set("medium.standard_a", float(k.standard_a));
}

EntryRates entry_rates(const SubsurfaceConstants& constants, double bounding_radius) {
    EntryRates rates;
    rates.tails = glm::max(constants.sigma_tr, glm::dvec3(0.5e-3 / bounding_radius));
    rates.cores = constants.sigma_t_reduced;
    rates.back_lit_depth = 1.0 / std::min({rates.cores.x, rates.cores.y, rates.cores.z});
    return rates;
}

}  // namespace bruma::render
