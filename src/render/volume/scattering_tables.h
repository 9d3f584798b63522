#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "render/volume/transfer_tables.h"

namespace bruma::render {

/// Entries of the tables for path tracing: every eighth-bit control point and every entry of the marcher's tables is
/// one, and a step of the transfer function is smeared over a quarter of what it is there.
constexpr int scattering_entries = 4 * (depth_entries - 1) + 1;

/// A transfer function as single points of the medium see it, at u = i / (scattering_entries - 1).
struct ScatteringTables {
    std::vector<glm::vec4> optics;  ///< extinction per reference length; albedo: colour times the volume's, at most 1
    std::vector<glm::vec4> glow;    ///< radiance of its own light per unit of extinction; empty without any
};

/// `albedo` and `emission` are those of scene::VolumeOptics.
ScatteringTables make_scattering_tables(const scene::TransferFunction& tf, glm::dvec3 albedo, double emission);

/// The extinctions of `ScatteringTables::optics` alone.
std::vector<float> tabulate_extinction(const scene::TransferFunction& tf);

}  // namespace bruma::render
