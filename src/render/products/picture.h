#pragma once
#include "gl/texture.h"

namespace bruma::render {

/// The picture in linear Rec.709 radiance, alpha = 1 - transmittance; bottom row first, as OpenGL has it.
struct Picture {
    gl::Texture color;
    gl::Framebuffer framebuffer;
};

/// Samples taken and emptiness queries made, per pixel.
struct SampleCounts {
    gl::Texture counts;
    gl::Texture picture;
    gl::Framebuffer framebuffer;
};

}  // namespace bruma::render
