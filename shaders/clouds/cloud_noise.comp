#version 450 core
// Fills a cube of texels with the noise of clouds, sampled at texel centres so that a repeating texture tiles exactly.
// PACKED: one channel, put together before filtering.
#ifndef TEXEL_FORMAT
#define TEXEL_FORMAT rgba8
#endif
layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(TEXEL_FORMAT, binding = 0) writeonly uniform image3D noise;
uniform int detail; // 0: shape, 1: detail

#include "clouds/noise.glsl"

void main()
{
    ivec3 size = imageSize(noise);
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(texel, size))) {
        return;
    }
    // The size is a power of two: centres are exact.
    vec3 p = (vec3(texel) + 0.5) / vec3(size);
#ifdef PACKED
    imageStore(noise, texel, vec4(detail != 0 ? packed_detail(detail_noise(p)) : packed_shape(shape_noise(p))));
#else
    imageStore(noise, texel, detail != 0 ? vec4(detail_noise(p), 1.0) : shape_noise(p));
#endif
}
