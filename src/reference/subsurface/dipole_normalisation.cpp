#include <algorithm>
#include <cmath>

#include "reference/subsurface/dipole.h"
#include "scene/subsurface/energy_table.h"

namespace bruma::reference {

double energy_normalisation(double albedo_reduced, double eta) {
    const auto& table = scene::energy_table;
    const double along_eta = std::clamp((eta - 1.3) / 0.2, 0.0, 1.0);
    const auto at = [&](const scene::EnergyRow& row) { return std::lerp(row.at_1_3, row.at_1_5, along_eta); };
    if (albedo_reduced <= table.front().albedo) {
        return at(table.front()) * albedo_reduced / table.front().albedo;
    }
    const auto above = std::lower_bound(table.begin(), table.end(), albedo_reduced,
                                        [](const scene::EnergyRow& row, double albedo) { return row.albedo < albedo; });
    if (above == table.end()) {
        return at(table.back());
    }
    const scene::EnergyRow& low = *(above - 1);
    // Towards 1 the ratio runs along the logarithm of the absorbed share, below one half along the albedo itself.
    const auto scale = [&](double albedo) { return low.albedo < 0.5 ? albedo : -std::log10(1.0 - albedo); };
    const double share = (scale(albedo_reduced) - scale(low.albedo)) / (scale(above->albedo) - scale(low.albedo));
    return std::lerp(at(low), at(*above), share);
}

}  // namespace bruma::reference
