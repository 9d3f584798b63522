#include <algorithm>
#include <array>
#include <cmath>

#include "reference/subsurface/dipole.h"

namespace bruma::reference {
namespace {

/// Reflectance of a half-space at normal incidence: random walks of 1e5 to 1e6 paths over the directional dipole
/// integrated over the plane. Differs from the ratio at other angles by at most 2.6 % for albedos from 0.8.
struct Row {
    double albedo, at_1_3, at_1_5;
};
constexpr std::array<Row, 17> table{{
    {0.02, 0.0108, 0.0103},
    {0.05, 0.0269, 0.0256},
    {0.1, 0.0537, 0.0511},
    {0.2, 0.1077, 0.1028},
    {0.3, 0.1631, 0.1563},
    {0.4, 0.2209, 0.2128},
    {0.5, 0.2834, 0.2731},
    {0.6, 0.3498, 0.3409},
    {0.7, 0.4228, 0.4197},
    {0.8, 0.5101, 0.5141},
    {0.9, 0.6137, 0.6361},
    {0.95, 0.6772, 0.7116},
    {0.98, 0.7283, 0.7662},
    {0.99, 0.7545, 0.7901},
    {0.995, 0.7700, 0.8043},
    {0.999, 0.7903, 0.8223},
    {0.9999, 0.8009, 0.8312},
}};

}  // namespace

double energy_normalisation(double albedo_reduced, double eta) {
    const double along_eta = std::clamp((eta - 1.3) / 0.2, 0.0, 1.0);
    const auto at = [&](const Row& row) { return std::lerp(row.at_1_3, row.at_1_5, along_eta); };
    if (albedo_reduced <= table.front().albedo) {
        return at(table.front()) * albedo_reduced / table.front().albedo;
    }
    const auto above = std::lower_bound(table.begin(), table.end(), albedo_reduced,
                                        [](const Row& row, double albedo) { return row.albedo < albedo; });
    if (above == table.end()) {
        return at(table.back());
    }
    const Row& low = *(above - 1);
    // Towards 1 the ratio runs along the logarithm of the absorbed share, below one half along the albedo itself.
    const auto scale = [&](double albedo) { return low.albedo < 0.5 ? albedo : -std::log10(1.0 - albedo); };
    const double share = (scale(albedo_reduced) - scale(low.albedo)) / (scale(above->albedo) - scale(low.albedo));
    return std::lerp(at(low), at(*above), share);
}

}  // namespace bruma::reference
