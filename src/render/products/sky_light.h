#pragma once
#include "gl/buffer.h"

namespace bruma::render {

/// The storage buffer of shaders/sky/sky_light.glsl: what sun and sky send into the scene.
struct SkyLight {
    gl::Buffer buffer;
};
/// Where shaders expect it (SKY_LIGHT_BINDING).
constexpr GLuint sky_light_binding = 7;

}  // namespace bruma::render
