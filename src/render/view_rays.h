#pragma once
#include <string>
#include <vector>

#include "gl/program.h"
#include "scene/scene.h"

/// What all passes that look along a pixel's ray must agree on to the last bit: where it starts, through which points
/// of the picture it goes, and which lights shine on what it meets.
namespace bruma::render {

/// Parallel rays may start anywhere along the view: from a camera far off they start at what is shown instead, where
/// floats still tell voxels apart. Returns how much nearer, metres; 0 for cameras near by.
double skipped_distance(const scene::Camera& camera, const scene::Bounds& shown);
/// The camera moved forward by that much, which sees the same.
scene::Camera started_nearer(const scene::Camera& camera, double skipped);

/// Half of the view in units of `unit_world` metres; in perspective tangents.
glm::dvec2 half_view(const scene::Camera& camera, glm::ivec2 pixels, double unit_world);

/// Names of the lights that shine, directional ones first. Black ones cost nothing.
std::vector<std::string> order_lights(const scene::Scene& scene);

/// Adds how many lights there are of either sort, as light/lights.glsl wants to know.
void count_lights(gl::Defines& defines, const std::vector<scene::Light>& lights);

/// Sets the lights of light/lights.glsl, lengths in units of `unit_world` metres. They must come with the directional
/// ones first, as `order_lights` leaves them.
void set_lights(gl::Program& program, const std::vector<scene::Light>& lights, const scene::Camera& camera,
                double unit_world);

}  // namespace bruma::render
