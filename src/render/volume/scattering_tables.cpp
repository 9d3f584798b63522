#include "render/volume/scattering_tables.h"

namespace bruma::render {

std::vector<float> tabulate_extinction(const scene::TransferFunction& tf) {
    std::vector<float> extinction(scattering_entries);
    for (int n = 0; n < scattering_entries; ++n) {
        const double u = double(n) / (scattering_entries - 1);
        extinction[std::size_t(n)] = float(scene::extinction_of_opacity(scene::opacity_at(tf, u), 1.0));
    }
    return extinction;
}

ScatteringTables make_scattering_tables(const scene::TransferFunction& tf, glm::dvec3 albedo, double emission) {
    ScatteringTables tables;
    const std::vector<float> extinction = tabulate_extinction(tf);
    bool glows = false;
    for (int n = 0; n < scattering_entries; ++n) {
        const double u = double(n) / (scattering_entries - 1);
        const glm::dvec3 color = scene::color_at(tf, u);
        const glm::dvec3 own = color * (emission + scene::emission_at(tf, u));
        glows = glows || own != glm::dvec3(0.0);
        tables.optics.emplace_back(extinction[std::size_t(n)], glm::min(albedo * color, 1.0));
        tables.glow.emplace_back(own, 0.0);
    }
    if (!glows) {
        tables.glow.clear();
    }
    return tables;
}

}  // namespace bruma::render
