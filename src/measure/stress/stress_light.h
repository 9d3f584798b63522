#pragma once
#include "measure/stress/stress_rig.h"
#include "measure/stress/stress_scenes.h"

/// Scenes of scattered light for the stress suites; private to them.
namespace bruma::measure {

/// One volume that scatters under one light, in black surroundings; steps of a quarter of a voxel.
scene::Scene scattering_scene(const scene::Light& light, std::shared_ptr<const scene::VolumeGrid> grid = smooth_grid());

/// Data of one value, a cube of 16 mm, white, with the given optical depth along an edge; seen along -z by parallel
/// rays, lit along the view by irradiance pi.
scene::Scene uniform_scene(double depth);
/// What the middle of that picture shows: light that goes in and comes back by the same way, scattered once (g = 0,
/// albedo 1), E p (1 - exp(-2 depth)) / 2.
double uniform_radiance(double depth);

/// The ways to compute light, in turn: physical without and with diffuse light, paper, shadow rays.
inline constexpr int light_ways = 4;
void take_way(scene::Scene& scene, int way);

/// Draws a scene in all ways and returns the brightest channel as a share of what energy allows under an irradiance:
/// p_max E and, with diffuse light, E / (4 pi) more; paper: E / pi. Throws std::runtime_error where radiance is below 0
/// or not finite.
double share_of_allowed(StressRig& rig, scene::Scene scene, double irradiance = std::numbers::pi);

/// The largest difference between two scenes over all ways, as a share of the largest radiance of the second one.
double difference_in_all_ways(StressRig& rig, scene::Scene a, scene::Scene b);

}  // namespace bruma::measure
