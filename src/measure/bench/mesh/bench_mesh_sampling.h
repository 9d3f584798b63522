#pragma once
#include <string>
#include <vector>

#include "gl/shader_library.h"
#include "scene/scene.h"

/// How many evaluations of the BSSRDF the densities of points where light enters need for the same noise: ours, core
/// and tail on the lit side and another behind the body, and the published exponential disk.
namespace bruma::measure {

/// Issues of the design: times fewer evaluations than the published disk, on the lit side and behind.
inline constexpr double most_wanted_lit = 50.0, most_wanted_behind = 3.0;

/// One colour at one place, by quadrature in double: deviations of one drawn point over the mean.
struct SamplingNoise {
    std::string material, place;
    bool is_lit = true;
    int channel = 0;
    double ours = 0.0;
    double disk = 0.0;      ///< as published, 8 / sigma* wide
    double cut_disk = 0.0;  ///< cut at the body's diameter, beyond which nothing can lie
    double over_disk() const { return disk * disk / (ours * ours); }
    double over_cut_disk() const { return cut_disk * cut_disk / (ours * ours); }
};
/// Cream and marble: a lit half-space, and a ball of radius 10 mm at its lit pole, behind its side, at its back.
std::vector<SamplingNoise> measure_sampling_noise();

/// Both densities through all passes of the renderer, in a picture of one side of that ball; the disk is the cut one.
struct SamplingRace {
    std::string material, place;
    bool is_lit = true;
    std::uint64_t evaluations = 0;  ///< by either
    double ours = 0.0, disk = 0.0;  ///< relative RMSE from our density with 16 times the points
    double ratio() const { return disk * disk / (ours * ours); }
};
std::vector<SamplingRace> race_samplings(gl::ShaderLibrary& shaders, bool quick);

/// A ball or a knot of millimetres that shows nothing but the light from inside, in black surroundings.
scene::Scene translucent_body(const std::string& builtin, scene::Material material, glm::dvec3 to_light);

}  // namespace bruma::measure
