#pragma once
#include "gl/program.h"
#include "scene/sky.h"

namespace bruma::render {

/// Sets the air of shaders/include/sky_air.glsl.
void set_air(gl::Program& program, const scene::Atmosphere& atmosphere);

}  // namespace bruma::render
