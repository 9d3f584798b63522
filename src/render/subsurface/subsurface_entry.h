#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/shader_source.h"
#include "render/subsurface/subsurface_constants.h"
#include "render/subsurface/translucent_maps.h"

/// What subsurface/subsurface_entry.glsl reads: points where light enters a body.
namespace bruma::render {

/// What shaders that include it are compiled for.
gl::Defines entry_defines(const LightMaps& light, const scene::SubsurfaceSettings& settings);

/// Sets its uniforms, textures from `unit` on; `lamps` is filled and bound. `powers`: of each lamp, E_perp; of those
/// with a position intensity, E_perp times mm^2.
void set_entry(gl::Program& program, const LightMaps& light, const SubsurfaceConstants& constants,
               const std::vector<glm::dvec3>& powers, GLuint unit, gl::Buffer& lamps);

/// Points [first, first + count) of Halton's sequence, at most 256.
void set_entry_points(gl::Program& program, std::uint64_t first, int count);

}  // namespace bruma::render
