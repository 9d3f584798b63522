#pragma once
#include "gl/program.h"

namespace bruma::render {

/// For mesh/covered_part.glsl: where the bound framebuffer has its samples.
void set_sample_places(gl::Program& program, int samples);

}  // namespace bruma::render
