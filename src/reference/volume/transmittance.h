#pragma once
#include <cstdint>
#include <vector>

#include "reference/volume/prepared_volume.h"
#include "scene/camera.h"

namespace bruma::reference {

struct Transmittance {
    double value = 1.0;
    double error = 0.0;             ///< estimated bound
    std::uint64_t evaluations = 0;  ///< of the media
};

/// Share of light that passes from the ray's near plane to `t_far` (metres, may be infinite): exp of the integral of
/// the extinction, cell by cell, by Gauss' rule with three nodes, halved until its stated error is below `tolerance`.
/// 0 once less than `negligible` is left.
Transmittance transmittance(const std::vector<PreparedVolume>& volumes, const scene::Ray& ray, double t_far,
                            double tolerance, double negligible, bool leap);

}  // namespace bruma::reference
