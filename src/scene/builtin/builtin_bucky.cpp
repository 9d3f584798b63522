#include <cmath>

#include "scene/builtin/builtin_sampling.h"
#include "scene/builtin/builtin_volumes.h"

namespace bruma::scene {
namespace {

constexpr double cage_radius_mm = 25.0;
// Neighbours are 10.1 mm apart; this width leaves 0.31 of the peak half way along a bond: seen, but well below an atom.
constexpr double gaussian_sigma_mm = 2.6;

}  // namespace

std::array<glm::dvec3, 60> bucky_atoms_mm() {
    // Even permutations of (0, 1, 3 phi), (1, 2 + phi, 2 phi) and (phi, 2, phi^3) with all signs; edge length 2.
    const double phi = 0.5 * (1.0 + std::sqrt(5.0));
    const std::array<glm::dvec3, 3> seeds{glm::dvec3(0.0, 1.0, 3.0 * phi), glm::dvec3(1.0, 2.0 + phi, 2.0 * phi),
                                          glm::dvec3(phi, 2.0, 2.0 * phi + 1.0)};
    const double scale = cage_radius_mm / std::sqrt(9.0 * phi + 10.0);
    std::array<glm::dvec3, 60> atoms{};
    std::size_t count = 0;
    for (const glm::dvec3& seed : seeds) {
        for (int signs = 0; signs < 8; ++signs) {
            if (seed.x == 0.0 && (signs & 1) != 0) {
                continue;  // -0 would be the same atom again
            }
            const glm::dvec3 p =
                scale * seed *
                glm::dvec3((signs & 1) != 0 ? -1.0 : 1.0, (signs & 2) != 0 ? -1.0 : 1.0, (signs & 4) != 0 ? -1.0 : 1.0);
            atoms[count++] = {p.x, p.y, p.z};
            atoms[count++] = {p.y, p.z, p.x};
            atoms[count++] = {p.z, p.x, p.y};
        }
    }
    return atoms;
}

double bucky_density(const glm::dvec3& point_mm) {
    static const std::array<glm::dvec3, 60> atoms = bucky_atoms_mm();
    double sum = 0.0;
    for (const glm::dvec3& atom : atoms) {
        const glm::dvec3 d = point_mm - atom;
        const double exponent = glm::dot(d, d) / (2.0 * gaussian_sigma_mm * gaussian_sigma_mm);
        if (exponent < 12.0) {  // farther atoms add less than 1/60 of a step of the byte between them all
            sum += std::exp(-exponent);
        }
    }
    return sum;
}

std::shared_ptr<const VolumeGrid> make_bucky() {
    constexpr int n = 64;
    return sample_builtin("bucky", glm::ivec3(n), VoxelType::uint8, 1e-3, [](int i, int j, int k) {
        return bucky_density({centre_in_samples(i, n), centre_in_samples(j, n), centre_in_samples(k, n)});
    });
}

}  // namespace bruma::scene
