#pragma once
#include <glm/glm.hpp>

#include "gl/program.h"
#include "scene/subsurface/material.h"
#include "scene/subsurface/subsurface.h"

namespace bruma::render {

/// What diffusion theory makes of a medium, in mm: the `SubsurfaceMedium` of subsurface/subsurface.glsl. Its formulas
/// and sources stand there and in src/reference/subsurface/dipole.h.
struct SubsurfaceConstants {
    glm::dvec3 d{0.0}, sigma_tr{0.0}, sigma_t{0.0}, d_e{0.0}, sigma_t_reduced{0.0}, albedo_reduced{0.0};
    glm::dvec3 normalisation{1.0};
    double eta = 1.3, c_phi = 0.0, c_e = 0.0, c_phi_inverse = 0.0, a = 0.0, standard_a = 0.0;
    glm::dvec3 sigma_unscattered{0.0};  ///< extinction of light that goes straight through, 1/mm
    /// Share of diffuse light from all sides that a half-space returns, by the standard dipole.
    glm::dvec3 diffuse_reflectance{0.0};
};
SubsurfaceConstants subsurface_constants(const scene::SubsurfaceMedium& medium, scene::SubsurfaceModel model);

/// Sets the members of the uniform `medium`.
void set_medium(gl::Program& program, const SubsurfaceConstants& constants);

/// Decay rates, 1/mm, of the densities that points where light enters are drawn from: tails of red, green and blue as
/// long as 1 / sigma_tr, and cores as wide as 1 / sigma_t'.
struct EntryRates {
    glm::dvec3 tails{1.0}, cores{1.0};
    /// Beyond this depth below the lit surface, mm, the kernel is wider than its cores.
    double back_lit_depth = 1.0;
};
/// Without absorption a tail would be endless; it ends with the body.
EntryRates entry_rates(const SubsurfaceConstants& constants, double bounding_radius);

}  // namespace bruma::render
